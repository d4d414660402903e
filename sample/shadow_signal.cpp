#include "shadow_signal.h"

#include "nrd_sample_shaders.h"
#include "shaders/shadow_modes.h"

namespace sample
{
namespace
{
using nrd::ResourceType;

// As in the shaders.
struct PackConstants
{
    glm::uvec2 size;
    uint32_t mode;
    float tanAngularRadius;
    float lightSize;
    int32_t stride;
};

struct UnpackConstants
{
    glm::uvec2 size;
    uint32_t isTranslucent;
    float denoisingRange;
};
} // namespace

ShadowSignal::ShadowSignal(const engine::Device& device, const ShadowSignalDesc& desc) : m_desc(desc)
{
    const auto create = [&](ResourceType type, VkFormat format, uint32_t stride)
    {
        const uint32_t width = engine::groupCount(desc.width, stride), height = engine::groupCount(desc.height, stride);
        return engine::Image(device, {nrd::toString(type), width, height, format});
    };
    const auto add = [&](ResourceType type, uint32_t mode, VkFormat format) {
        m_inputs.push_back({type, mode, create(type, format, desc.stride)});
    };
    add(ResourceType::IN_PENUMBRA, SHADOW_PENUMBRA, VK_FORMAT_R16_SFLOAT);
    if (desc.isTranslucent) add(ResourceType::IN_TRANSLUCENCY, SHADOW_TRANSLUCENCY, VK_FORMAT_R8G8B8A8_UNORM);
    m_output = create(ResourceType::OUT_SHADOW_TRANSLUCENCY,
                      desc.isTranslucent ? VK_FORMAT_R8G8B8A8_UNORM : VK_FORMAT_R8_UNORM, 1);
    m_values = engine::Image(device, {"unpacked shadow", desc.width, desc.height, VK_FORMAT_R32G32B32A32_SFLOAT});
    m_pack = createPixelPipeline(device, shaderBlob(Shader::PackShadow), 2, sizeof(PackConstants), 2);
    m_unpack = createPixelPipeline(device, shaderBlob(Shader::UnpackShadow), 2, sizeof(UnpackConstants));
}

std::vector<SlotImage> ShadowSignal::slots()
{
    std::vector<SlotImage> all;
    for (Input& input : m_inputs) all.emplace_back(input.type, &input.image);
    all.emplace_back(ResourceType::OUT_SHADOW_TRANSLUCENCY, &m_output);
    return all;
}

void ShadowSignal::recordPack(VkCommandBuffer cmd, FrameImages& frame, const SceneLight& light)
{
    for (engine::Image* in : {&frame.shadow, &frame.sun}) transition(cmd, *in, engine::kSampled);
    for (Input& input : m_inputs)
    {
        transition(cmd, input.image, engine::kStorage);
        if (!input.set) input.set = m_pack.createSet({frame.shadow, frame.sun, input.image});
        const PackConstants constants = {glm::uvec2(input.image.desc().width, input.image.desc().height), input.mode,
                                         light.source.tanAngularRadius, 2.0f * light.source.radius,
                                         static_cast<int32_t>(m_desc.stride)};
        dispatchPixels(cmd, m_pack, input.set, constants, constants.size);
    }
}

void ShadowSignal::recordUnpack(VkCommandBuffer cmd, FrameImages& frame, float denoisingRange)
{
    for (engine::Image* in : {&frame.viewZ, &m_output}) transition(cmd, *in, engine::kSampled);
    transition(cmd, m_values, engine::kStorage);
    if (!m_unpackSet) m_unpackSet = m_unpack.createSet({frame.viewZ, m_output, m_values});
    const UnpackConstants constants = {glm::uvec2(m_desc.width, m_desc.height), m_desc.isTranslucent, denoisingRange};
    dispatchPixels(cmd, m_unpack, m_unpackSet, constants, constants.size);
}
} // namespace sample
