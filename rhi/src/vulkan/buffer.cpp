#include "buffer.h"
#include "checks.h"
#include "convert.h"

namespace rhi::vulkan
{
namespace
{
UniqueBuffer createHandle(const Context& context, const BufferDesc& desc)
{
    auto info = vkStruct<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
    info.size = desc.size;
    info.usage = toVulkan(desc.usage);
    info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
    VkBuffer buffer = VK_NULL_HANDLE;
    check(context.fn.createBuffer(context.device, &info, context.callbacks, &buffer), "buffer", desc.name);
    return UniqueBuffer(context, buffer);
}
} // namespace

Buffer::Buffer(const Context& context, const BufferDesc& desc)
    : rhi::Buffer(desc), m_owned(createHandle(context, desc)), m_buffer(m_owned.get())
{
    VkMemoryRequirements needs = {};
    context.fn.getBufferMemoryRequirements(context.device, m_buffer, &needs);
    m_allocation = allocateMemory(context, {needs, desc.memory, "buffer", name(), safeName(desc.memoryTag)});
    const VkDeviceMemory memory = m_allocation.memory.get();
    check(context.fn.bindBufferMemory(context.device, m_buffer, memory, 0), "buffer", name());
    if (desc.memory != BufferMemory::Device)
        check(context.fn.mapMemory(context.device, memory, 0, VK_WHOLE_SIZE, 0, &m_mapped), "buffer", name());
    context.setName(VK_OBJECT_TYPE_BUFFER, m_buffer, name());
}
} // namespace rhi::vulkan
