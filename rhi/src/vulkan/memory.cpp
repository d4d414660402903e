#include "memory.h"
#include "checks.h"

namespace rhi::vulkan
{
namespace
{
constexpr uint32_t kNoType = ~0u;
constexpr VkMemoryPropertyFlags kMapped = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;

uint32_t findType(const Context& context, uint32_t typeBits, VkMemoryPropertyFlags flags)
{
    for (uint32_t i = 0; i < context.memoryProperties.memoryTypeCount; i++)
        if ((typeBits >> i & 1) && (context.memoryProperties.memoryTypes[i].propertyFlags & flags) == flags) return i;
    return kNoType;
}

uint32_t chooseType(const Context& context, uint32_t typeBits, BufferMemory kind)
{
    VkMemoryPropertyFlags wanted = 0;
    VkMemoryPropertyFlags needed = 0;
    switch (kind)
    {
    case BufferMemory::Device:
        wanted = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
        break;
    case BufferMemory::Upload:
        wanted = needed = kMapped;
        break;
    case BufferMemory::Readback:
        wanted = kMapped | VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
        needed = kMapped;
        break;
    }
    const uint32_t best = findType(context, typeBits, wanted);
    return best != kNoType ? best : findType(context, typeBits, needed);
}
} // namespace

Allocation allocateMemory(const Context& context, const AllocationRequest& request)
{
    auto info = vkStruct<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
    info.allocationSize = request.needs.size;
    info.memoryTypeIndex = chooseType(context, request.needs.memoryTypeBits, request.kind);
    if (info.memoryTypeIndex == kNoType)
        throw Error(ErrorCode::Unsupported,
                    sentence("%s '%s': the device has no memory type for it", request.what, request.name));
    VkDeviceMemory memory = VK_NULL_HANDLE;
    const VkResult result = context.fn.allocateMemory(context.device, &info, context.callbacks, &memory);
    if (result == VK_ERROR_OUT_OF_DEVICE_MEMORY)
        throw Error(ErrorCode::OutOfDeviceMemory,
                    sentence("%s '%s': the device has no %llu bytes left", request.what, request.name,
                             static_cast<unsigned long long>(info.allocationSize)),
                    result);
    check(result, request.what, request.name);
    UniqueMemory owner(context, memory);
    context.setName(VK_OBJECT_TYPE_DEVICE_MEMORY, memory, request.name);
    return {MemoryLedger::Entry(context.ledger, request.memoryTag, info.allocationSize), std::move(owner)};
}

namespace
{
AllocationRequest toRequest(const Context& context, const MemoryDesc& desc, uint32_t& typeBits)
{
    const uint32_t type = chooseType(context, desc.memoryTypeBits, BufferMemory::Device);
    typeBits = type == kNoType ? 0 : 1u << type;
    return {{desc.size, 1, typeBits}, BufferMemory::Device, "memory", safeName(desc.name), safeName(desc.memoryTag)};
}
} // namespace

Memory::Memory(const Context& context, const MemoryDesc& desc)
    : rhi::Memory(desc), m_allocation(allocateMemory(context, toRequest(context, desc, m_typeBits))),
      m_memory(m_allocation.memory.get())
{
}
} // namespace rhi::vulkan
