#include "commands.h"
#include "buffer.h"
#include "checks.h"
#include "convert.h"
#include "descriptors.h"
#include "queries.h"
#include "texture.h"

namespace rhi::vulkan
{
namespace
{
VkImage imageOf(const rhi::Texture& texture) { return static_cast<const Texture&>(texture).image(); }

VkBuffer bufferOf(const rhi::Buffer& buffer) { return static_cast<const Buffer&>(buffer).buffer(); }

VkImageSubresourceLayers mipLayers(const rhi::Texture& texture, uint32_t mip)
{
    return {aspectOf(texture.desc().format), mip, 0, 1};
}

VkBufferImageCopy copyRegion(const TextureCopy& copy)
{
    const rhi::Texture& texture = *copy.texture;
    VkBufferImageCopy region = {};
    region.bufferOffset = copy.bufferOffset;
    region.imageSubresource = mipLayers(texture, copy.mip);
    region.imageExtent = {texture.mipWidth(copy.mip), texture.mipHeight(copy.mip), 1};
    return region;
}
} // namespace

CommandBuffer::CommandBuffer(const Context& context, const char* name) : rhi::CommandBuffer(name), m_context(context)
{
    auto poolInfo = vkStruct<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
    poolInfo.queueFamilyIndex = context.queueFamilyIndex;
    VkCommandPool pool = VK_NULL_HANDLE;
    check(context.fn.createCommandPool(context.device, &poolInfo, context.callbacks, &pool), "command buffer", name);
    m_pool = UniqueCommandPool(context, pool);
    auto info = vkStruct<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
    info.commandPool = pool;
    info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    info.commandBufferCount = 1;
    check(context.fn.allocateCommandBuffers(context.device, &info, &m_commandBuffer), "command buffer", name);
    context.setName(VK_OBJECT_TYPE_COMMAND_BUFFER, m_commandBuffer, this->name());
}

CommandBuffer::CommandBuffer(const Context& context, VkCommandBuffer commandBuffer, const char* name)
    : rhi::CommandBuffer(name), m_context(context), m_commandBuffer(commandBuffer)
{
}

void CommandBuffer::requireOwned(const char* call) const
{
    if (!m_pool.get())
        throwInvalid(sentence("command buffer '%s': %s() on a wrapped command buffer, which the engine begins and ends",
                              name(), call));
}

void CommandBuffer::begin()
{
    requireOwned("begin");
    m_pipeline = nullptr;
    check(m_context.fn.resetCommandPool(m_context.device, m_pool.get(), 0), "command buffer", name());
    const auto info = vkStruct<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
    check(m_context.fn.beginCommandBuffer(m_commandBuffer, &info), "command buffer", name());
}

void CommandBuffer::end()
{
    requireOwned("end");
    check(m_context.fn.endCommandBuffer(m_commandBuffer), "command buffer", name());
}

void CommandBuffer::bindPipeline(const rhi::Pipeline& pipeline)
{
    m_pipeline = static_cast<const Pipeline*>(&pipeline);
    m_context.fn.cmdBindPipeline(m_commandBuffer, VK_PIPELINE_BIND_POINT_COMPUTE, m_pipeline->pipeline());
}

void CommandBuffer::bindSet(uint32_t set, const rhi::DescriptorSet& descriptorSet, Span<const uint32_t> dynamicOffsets)
{
    const VkDescriptorSet handle = static_cast<const DescriptorSet&>(descriptorSet).set();
    m_context.fn.cmdBindDescriptorSets(m_commandBuffer, VK_PIPELINE_BIND_POINT_COMPUTE,
                                       m_pipeline->layout().owner.get(), set, 1, &handle,
                                       static_cast<uint32_t>(dynamicOffsets.size()), dynamicOffsets.data());
}

void CommandBuffer::dispatch(uint32_t x, uint32_t y, uint32_t z)
{
    if (x == 0 || y == 0 || z == 0) return;
    m_context.fn.cmdDispatch(m_commandBuffer, x, y, z);
}

void CommandBuffer::dispatchIndirect(const rhi::Buffer& arguments, uint64_t offset)
{
    m_context.fn.cmdDispatchIndirect(m_commandBuffer, bufferOf(arguments), offset);
}

void CommandBuffer::copyBufferToTexture(const TextureCopy& copy, Layout layout)
{
    const VkBufferImageCopy region = copyRegion(copy);
    m_context.fn.cmdCopyBufferToImage(m_commandBuffer, bufferOf(*copy.buffer), imageOf(*copy.texture), toVulkan(layout),
                                      1, &region);
}

void CommandBuffer::copyTextureToBuffer(const TextureCopy& copy, Layout layout)
{
    const VkBufferImageCopy region = copyRegion(copy);
    m_context.fn.cmdCopyImageToBuffer(m_commandBuffer, imageOf(*copy.texture), toVulkan(layout), bufferOf(*copy.buffer),
                                      1, &region);
}

void CommandBuffer::copyTexture(const rhi::Texture& src, const rhi::Texture& dst)
{
    VkImageCopy region = {};
    region.srcSubresource = mipLayers(src, 0);
    region.dstSubresource = mipLayers(dst, 0);
    region.extent = {src.desc().width, src.desc().height, 1};
    m_context.fn.cmdCopyImage(m_commandBuffer, imageOf(src), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, imageOf(dst),
                              VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
}

void CommandBuffer::copyBuffer(const BufferCopy& copy)
{
    const VkBufferCopy region = {copy.srcOffset, copy.dstOffset, copy.size};
    m_context.fn.cmdCopyBuffer(m_commandBuffer, bufferOf(*copy.src), bufferOf(*copy.dst), 1, &region);
}

void CommandBuffer::fillBuffer(const rhi::Buffer& buffer, uint64_t offset, uint64_t size, uint32_t value)
{
    m_context.fn.cmdFillBuffer(m_commandBuffer, bufferOf(buffer), offset, size, value);
}

void CommandBuffer::clearTexture(const rhi::Texture& texture, MipRange mips, const ClearColor& color, Layout layout)
{
    VkClearColorValue value = {};
    for (size_t i = 0; i < 4; i++)
    {
        if (color.isUint)
            value.uint32[i] = color.u[i];
        else
            value.float32[i] = color.f[i];
    }
    const MipRange range = resolveMips(mips, texture.desc().mipCount);
    const VkImageSubresourceRange subresources = {VK_IMAGE_ASPECT_COLOR_BIT, range.first, range.count, 0, 1};
    m_context.fn.cmdClearColorImage(m_commandBuffer, imageOf(texture), toVulkan(layout), &value, 1, &subresources);
}

void CommandBuffer::resetQueries(const rhi::QueryPool& pool, uint32_t first, uint32_t count)
{
    m_context.fn.cmdResetQueryPool(m_commandBuffer, static_cast<const QueryPool&>(pool).pool(), first, count);
}

void CommandBuffer::writeTimestamp(const rhi::QueryPool& pool, uint32_t query, Stage stage)
{
    const LegacyScope scope = toLegacy(toVulkan(BufferState{Access::None, stage}), VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT);
    // BOTTOM_OF_PIPE, since vkCmdWriteTimestamp takes exactly one stage and ALL_COMMANDS is the union of several.
    const bool isAll = stage == Stage::AllCommands;
    m_context.fn.cmdWriteTimestamp(m_commandBuffer,
                                   isAll ? VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT
                                         : static_cast<VkPipelineStageFlagBits>(scope.stages),
                                   static_cast<const QueryPool&>(pool).pool(), query);
}

void CommandBuffer::beginLabel(const char* text)
{
    if (!m_context.info.hasDebugLabels) return;
    auto label = vkStruct<VkDebugUtilsLabelEXT>(VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT);
    label.pLabelName = text;
    m_context.debugFn.cmdBeginLabel(m_commandBuffer, &label);
}

void CommandBuffer::endLabel()
{
    if (m_context.info.hasDebugLabels) m_context.debugFn.cmdEndLabel(m_commandBuffer);
}
} // namespace rhi::vulkan
