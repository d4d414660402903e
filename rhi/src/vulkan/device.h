#pragma once
#include "adapter.h"
#include "context.h"
#include "layouts.h"
#include <memory>
#include <vector>

namespace rhi::vulkan
{
class Device final : public rhi::Device
{
public:
    /// `owned` (may be null) holds the native device if it is ours. Shared, since its deleter comes with it: who only
    /// wraps devices links nothing of how they are made, and so not the loader.
    Device(std::shared_ptr<OwnedDevice> owned, const VulkanNativeDevice& native);

    const Context& context() const { return m_context; }

    const DeviceInfo& info() const override { return m_context.info; }
    FormatSupport formatSupport(Format format) const override;
    std::vector<MemoryReportLine> memoryReport() const override { return m_context.ledger.report(); }

    std::unique_ptr<rhi::Texture> createTexture(const TextureDesc& desc) override;
    MemoryRequirements textureMemoryRequirements(const TextureDesc& desc) override;
    std::unique_ptr<rhi::Memory> createMemory(const MemoryDesc& desc) override;
    std::unique_ptr<rhi::Texture> createPlacedTexture(const TextureDesc& desc, rhi::Memory& memory,
                                                      uint64_t offset) override;
    std::unique_ptr<rhi::TextureView> createView(const rhi::Texture& texture, const TextureViewDesc& desc) override;
    std::unique_ptr<rhi::Buffer> createBuffer(const BufferDesc& desc) override;
    std::unique_ptr<rhi::Pipeline> createPipeline(const PipelineDesc& desc) override;
    std::unique_ptr<rhi::DescriptorPool> createDescriptorPool(const DescriptorPoolDesc& desc) override;
    std::unique_ptr<rhi::QueryPool> createQueryPool(const QueryPoolDesc& desc) override;
    std::unique_ptr<rhi::CommandBuffer> createCommandBuffer(const char* name) override;
    std::unique_ptr<rhi::Fence> createFence(const char* name) override;

    std::unique_ptr<rhi::Texture> wrapTexture(uint64_t handle, const TextureDesc& desc) override;
    std::unique_ptr<rhi::Buffer> wrapBuffer(uint64_t handle, const BufferDesc& desc) override;
    std::unique_ptr<rhi::Memory> wrapMemory(uint64_t handle, const MemoryDesc& desc) override;
    std::unique_ptr<rhi::CommandBuffer> wrapCommandBuffer(uint64_t handle, const char* name) override;

    void submit(Span<rhi::CommandBuffer* const> commandBuffers, rhi::Fence* fence) override;
    void waitIdle() override;

private:
    void checkDesc(const TextureDesc& desc) const;
    VkQueue queue() const;

    std::shared_ptr<OwnedDevice> m_owned; // null when the application lent us the device; destroyed last
    Context m_context;
    LayoutCache m_layouts;
    std::vector<VkCommandBuffer> m_submission; // kept to keep its memory
};
} // namespace rhi::vulkan
