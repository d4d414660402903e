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
    const auto create = [&](ResourceType type, VkFormat format) {
        return engine::Image(device, {nrd::toString(type), desc.width, desc.height, format});
    };
    m_inputs.push_back(
        {ResourceType::IN_PENUMBRA, SHADOW_PENUMBRA, create(ResourceType::IN_PENUMBRA, VK_FORMAT_R16_SFLOAT)});
    if (desc.isTranslucent)
        m_inputs.push_back({ResourceType::IN_TRANSLUCENCY, SHADOW_TRANSLUCENCY,
                            create(ResourceType::IN_TRANSLUCENCY, VK_FORMAT_R8G8B8A8_UNORM)});
    m_output = create(ResourceType::OUT_SHADOW_TRANSLUCENCY,
                      desc.isTranslucent ? VK_FORMAT_R8G8B8A8_UNORM : VK_FORMAT_R8_UNORM);
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
        const PackConstants constants = {glm::uvec2(m_desc.width, m_desc.height), input.mode,
                                         light.source.tanAngularRadius, 2.0f * light.source.radius};
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
