#include "replay_packing.h"
#include "replay_camera.h"
#include "replay_shaders.h"
#include "shaders/replay_modes.h"

#include <algorithm>

namespace sample
{
namespace
{
constexpr uint32_t kGroupSize = 8;
constexpr size_t kSampledCount = 4;
constexpr uint32_t kMaxSetCount = 64; // slots of a user pool, SH outputs twice

engine::ComputePipeline makePipeline(const engine::Device& device, replay::Shader shader, uint32_t constantsByteSize)
{
    const replay::ShaderBlob blob = replay::shaderBlob(shader);
    engine::ComputeDesc desc;
    desc.name = blob.name;
    desc.words = blob.words;
    desc.byteSize = blob.byteSize;
    desc.pushConstantByteSize = constantsByteSize;
    desc.setCount = kMaxSetCount;
    desc.bindings.assign(kSampledCount, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE);
    desc.bindings.push_back(VK_DESCRIPTOR_TYPE_STORAGE_IMAGE);
    return {device, desc};
}

template <class Constants>
void dispatch(const engine::ComputePipeline& pipeline, VkCommandBuffer cmd, VkDescriptorSet set,
              const Constants& constants)
{
    pipeline.dispatch(
        cmd, set, std::as_bytes(std::span(&constants, 1)),
        {engine::groupCount(constants.size[0], kGroupSize), engine::groupCount(constants.size[1], kGroupSize), 1});
}
} // namespace

void setLight(PackConstants& constants, const CaptureInfo& info, size_t frameIndex)
{
    const CaptureLight* light = lightOf(info, frameIndex);
    if (!light) return;
    const CaptureFrame& frame = info.frames.at(frameIndex);
    const std::array<double, 4> frustum = frustumOf(frame.viewToClip);
    std::transform(frustum.begin(), frustum.end(), constants.frustum, [](double v) { return static_cast<float>(v); });
    constants.lightKind = light->isLocal ? REPLAY_LIGHT_LOCAL : REPLAY_LIGHT_SUN;
    constants.light[3] = static_cast<float>(light->isLocal ? light->radius : light->tanAngularRadius);
    for (size_t row = 0; row < 3; row++)
    {
        double x = frame.worldToView[12 + row];
        for (size_t column = 0; column < 3; column++)
            x += frame.worldToView[column * 4 + row] * light->position[column];
        constants.light[row] = static_cast<float>(x);
    }
}

UnpackConstants unpackConstantsOf(const CaptureInfo& info, size_t frameIndex)
{
    const CaptureFrame& frame = info.frames.at(frameIndex);
    UnpackConstants constants = {};
    for (size_t i = 0; i < 16; i++) constants.worldToView[i] = static_cast<float>(frame.worldToView[i]);
    const std::array<double, 4> frustum = frustumOf(frame.viewToClip);
    std::transform(frustum.begin(), frustum.end(), constants.frustum, [](double v) { return static_cast<float>(v); });
    constants.size[0] = static_cast<uint32_t>(info.width);
    constants.size[1] = static_cast<uint32_t>(info.height);
    for (size_t i = 0; i < 2; i++) constants.jitter[i] = static_cast<float>(frame.jitter[i]);
    return constants;
}

ReplayPacking::ReplayPacking(const engine::Device& device)
    : m_pack(makePipeline(device, replay::Shader::ReplayPack, sizeof(PackConstants))),
      m_unpack(makePipeline(device, replay::Shader::ReplayUnpack, sizeof(UnpackConstants)))
{
}

VkDescriptorSet ReplayPacking::createSet(const PackImages& images) const
{
    return m_pack.createSet({images.layer, images.direction, images.guides, images.depth, images.slot});
}

VkDescriptorSet ReplayPacking::createSet(const UnpackImages& images) const
{
    return m_unpack.createSet({images.slot, images.sh1, images.guides, images.depth, images.values});
}

void ReplayPacking::pack(VkCommandBuffer cmd, VkDescriptorSet set, const PackConstants& constants) const
{
    dispatch(m_pack, cmd, set, constants);
}

void ReplayPacking::unpack(VkCommandBuffer cmd, VkDescriptorSet set, const UnpackConstants& constants) const
{
    dispatch(m_unpack, cmd, set, constants);
}
} // namespace sample
