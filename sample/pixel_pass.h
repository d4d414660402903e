// A compute pass over the pixels of a picture: sampled images in, one storage image out, push constants.
#pragma once
#include "engine/compute.h"

#include <glm/glm.hpp>

namespace sample
{
/// `blob` is any generated shader library's. `setCount`: descriptor sets that will be made.
template <class Blob>
engine::ComputePipeline createPixelPipeline(const engine::Device& device, const Blob& blob, uint32_t sampledCount,
                                            uint32_t constantsByteSize, uint32_t setCount = 1)
{
    engine::ComputeDesc pipeline;
    pipeline.name = blob.name;
    pipeline.words = blob.words;
    pipeline.byteSize = blob.byteSize;
    pipeline.bindings.assign(sampledCount, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE);
    pipeline.bindings.push_back(VK_DESCRIPTOR_TYPE_STORAGE_IMAGE);
    pipeline.pushConstantByteSize = constantsByteSize;
    pipeline.setCount = setCount;
    return {device, pipeline};
}

/// In groups of 8 x 8.
template <class Constants>
void dispatchPixels(VkCommandBuffer cmd, engine::ComputePipeline& pipeline, VkDescriptorSet set,
                    const Constants& constants, const glm::uvec2& size)
{
    pipeline.dispatch(cmd, set, std::as_bytes(std::span(&constants, 1)),
                      {engine::groupCount(size.x, 8), engine::groupCount(size.y, 8), 1});
}
} // namespace sample
