// The barriers of a command buffer, in the numbers of synchronization2 or of Vulkan 1.0.
#include "buffer.h"
#include "checks.h"
#include "commands.h"
#include "convert.h"
#include "texture.h"
#include <algorithm>
#include <array>

namespace rhi::vulkan
{
namespace
{
VkImageSubresourceRange subresources(const TextureBarrier& barrier)
{
    const TextureDesc& desc = barrier.texture->desc();
    const MipRange mips = resolveMips(barrier.mips, desc.mipCount);
    return {aspectOf(desc.format), mips.first, mips.count, 0, 1};
}

// Recording takes no memory, so that it cannot fail: longer lists become several batches.
constexpr size_t kBatchSize = 64;

template <class T> class Batch
{
public:
    void add(const T& barrier) { m_barriers[m_count++] = barrier; }
    const T* data() const { return m_barriers.data(); }
    uint32_t size() const { return m_count; }

private:
    std::array<T, kBatchSize> m_barriers;
    uint32_t m_count = 0;
};

template <class T> Span<T> batchOf(Span<T> all, size_t first)
{
    const size_t begin = std::min(first, all.size());
    return {all.data() + begin, std::min(kBatchSize, all.size() - begin)};
}
} // namespace

void CommandBuffer::barriers(Span<const TextureBarrier> textures, Span<const BufferBarrier> buffers)
{
    for (size_t first = 0; first < std::max(textures.size(), buffers.size()); first += kBatchSize)
    {
        if (m_context.info.hasSynchronization2)
            recordBarriers2(batchOf(textures, first), batchOf(buffers, first));
        else
            recordLegacyBarriers(batchOf(textures, first), batchOf(buffers, first));
    }
}

void CommandBuffer::recordBarriers2(Span<const TextureBarrier> textures, Span<const BufferBarrier> buffers)
{
    Batch<VkImageMemoryBarrier2> imageBarriers;
    Batch<VkBufferMemoryBarrier2> bufferBarriers;
    for (const TextureBarrier& b : textures)
    {
        const NativeState before = rhi::toVulkan(b.before);
        const NativeState after = rhi::toVulkan(b.after);
        const VkImage image = static_cast<const Texture*>(b.texture)->image();
        imageBarriers.add({VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2, nullptr, before.stages, before.access,
                           after.stages, after.access, static_cast<VkImageLayout>(before.layout),
                           static_cast<VkImageLayout>(after.layout), VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED,
                           image, subresources(b)});
    }
    for (const BufferBarrier& b : buffers)
    {
        const NativeState before = toVulkan(b.before);
        const NativeState after = toVulkan(b.after);
        const VkBuffer buffer = static_cast<const Buffer*>(b.buffer)->buffer();
        bufferBarriers.add({VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER_2, nullptr, before.stages, before.access,
                            after.stages, after.access, VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED, buffer, 0,
                            VK_WHOLE_SIZE});
    }
    auto info = vkStruct<VkDependencyInfo>(VK_STRUCTURE_TYPE_DEPENDENCY_INFO);
    info.bufferMemoryBarrierCount = bufferBarriers.size();
    info.pBufferMemoryBarriers = bufferBarriers.data();
    info.imageMemoryBarrierCount = imageBarriers.size();
    info.pImageMemoryBarriers = imageBarriers.data();
    m_context.fn.cmdPipelineBarrier2(m_commandBuffer, &info);
}

void CommandBuffer::recordLegacyBarriers(Span<const TextureBarrier> textures, Span<const BufferBarrier> buffers)
{
    Batch<VkImageMemoryBarrier> imageBarriers;
    Batch<VkBufferMemoryBarrier> bufferBarriers;
    VkPipelineStageFlags beforeStages = 0;
    VkPipelineStageFlags afterStages = 0;
    const auto scopes = [&](const NativeState& before, const NativeState& after)
    {
        const LegacyScope src = toLegacy(before, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT);
        const LegacyScope dst = toLegacy(after, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT);
        beforeStages |= src.stages;
        afterStages |= dst.stages;
        return std::pair(src.access, dst.access);
    };
    for (const TextureBarrier& b : textures)
    {
        const NativeState before = rhi::toVulkan(b.before);
        const NativeState after = rhi::toVulkan(b.after);
        const auto [srcAccess, dstAccess] = scopes(before, after);
        imageBarriers.add({VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER, nullptr, srcAccess, dstAccess,
                           static_cast<VkImageLayout>(before.layout), static_cast<VkImageLayout>(after.layout),
                           VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED,
                           static_cast<const Texture*>(b.texture)->image(), subresources(b)});
    }
    for (const BufferBarrier& b : buffers)
    {
        const auto [srcAccess, dstAccess] = scopes(toVulkan(b.before), toVulkan(b.after));
        bufferBarriers.add({VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER, nullptr, srcAccess, dstAccess,
                            VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED,
                            static_cast<const Buffer*>(b.buffer)->buffer(), 0, VK_WHOLE_SIZE});
    }
    m_context.fn.cmdPipelineBarrier(m_commandBuffer, beforeStages, afterStages, 0, 0, nullptr, bufferBarriers.size(),
                                    bufferBarriers.data(), imageBarriers.size(), imageBarriers.data());
}

void CommandBuffer::barrier(const MemoryBarrier& memory)
{
    const NativeState before = toVulkan(memory.before);
    const NativeState after = toVulkan(memory.after);
    if (m_context.info.hasSynchronization2)
    {
        const VkMemoryBarrier2 barrier = {
            VK_STRUCTURE_TYPE_MEMORY_BARRIER_2, nullptr, before.stages, before.access, after.stages, after.access};
        auto info = vkStruct<VkDependencyInfo>(VK_STRUCTURE_TYPE_DEPENDENCY_INFO);
        info.memoryBarrierCount = 1;
        info.pMemoryBarriers = &barrier;
        m_context.fn.cmdPipelineBarrier2(m_commandBuffer, &info);
        return;
    }
    const LegacyScope src = toLegacy(before, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT);
    const LegacyScope dst = toLegacy(after, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT);
    const VkMemoryBarrier barrier = {VK_STRUCTURE_TYPE_MEMORY_BARRIER, nullptr, src.access, dst.access};
    m_context.fn.cmdPipelineBarrier(m_commandBuffer, src.stages, dst.stages, 0, 1, &barrier, 0, nullptr, 0, nullptr);
}
} // namespace rhi::vulkan
