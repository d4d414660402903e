#include "replay_slots.h"
#include "shaders/replay_modes.h"

#include <iterator>

namespace sample
{
namespace
{
using nrd::ResourceType;

// clang-format off
constexpr VkFormat kRgba16 = VK_FORMAT_R16G16B16A16_SFLOAT;
constexpr VkFormat kRgba32 = VK_FORMAT_R32G32B32A32_SFLOAT;
constexpr VkFormat kR16 = VK_FORMAT_R16_SFLOAT;

constexpr SlotRow kSlots[] = {
    {ResourceType::IN_MV,                     Family::None,      kRgba16, Layer::Motion,   REPLAY_PACK_COPY,              false, {}, {}},
    {ResourceType::IN_NORMAL_ROUGHNESS,       Family::None,      VK_FORMAT_A2B10G10R10_UNORM_PACK32, Layer::Guides, REPLAY_PACK_NORMAL_ROUGHNESS, false, {}, {}},
    {ResourceType::IN_VIEWZ,                  Family::None,      VK_FORMAT_R32_SFLOAT, Layer::Depth, REPLAY_PACK_COPY,    false, {}, {}},
    {ResourceType::IN_DIFF_RADIANCE_HITDIST,  Family::Reblur,    kRgba16, Layer::Diffuse,  REPLAY_PACK_REBLUR_RADIANCE,   false, {}, {}},
    {ResourceType::IN_SPEC_RADIANCE_HITDIST,  Family::Reblur,    kRgba16, Layer::Specular, REPLAY_PACK_REBLUR_RADIANCE,   false, {}, {}},
    {ResourceType::IN_DIFF_HITDIST,           Family::Reblur,    kR16,    Layer::Diffuse,  REPLAY_PACK_REBLUR_HITDIST,    false, {}, {}},
    {ResourceType::IN_SPEC_HITDIST,           Family::Reblur,    kR16,    Layer::Specular, REPLAY_PACK_REBLUR_HITDIST,    false, {}, {}},
    {ResourceType::IN_SIGNAL,                 Family::Reference, kRgba32, Layer::Diffuse,  REPLAY_PACK_COPY,              false, {}, {}},
    {ResourceType::OUT_DIFF_RADIANCE_HITDIST, Family::Reblur,    kRgba16, Layer::Diffuse,  REPLAY_UNPACK_REBLUR_RADIANCE, true,  Signal::Diffuse,  Signal::NormHitDist},
    {ResourceType::OUT_SPEC_RADIANCE_HITDIST, Family::Reblur,    kRgba16, Layer::Specular, REPLAY_UNPACK_REBLUR_RADIANCE, true,  Signal::Specular, Signal::SpecularNormHitDist},
    {ResourceType::OUT_DIFF_HITDIST,          Family::Reblur,    kR16,    Layer::Diffuse,  REPLAY_UNPACK_COPY,            true,  {},               Signal::NormHitDist},
    {ResourceType::OUT_SPEC_HITDIST,          Family::Reblur,    kR16,    Layer::Specular, REPLAY_UNPACK_COPY,            true,  {},               Signal::SpecularNormHitDist},
    {ResourceType::OUT_SIGNAL,                Family::Reference, kRgba32, Layer::Diffuse,  REPLAY_UNPACK_COPY,            true,  Signal::Diffuse,  {}},
    {ResourceType::OUT_VALIDATION,            Family::None,      VK_FORMAT_R8G8B8A8_UNORM, Layer::Depth, REPLAY_UNPACK_COPY, true, {}, {}},
};

// The channels of a layer's components in order; where a row is short, the rest is 0.
struct LayerRow
{
    Layer layer;
    Channel channels[4];
    size_t channelCount;
};
constexpr LayerRow kLayers[] = {
    {Layer::Guides,   {Channel::NormalX, Channel::NormalY, Channel::NormalZ, Channel::Roughness}, 4},
    {Layer::Depth,    {Channel::ViewZ, Channel::MaterialId}, 2},
    {Layer::Motion,   {Channel::MotionX, Channel::MotionY, Channel::MotionZ}, 3},
    {Layer::Diffuse,  {Channel::DiffuseR, Channel::DiffuseG, Channel::DiffuseB, Channel::DiffuseHitDist}, 4},
    {Layer::Specular, {Channel::SpecularR, Channel::SpecularG, Channel::SpecularB, Channel::SpecularHitDist}, 4},
};
// clang-format on

constexpr bool rowsMatchKeys()
{
    for (size_t i = 0; i < std::size(kLayers); i++)
        if (static_cast<size_t>(kLayers[i].layer) != i) return false;
    return std::size(kLayers) == kLayerCount;
}
static_assert(rowsMatchKeys());
} // namespace

std::vector<float> layerValues(const Planes& frame, Layer layer)
{
    const LayerRow& row = kLayers[static_cast<size_t>(layer)];
    std::vector<float> values(frame.pixelCount() * 4, 0.0f);
    for (size_t c = 0; c < row.channelCount; c++)
    {
        if (!frame.has(row.channels[c])) continue;
        const std::vector<float>& plane = frame[row.channels[c]];
        for (size_t i = 0; i < plane.size(); i++) values[i * 4 + c] = plane[i];
    }
    return values;
}

std::vector<Channel> neededChannels(Layer layer)
{
    const LayerRow& row = kLayers[static_cast<size_t>(layer)];
    std::vector<Channel> channels;
    for (size_t c = 0; c < row.channelCount; c++)
        if (row.channels[c] != Channel::MaterialId) channels.push_back(row.channels[c]);
    return channels;
}

const SlotRow* findSlot(nrd::ResourceType type, Family family)
{
    for (const SlotRow& row : kSlots)
        if (row.type == type && (row.family == Family::None || row.family == family)) return &row;
    return nullptr;
}
} // namespace sample
