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
    uint64_t nativeHandle() const override { return rhi::detail::toHandle(m_allocation.memory.get()); }
    VkDeviceMemory memory() const { return m_allocation.memory.get(); }
    uint32_t typeBits() const { return m_typeBits; } // one bit: the type it was allocated from

private:
    uint32_t m_typeBits = 0;
    Allocation m_allocation;
};
} // namespace rhi::vulkan
