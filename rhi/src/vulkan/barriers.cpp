// The barriers of a command buffer, in the numbers of synchronization2 or of Vulkan 1.0.
#include "buffer.h"
#include "checks.h"
#include "commands.h"
#include "convert.h"
#include "texture.h"

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
} // namespace

void CommandBuffer::barriers(Span<const TextureBarrier> textures, Span<const BufferBarrier> buffers)
{
    if (textures.empty() && buffers.empty()) return;
    if (m_context.info.hasSynchronization2)
        recordBarriers2(textures, buffers);
    else
        recordLegacyBarriers(textures, buffers);
}

void CommandBuffer::recordBarriers2(Span<const TextureBarrier> textures, Span<const BufferBarrier> buffers)
{
    m_imageBarriers2.clear();
    m_bufferBarriers2.clear();
    for (const TextureBarrier& b : textures)
    {
        const NativeState before = rhi::toVulkan(b.before);
        const NativeState after = rhi::toVulkan(b.after);
        const VkImage image = static_cast<const Texture*>(b.texture)->image();
        m_imageBarriers2.push_back({VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2, nullptr, before.stages, before.access,
                                    after.stages, after.access, static_cast<VkImageLayout>(before.layout),
                                    static_cast<VkImageLayout>(after.layout), VK_QUEUE_FAMILY_IGNORED,
                                    VK_QUEUE_FAMILY_IGNORED, image, subresources(b)});
    }
    for (const BufferBarrier& b : buffers)
    {
        const NativeState before = toVulkan(b.before);
        const NativeState after = toVulkan(b.after);
        const VkBuffer buffer = static_cast<const Buffer*>(b.buffer)->buffer();
        m_bufferBarriers2.push_back({VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER_2, nullptr, before.stages, before.access,
                                     after.stages, after.access, VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED,
                                     buffer, 0, VK_WHOLE_SIZE});
    }
    auto info = vkStruct<VkDependencyInfo>(VK_STRUCTURE_TYPE_DEPENDENCY_INFO);
    info.bufferMemoryBarrierCount = static_cast<uint32_t>(m_bufferBarriers2.size());
    info.pBufferMemoryBarriers = m_bufferBarriers2.data();
    info.imageMemoryBarrierCount = static_cast<uint32_t>(m_imageBarriers2.size());
    info.pImageMemoryBarriers = m_imageBarriers2.data();
    m_context.fn.cmdPipelineBarrier2(m_commandBuffer, &info);
}

void CommandBuffer::recordLegacyBarriers(Span<const TextureBarrier> textures, Span<const BufferBarrier> buffers)
{
    m_imageBarriers.clear();
    m_bufferBarriers.clear();
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
        m_imageBarriers.push_back({VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER, nullptr, srcAccess, dstAccess,
                                   static_cast<VkImageLayout>(before.layout), static_cast<VkImageLayout>(after.layout),
                                   VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED,
                                   static_cast<const Texture*>(b.texture)->image(), subresources(b)});
    }
    for (const BufferBarrier& b : buffers)
    {
        const auto [srcAccess, dstAccess] = scopes(toVulkan(b.before), toVulkan(b.after));
        m_bufferBarriers.push_back({VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER, nullptr, srcAccess, dstAccess,
                                    VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED,
                                    static_cast<const Buffer*>(b.buffer)->buffer(), 0, VK_WHOLE_SIZE});
    }
    m_context.fn.cmdPipelineBarrier(m_commandBuffer, beforeStages, afterStages, 0, 0, nullptr,
                                    static_cast<uint32_t>(m_bufferBarriers.size()), m_bufferBarriers.data(),
                                    static_cast<uint32_t>(m_imageBarriers.size()), m_imageBarriers.data());
}
} // namespace rhi::vulkan
