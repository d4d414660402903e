#include "lobe_signal.h"

#include "nrd_sample_shaders.h"
#include "shaders/lobe_modes.h"

namespace sample
{
namespace
{
using nrd::ResourceType;

struct SlotRow
{
    Family family;
    LobeFormat format;
    Lobe lobe;
    ResourceType input;
    ResourceType output;
    VkFormat imageFormat;
    uint32_t mode;
};

constexpr VkFormat kRgba16 = VK_FORMAT_R16G16B16A16_SFLOAT;
constexpr VkFormat kRgba16Snorm = VK_FORMAT_R16G16B16A16_SNORM; // finer than half floats near 1
constexpr VkFormat kR16 = VK_FORMAT_R16_SFLOAT;
constexpr Family kReblur = Family::Reblur, kRelax = Family::Relax;

// clang-format off
constexpr SlotRow kSlots[] = {
    {kReblur, LobeFormat::Radiance, Lobe::Diffuse,
     ResourceType::IN_DIFF_RADIANCE_HITDIST, ResourceType::OUT_DIFF_RADIANCE_HITDIST, kRgba16, LOBE_RADIANCE},
    {kReblur, LobeFormat::Radiance, Lobe::Specular,
     ResourceType::IN_SPEC_RADIANCE_HITDIST, ResourceType::OUT_SPEC_RADIANCE_HITDIST, kRgba16, LOBE_RADIANCE},
    {kReblur, LobeFormat::Sh, Lobe::Diffuse,
     ResourceType::IN_DIFF_SH0, ResourceType::OUT_DIFF_SH0, kRgba16, LOBE_SH0},
    {kReblur, LobeFormat::Sh, Lobe::Diffuse,
     ResourceType::IN_DIFF_SH1, ResourceType::OUT_DIFF_SH1, kRgba16, LOBE_SH1},
    {kReblur, LobeFormat::Sh, Lobe::Specular,
     ResourceType::IN_SPEC_SH0, ResourceType::OUT_SPEC_SH0, kRgba16, LOBE_SH0},
    {kReblur, LobeFormat::Sh, Lobe::Specular,
     ResourceType::IN_SPEC_SH1, ResourceType::OUT_SPEC_SH1, kRgba16, LOBE_SH1},
    {kReblur, LobeFormat::HitDistance, Lobe::Diffuse,
     ResourceType::IN_DIFF_HITDIST, ResourceType::OUT_DIFF_HITDIST, kR16, LOBE_HIT_DISTANCE},
    {kReblur, LobeFormat::HitDistance, Lobe::Specular,
     ResourceType::IN_SPEC_HITDIST, ResourceType::OUT_SPEC_HITDIST, kR16, LOBE_HIT_DISTANCE},
    {kReblur, LobeFormat::Direction, Lobe::Diffuse,
     ResourceType::IN_DIFF_DIRECTION_HITDIST, ResourceType::OUT_DIFF_DIRECTION_HITDIST, kRgba16Snorm, LOBE_DIRECTION},
    {kRelax, LobeFormat::Radiance, Lobe::Diffuse,
     ResourceType::IN_DIFF_RADIANCE_HITDIST, ResourceType::OUT_DIFF_RADIANCE_HITDIST, kRgba16, LOBE_RELAX},
    {kRelax, LobeFormat::Radiance, Lobe::Specular,
     ResourceType::IN_SPEC_RADIANCE_HITDIST, ResourceType::OUT_SPEC_RADIANCE_HITDIST, kRgba16, LOBE_RELAX},
    {kRelax, LobeFormat::Sh, Lobe::Diffuse,
     ResourceType::IN_DIFF_SH0, ResourceType::OUT_DIFF_SH0, kRgba16, LOBE_RELAX_SH0},
    {kRelax, LobeFormat::Sh, Lobe::Diffuse,
     ResourceType::IN_DIFF_SH1, ResourceType::OUT_DIFF_SH1, kRgba16, LOBE_RELAX_SH1},
    {kRelax, LobeFormat::Sh, Lobe::Specular,
     ResourceType::IN_SPEC_SH0, ResourceType::OUT_SPEC_SH0, kRgba16, LOBE_RELAX_SH0},
    {kRelax, LobeFormat::Sh, Lobe::Specular,
     ResourceType::IN_SPEC_SH1, ResourceType::OUT_SPEC_SH1, kRgba16, LOBE_RELAX_SH1},
};
// clang-format on

// As in the shaders.
struct PackConstants
{
    glm::vec4 hitDistanceParameters;
    glm::uvec2 size;
    uint32_t mode;
    uint32_t isDiffuse;
    uint32_t checkerboardMode;
    uint32_t frameIndex;
    int32_t stride;
};

struct UnpackConstants
{
    glm::uvec2 size;
    uint32_t mode;
    uint32_t isDiffuse;
    float denoisingRange;
};

} // namespace

LobeSignal::LobeSignal(const engine::Device& device, const LobeSignalDesc& desc) : m_desc(desc)
{
    const auto create = [&](ResourceType type, VkFormat format, uint32_t stride)
    {
        const uint32_t width = engine::groupCount(desc.width, stride), height = engine::groupCount(desc.height, stride);
        return engine::Image(device, {nrd::toString(type), width, height, format});
    };
    for (const SlotRow& row : kSlots)
    {
        if (row.family != desc.family || row.format != desc.format || row.lobe != desc.lobe) continue;
        m_inputs.push_back({row.input, row.mode, create(row.input, row.imageFormat, desc.stride)});
        m_outputs.push_back({row.output, row.mode, create(row.output, row.imageFormat, 1)});
    }
    if (desc.stride > 1 && desc.lobe == Lobe::Specular)
        m_inputs.push_back(
            {ResourceType::IN_SPEC_MV, LOBE_MOTION, create(ResourceType::IN_SPEC_MV, kRgba16, desc.stride)});
    m_values = engine::Image(device, {"unpacked lobe", desc.width, desc.height, VK_FORMAT_R32G32B32A32_SFLOAT});
    m_pack = createPixelPipeline(device, shaderBlob(Shader::PackLobe), 4, sizeof(PackConstants), 3);
    m_unpack = createPixelPipeline(device, shaderBlob(Shader::UnpackLobe), 4, sizeof(UnpackConstants));
}

std::vector<SlotImage> LobeSignal::slots()
{
    std::vector<SlotImage> all;
    for (std::vector<Slot>* list : {&m_inputs, &m_outputs})
        for (Slot& slot : *list) all.emplace_back(slot.type, &slot.image);
    return all;
}

void LobeSignal::recordPack(VkCommandBuffer cmd, FrameImages& frame, uint32_t frameIndex)
{
    const bool isDiffuse = m_desc.lobe == Lobe::Diffuse;
    engine::Image& signal = isDiffuse ? frame.diffuse : frame.specular;
    // Light has the direction it comes from, occlusion that of the ray whose distance it is.
    const bool isLight = m_desc.format == LobeFormat::Sh;
    engine::Image& direction = isDiffuse ? (isLight ? frame.diffuseOrigin : frame.diffuseDirection)
                                         : (isLight ? frame.specularOrigin : frame.specularDirection);
    for (engine::Image* in : {&frame.viewZ, &frame.normalRoughness, &signal, &direction, &frame.specularMotion})
        transition(cmd, *in, engine::kSampled);
    for (Slot& slot : m_inputs)
    {
        transition(cmd, slot.image, engine::kStorage);
        engine::Image& source = slot.mode == LOBE_MOTION ? frame.specularMotion : signal;
        if (!slot.set) slot.set = m_pack.createSet({frame.viewZ, frame.normalRoughness, source, direction, slot.image});
        const PackConstants constants = {glm::vec4(m_desc.hitDistanceParameters, 0.0f),
                                         glm::uvec2(slot.image.desc().width, slot.image.desc().height),
                                         slot.mode,
                                         isDiffuse,
                                         static_cast<uint32_t>(m_desc.checkerboard),
                                         frameIndex,
                                         static_cast<int32_t>(m_desc.stride)};
        dispatchPixels(cmd, m_pack, slot.set, constants, constants.size);
    }
}

void LobeSignal::recordUnpack(VkCommandBuffer cmd, FrameImages& frame, float denoisingRange)
{
    for (engine::Image* in : {&frame.viewZ, &frame.normalRoughness, &m_outputs.front().image, &m_outputs.back().image})
        transition(cmd, *in, engine::kSampled);
    transition(cmd, m_values, engine::kStorage);
    if (!m_unpackSet)
        m_unpackSet = m_unpack.createSet(
            {frame.viewZ, frame.normalRoughness, m_outputs.front().image, m_outputs.back().image, m_values});
    const UnpackConstants constants = {glm::uvec2(m_desc.width, m_desc.height), m_outputs.front().mode,
                                       m_desc.lobe == Lobe::Diffuse, denoisingRange};
    dispatchPixels(cmd, m_unpack, m_unpackSet, constants, constants.size);
}
} // namespace sample
