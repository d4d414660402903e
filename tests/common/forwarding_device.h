// A device that passes everything on: what a test watches or changes, it overrides.
#pragma once
#include <rhi/device.h>
#include <vector>

namespace test
{
class ForwardingDevice : public rhi::Device
{
public:
    explicit ForwardingDevice(rhi::Device& device) : m_device(device) {}

    const rhi::DeviceInfo& info() const override { return m_device.info(); }
    rhi::FormatSupport formatSupport(rhi::Format format) const override { return m_device.formatSupport(format); }
    std::vector<rhi::MemoryReportLine> memoryReport() const override { return m_device.memoryReport(); }
    std::unique_ptr<rhi::Texture> createTexture(const rhi::TextureDesc& desc) override
    {
        return m_device.createTexture(desc);
    }
    rhi::MemoryRequirements textureMemoryRequirements(const rhi::TextureDesc& desc) override
    {
        return m_device.textureMemoryRequirements(desc);
    }
    std::unique_ptr<rhi::Memory> createMemory(const rhi::MemoryDesc& desc) override
    {
        return m_device.createMemory(desc);
    }
    std::unique_ptr<rhi::Texture> createPlacedTexture(const rhi::TextureDesc& desc, rhi::Memory& memory,
                                                      uint64_t offset) override
    {
        return m_device.createPlacedTexture(desc, memory, offset);
    }
    std::unique_ptr<rhi::TextureView> createView(const rhi::Texture& texture, const rhi::TextureViewDesc& desc) override
    {
        return m_device.createView(texture, desc);
    }
    std::unique_ptr<rhi::Buffer> createBuffer(const rhi::BufferDesc& desc) override
    {
        return m_device.createBuffer(desc);
    }
    std::unique_ptr<rhi::Pipeline> createPipeline(const rhi::PipelineDesc& desc) override
    {
        return m_device.createPipeline(desc);
    }
    std::unique_ptr<rhi::DescriptorPool> createDescriptorPool(const rhi::DescriptorPoolDesc& desc) override
    {
        return m_device.createDescriptorPool(desc);
    }
    std::unique_ptr<rhi::QueryPool> createQueryPool(const rhi::QueryPoolDesc& desc) override
    {
        return m_device.createQueryPool(desc);
    }
    std::unique_ptr<rhi::CommandBuffer> createCommandBuffer(const char* name) override
    {
        return m_device.createCommandBuffer(name);
    }
    std::unique_ptr<rhi::Fence> createFence(const char* name) override { return m_device.createFence(name); }
    std::unique_ptr<rhi::Texture> wrapTexture(uint64_t handle, const rhi::TextureDesc& desc) override
    {
        return m_device.wrapTexture(handle, desc);
    }
    std::unique_ptr<rhi::Buffer> wrapBuffer(uint64_t handle, const rhi::BufferDesc& desc) override
    {
        return m_device.wrapBuffer(handle, desc);
    }
    std::unique_ptr<rhi::Memory> wrapMemory(uint64_t handle, const rhi::MemoryDesc& desc) override
    {
        return m_device.wrapMemory(handle, desc);
    }
    std::unique_ptr<rhi::CommandBuffer> wrapCommandBuffer(uint64_t handle, const char* name) override
    {
        return m_device.wrapCommandBuffer(handle, name);
    }
    void submit(rhi::Span<rhi::CommandBuffer* const> commandBuffers, rhi::Fence* fence) override
    {
        m_device.submit(commandBuffers, fence);
    }
    void waitIdle() override { m_device.waitIdle(); }

private:
    rhi::Device& m_device;
};
} // namespace test
