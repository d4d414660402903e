#include "device.h"
#include "buffer.h"
#include "checks.h"
#include "commands.h"
#include "convert.h"
#include "descriptors.h"
#include "queries.h"
#include "texture.h"

namespace rhi::vulkan
{
Device::Device(std::shared_ptr<OwnedDevice> owned, const VulkanNativeDevice& native)
    : m_owned(std::move(owned)), m_context(native), m_layouts(m_context)
{
}

FormatSupport Device::formatSupport(Format format) const
{
    const VkFormat vkFormat = toVulkan(format);
    if (vkFormat == VK_FORMAT_UNDEFINED) return FormatSupport::None;
    VkFormatProperties properties = {};
    m_context.instanceFn.getFormatProperties(m_context.physicalDevice, vkFormat, &properties);
    return toFormatSupport(properties.optimalTilingFeatures);
}

void Device::checkDesc(const TextureDesc& desc) const { checkTexture(desc, limits(), formatSupport(desc.format)); }

std::unique_ptr<rhi::Texture> Device::createTexture(const TextureDesc& desc)
{
    checkDesc(desc);
    return std::make_unique<Texture>(m_context, desc);
}

MemoryRequirements Device::textureMemoryRequirements(const TextureDesc& desc)
{
    checkDesc(desc);
    return memoryRequirements(m_context, createImage(m_context, desc));
}

std::unique_ptr<rhi::Memory> Device::createMemory(const MemoryDesc& desc)
{
    checkMemory(desc);
    return std::make_unique<Memory>(m_context, desc);
}

std::unique_ptr<rhi::Texture> Device::createPlacedTexture(const TextureDesc& desc, rhi::Memory& memory, uint64_t offset)
{
    checkDesc(desc);
    return std::make_unique<Texture>(m_context, desc, static_cast<const Memory&>(memory), offset);
}

std::unique_ptr<rhi::TextureView> Device::createView(const rhi::Texture& texture, const TextureViewDesc& desc)
{
    const TextureViewDesc resolved = checkView(texture.desc(), desc);
    return std::make_unique<TextureView>(m_context, static_cast<const Texture&>(texture), resolved);
}

std::unique_ptr<rhi::Buffer> Device::createBuffer(const BufferDesc& desc)
{
    checkBuffer(desc);
    return std::make_unique<Buffer>(m_context, desc);
}

std::unique_ptr<rhi::Pipeline> Device::createPipeline(const PipelineDesc& desc)
{
    checkPipeline(desc, limits());
    return std::make_unique<Pipeline>(m_context, m_layouts.find(desc.bindings), desc);
}

std::unique_ptr<rhi::DescriptorPool> Device::createDescriptorPool(const DescriptorPoolDesc& desc)
{
    checkDescriptorPool(desc);
    return std::make_unique<DescriptorPool>(m_context, desc);
}

std::unique_ptr<rhi::QueryPool> Device::createQueryPool(const QueryPoolDesc& desc)
{
    checkQueryPool(desc, limits());
    return std::make_unique<QueryPool>(m_context, desc);
}

std::unique_ptr<rhi::CommandBuffer> Device::createCommandBuffer(const char* name)
{
    return std::make_unique<CommandBuffer>(m_context, name);
}

std::unique_ptr<rhi::Fence> Device::createFence(const char* name) { return std::make_unique<Fence>(m_context, name); }

std::unique_ptr<rhi::Texture> Device::wrapTexture(uint64_t handle, const TextureDesc& desc)
{
    if (handle == 0) throwInvalid(sentence("texture '%s': the image to wrap is null", safeName(desc.name)));
    checkDesc(desc);
    return std::make_unique<Texture>(desc, rhi::detail::fromHandle<VkImage>(handle));
}

std::unique_ptr<rhi::Buffer> Device::wrapBuffer(uint64_t handle, const BufferDesc& desc)
{
    if (handle == 0) throwInvalid(sentence("buffer '%s': the buffer to wrap is null", safeName(desc.name)));
    checkBuffer(desc);
    return std::make_unique<Buffer>(desc, rhi::detail::fromHandle<VkBuffer>(handle));
}

std::unique_ptr<rhi::Memory> Device::wrapMemory(uint64_t handle, const MemoryDesc& desc)
{
    checkWrappedMemory(handle, desc);
    return std::make_unique<Memory>(desc, rhi::detail::fromHandle<VkDeviceMemory>(handle));
}

std::unique_ptr<rhi::CommandBuffer> Device::wrapCommandBuffer(uint64_t handle, const char* name)
{
    if (handle == 0) throwInvalid(sentence("command buffer '%s': the handle to wrap is null", safeName(name)));
    return std::make_unique<CommandBuffer>(m_context, rhi::detail::fromHandle<VkCommandBuffer>(handle), name);
}

VkQueue Device::queue() const
{
    if (!m_context.queue)
        throw Error(ErrorCode::Unsupported, "the wrapped device was given no queue, so the engine submits");
    return m_context.queue;
}

void Device::submit(Span<rhi::CommandBuffer* const> commandBuffers, rhi::Fence* fence)
{
    m_submission.clear();
    for (const rhi::CommandBuffer* commandBuffer : commandBuffers)
        m_submission.push_back(static_cast<const CommandBuffer*>(commandBuffer)->commandBuffer());
    auto submitInfo = vkStruct<VkSubmitInfo>(VK_STRUCTURE_TYPE_SUBMIT_INFO);
    submitInfo.commandBufferCount = static_cast<uint32_t>(m_submission.size());
    submitInfo.pCommandBuffers = m_submission.data();
    const VkFence vkFence = fence ? static_cast<const Fence*>(fence)->fence() : VK_NULL_HANDLE;
    check(m_context.fn.queueSubmit(queue(), 1, &submitInfo, vkFence), "submission to", info().name.c_str());
}

void Device::waitIdle() { check(m_context.fn.queueWaitIdle(queue()), "waiting for", info().name.c_str()); }
} // namespace rhi::vulkan

namespace rhi
{
std::unique_ptr<Device> wrapVulkanDevice(const VulkanNativeDevice& native)
{
    if (native.enabledFeatures)
        if (const char* missing = findMissingVulkanFeature(*native.enabledFeatures))
            throw Error(ErrorCode::Unsupported,
                        sentence("wrapped device: the feature %s is required and not enabled", missing));
    return std::make_unique<vulkan::Device>(nullptr, native);
}

VulkanHandles vulkanHandles(const Device& device)
{
    const auto* vulkanDevice = dynamic_cast<const vulkan::Device*>(&device.backend());
    if (!vulkanDevice) return {};
    const vulkan::Context& c = vulkanDevice->context();
    return {c.instance,         c.physicalDevice,      c.device,           c.queue,
            c.queueFamilyIndex, c.getInstanceProcAddr, c.getDeviceProcAddr};
}
} // namespace rhi
