// Device memory, and its line in the memory report.
#pragma once
#include "context.h"

namespace rhi::vulkan
{
struct Allocation
{
    MemoryLedger::Entry entry;
    UniqueMemory memory;
};

struct AllocationRequest
{
    VkMemoryRequirements needs = {};
    BufferMemory kind = BufferMemory::Device;
    const char* what = "";      // "texture", "buffer", "memory": the beginning of an error's sentence
    const char* name = "";      // of the object
    const char* memoryTag = ""; // line of the report
};

/// Throws OutOfDeviceMemory, or Unsupported if no memory type fits.
Allocation allocateMemory(const Context& context, const AllocationRequest& request);

class Memory final : public rhi::Memory
{
public:
    Memory(const Context& context, const MemoryDesc& desc);
    /// Borrows the memory of an engine.
    Memory(const MemoryDesc& desc, VkDeviceMemory memory)
        : rhi::Memory(desc), m_typeBits(desc.memoryTypeBits), m_memory(memory)
    {
    }
    uint64_t nativeHandle() const override { return rhi::detail::toHandle(m_memory); }
    uint32_t memoryTypeBits() const override { return m_typeBits; }
    VkDeviceMemory memory() const { return m_memory; }

private:
    uint32_t m_typeBits = 0;
    Allocation m_allocation; // empty when the application lent us the memory
    VkDeviceMemory m_memory = VK_NULL_HANDLE;
};
} // namespace rhi::vulkan
