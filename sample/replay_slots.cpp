#include "replay_slots.h"
#include "shaders/replay_modes.h"

#include <iterator>

namespace sample
{
namespace
{
using nrd::ResourceType;

constexpr VkFormat kRgba16 = VK_FORMAT_R16G16B16A16_SFLOAT;
constexpr VkFormat kRgba16Snorm = VK_FORMAT_R16G16B16A16_SNORM; // finer than half floats near 1
constexpr VkFormat kRgba8 = VK_FORMAT_R8G8B8A8_UNORM;
constexpr VkFormat kRgba32 = VK_FORMAT_R32G32B32A32_SFLOAT;
constexpr VkFormat kR16 = VK_FORMAT_R16_SFLOAT;
constexpr VkFormat kR32 = VK_FORMAT_R32_SFLOAT;
constexpr VkFormat kA2B10G10R10 = VK_FORMAT_A2B10G10R10_UNORM_PACK32;

constexpr SlotRow in(ResourceType type, Family family, VkFormat format, std::optional<Layer> layer, uint32_t mode)
{
    return {type,  family, format, layer, {}, mode, layer == Layer::Diffuse || layer == Layer::Shadow,
            false, {},     {},     {}};
}

constexpr SlotRow directed(ResourceType type, Family family, Layer layer, uint32_t mode)
{
    SlotRow row = in(type, family, kRgba16, layer, mode);
    row.direction = row.isDiffuse ? Layer::DiffuseDirection : Layer::SpecularDirection;
    return row;
}

constexpr SlotRow out(ResourceType type, Family family, VkFormat format, uint32_t mode)
{
    return {type, family, format, {}, {}, mode, false, true, {}, {}, {}};
}

constexpr SlotRow with(SlotRow row, std::optional<Signal> radiance, std::optional<Signal> scalar = {})
{
    row.radiance = radiance;
    row.scalar = scalar;
    row.isDiffuse = radiance == Signal::Diffuse;
    return row;
}

constexpr SlotRow withSh1(SlotRow row, ResourceType sh1)
{
    row.sh1 = sh1;
    return row;
}

constexpr Family kReblur = Family::Reblur, kRelax = Family::Relax;

// clang-format off
constexpr SlotRow kSlots[] = {
    in(ResourceType::IN_MV,              Family::None, kRgba16, Layer::Motion, REPLAY_PACK_COPY),
    in(ResourceType::IN_VIEWZ,           Family::None, kR32,    Layer::Depth,  REPLAY_PACK_COPY),
    in(ResourceType::IN_NORMAL_ROUGHNESS, Family::None, kA2B10G10R10, Layer::Guides, REPLAY_PACK_NORMAL_ROUGHNESS),
    in(ResourceType::IN_DIFF_CONFIDENCE, Family::None, kR16,    {},            REPLAY_PACK_CONSTANT),
    in(ResourceType::IN_SPEC_CONFIDENCE, Family::None, kR16,    {},            REPLAY_PACK_CONSTANT),
    in(ResourceType::IN_DISOCCLUSION_THRESHOLD_MIX, Family::None, kR16, {},    REPLAY_PACK_CONSTANT),
    in(ResourceType::IN_SPEC_MV, Family::None, kRgba16, Layer::SpecularMotion, REPLAY_PACK_COPY),
    in(ResourceType::IN_DIFF_RADIANCE_HITDIST, kReblur, kRgba16, Layer::Diffuse,  REPLAY_PACK_REBLUR_RADIANCE),
    in(ResourceType::IN_SPEC_RADIANCE_HITDIST, kReblur, kRgba16, Layer::Specular, REPLAY_PACK_REBLUR_RADIANCE),
    in(ResourceType::IN_DIFF_HITDIST,          kReblur, kR16,    Layer::Diffuse,  REPLAY_PACK_REBLUR_HITDIST),
    in(ResourceType::IN_SPEC_HITDIST,          kReblur, kR16,    Layer::Specular, REPLAY_PACK_REBLUR_HITDIST),
    directed(ResourceType::IN_DIFF_DIRECTION_HITDIST, kReblur, Layer::Diffuse, REPLAY_PACK_REBLUR_DIRECTION_HITDIST),
    directed(ResourceType::IN_DIFF_SH0,        kReblur, Layer::Diffuse,  REPLAY_PACK_REBLUR_SH0),
    directed(ResourceType::IN_DIFF_SH1,        kReblur, Layer::Diffuse,  REPLAY_PACK_REBLUR_SH1),
    directed(ResourceType::IN_SPEC_SH0,        kReblur, Layer::Specular, REPLAY_PACK_REBLUR_SH0),
    directed(ResourceType::IN_SPEC_SH1,        kReblur, Layer::Specular, REPLAY_PACK_REBLUR_SH1),
    in(ResourceType::IN_DIFF_RADIANCE_HITDIST, kRelax, kRgba16, Layer::Diffuse,  REPLAY_PACK_RELAX_RADIANCE),
    in(ResourceType::IN_SPEC_RADIANCE_HITDIST, kRelax, kRgba16, Layer::Specular, REPLAY_PACK_RELAX_RADIANCE),
    directed(ResourceType::IN_DIFF_SH0,        kRelax,  Layer::Diffuse,  REPLAY_PACK_RELAX_SH0),
    directed(ResourceType::IN_DIFF_SH1,        kRelax,  Layer::Diffuse,  REPLAY_PACK_RELAX_SH1),
    directed(ResourceType::IN_SPEC_SH0,        kRelax,  Layer::Specular, REPLAY_PACK_RELAX_SH0),
    directed(ResourceType::IN_SPEC_SH1,        kRelax,  Layer::Specular, REPLAY_PACK_RELAX_SH1),
    in(ResourceType::IN_PENUMBRA,     Family::Sigma, kR16,   Layer::Shadow, REPLAY_PACK_SIGMA_PENUMBRA),
    in(ResourceType::IN_TRANSLUCENCY, Family::Sigma, kRgba8, Layer::Shadow, REPLAY_PACK_SIGMA_TRANSLUCENCY),
    in(ResourceType::IN_SIGNAL, Family::Reference, kRgba32, Layer::Diffuse, REPLAY_PACK_COPY),
    with(out(ResourceType::OUT_DIFF_RADIANCE_HITDIST, kReblur, kRgba16, REPLAY_UNPACK_REBLUR_RADIANCE),
         Signal::Diffuse, Signal::NormHitDist),
    with(out(ResourceType::OUT_SPEC_RADIANCE_HITDIST, kReblur, kRgba16, REPLAY_UNPACK_REBLUR_RADIANCE),
         Signal::Specular, Signal::SpecularNormHitDist),
    withSh1(with(out(ResourceType::OUT_DIFF_SH0, kReblur, kRgba16, REPLAY_UNPACK_RESOLVE_SG),
                 Signal::Diffuse, Signal::NormHitDist), ResourceType::OUT_DIFF_SH1),
    out(ResourceType::OUT_DIFF_SH1, kReblur, kRgba16, REPLAY_UNPACK_COPY),
    withSh1(with(out(ResourceType::OUT_SPEC_SH0, kReblur, kRgba16, REPLAY_UNPACK_RESOLVE_SG),
                 Signal::Specular, Signal::SpecularNormHitDist), ResourceType::OUT_SPEC_SH1),
    out(ResourceType::OUT_SPEC_SH1, kReblur, kRgba16, REPLAY_UNPACK_COPY),
    // RELAX returns no hit distance.
    with(out(ResourceType::OUT_DIFF_RADIANCE_HITDIST, kRelax, kRgba16, REPLAY_UNPACK_RELAX_RADIANCE), Signal::Diffuse),
    with(out(ResourceType::OUT_SPEC_RADIANCE_HITDIST, kRelax, kRgba16, REPLAY_UNPACK_RELAX_RADIANCE), Signal::Specular),
    withSh1(with(out(ResourceType::OUT_DIFF_SH0, kRelax, kRgba16, REPLAY_UNPACK_RESOLVE_SG), Signal::Diffuse),
            ResourceType::OUT_DIFF_SH1),
    out(ResourceType::OUT_DIFF_SH1, kRelax, kRgba16, REPLAY_UNPACK_COPY),
    withSh1(with(out(ResourceType::OUT_SPEC_SH0, kRelax, kRgba16, REPLAY_UNPACK_RESOLVE_SG), Signal::Specular),
            ResourceType::OUT_SPEC_SH1),
    out(ResourceType::OUT_SPEC_SH1, kRelax, kRgba16, REPLAY_UNPACK_COPY),
    with(out(ResourceType::OUT_DIFF_HITDIST, kReblur, kR16, REPLAY_UNPACK_REBLUR_HITDIST), {}, Signal::NormHitDist),
    with(out(ResourceType::OUT_SPEC_HITDIST, kReblur, kR16, REPLAY_UNPACK_REBLUR_HITDIST), {},
         Signal::SpecularNormHitDist),
    with(out(ResourceType::OUT_DIFF_DIRECTION_HITDIST, kReblur, kRgba16Snorm, REPLAY_UNPACK_REBLUR_DIRECTION_HITDIST), {},
         Signal::NormHitDist),
    with(out(ResourceType::OUT_SHADOW_TRANSLUCENCY, Family::Sigma, kRgba8, REPLAY_UNPACK_SIGMA), Signal::Translucency,
         Signal::Shadow),
    with(out(ResourceType::OUT_SIGNAL, Family::Reference, kRgba32, REPLAY_UNPACK_COPY), Signal::Diffuse, {}),
    out(ResourceType::OUT_VALIDATION, Family::None, VK_FORMAT_R8G8B8A8_UNORM, REPLAY_UNPACK_COPY),
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
    {Layer::DiffuseDirection,  {Channel::DiffuseDX, Channel::DiffuseDY, Channel::DiffuseDZ}, 3},
    {Layer::SpecularDirection, {Channel::SpecularDX, Channel::SpecularDY, Channel::SpecularDZ}, 3},
    {Layer::Shadow, {Channel::ShadowR, Channel::ShadowG, Channel::ShadowB, Channel::ShadowDist}, 4},
    {Layer::SpecularMotion,
     {Channel::SpecularMX, Channel::SpecularMY, Channel::SpecularMZ, Channel::SpecularHitDist}, 4},
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
