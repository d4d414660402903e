#pragma once
#include "context.h"
#include "pipeline.h"

namespace rhi::vulkan
{
class CommandBuffer final : public rhi::CommandBuffer
{
public:
    /// With a pool of its own.
    CommandBuffer(const Context& context, const char* name);
    /// Borrows the command buffer of an engine, which records it.
    CommandBuffer(const Context& context, VkCommandBuffer commandBuffer, const char* name);

    uint64_t nativeHandle() const override { return rhi::detail::toHandle(m_commandBuffer); }
    VkCommandBuffer commandBuffer() const { return m_commandBuffer; }

    void begin() override;
    void end() override;
    void bindPipeline(const rhi::Pipeline& pipeline) override;
    void bindSet(uint32_t set, const rhi::DescriptorSet& descriptorSet, Span<const uint32_t> dynamicOffsets) override;
    void dispatch(uint32_t x, uint32_t y, uint32_t z) override;
    void dispatchIndirect(const rhi::Buffer& arguments, uint64_t offset) override;
    void barriers(Span<const TextureBarrier> textures, Span<const BufferBarrier> buffers) override;
    void barrier(const MemoryBarrier& memory) override;
    void copyBufferToTexture(const TextureCopy& copy, Layout layout) override;
    void copyTextureToBuffer(const TextureCopy& copy, Layout layout) override;
    void copyTexture(const rhi::Texture& src, const rhi::Texture& dst) override;
    void copyBuffer(const BufferCopy& copy) override;
    void fillBuffer(const rhi::Buffer& buffer, uint64_t offset, uint64_t size, uint32_t value) override;
    void clearTexture(const rhi::Texture& texture, MipRange mips, const ClearColor& color, Layout layout) override;
    void resetQueries(const rhi::QueryPool& pool, uint32_t first, uint32_t count) override;
    void writeTimestamp(const rhi::QueryPool& pool, uint32_t query, Stage stage) override;
    void beginLabel(const char* text) override;
    void endLabel() override;

private:
    void requireOwned(const char* call) const;
    void recordBarriers2(Span<const TextureBarrier> textures, Span<const BufferBarrier> buffers);
    void recordLegacyBarriers(Span<const TextureBarrier> textures, Span<const BufferBarrier> buffers);

    const Context& m_context;
    UniqueCommandPool m_pool; // empty when the application lent us the command buffer
    VkCommandBuffer m_commandBuffer = VK_NULL_HANDLE;
    const Pipeline* m_pipeline = nullptr;
};
} // namespace rhi::vulkan
