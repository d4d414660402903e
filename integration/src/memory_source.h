// Where device memory of the pools comes from: the device, or the application's allocator.
#pragma once
#include <nrd/integration.h>
#include <rhi/device.h>

namespace nrd
{
class MemorySource;

/// A part of device memory that textures are placed in; gives it back, where it is not lent, when it goes.
class MemoryBlock
{
public:
    MemoryBlock(std::unique_ptr<rhi::Memory> memory, const NrdMemory& place, MemorySource* owner)
        : m_memory(std::move(memory)), m_place(place), m_owner(owner)
    {
    }
    MemoryBlock(MemoryBlock&& other) noexcept;
    MemoryBlock& operator=(MemoryBlock&&) = delete;
    ~MemoryBlock();

    rhi::Memory& memory() const { return *m_memory; }
    const NrdMemory& place() const { return m_place; }

private:
    friend class MemorySource;

    std::unique_ptr<rhi::Memory> m_memory;
    NrdMemory m_place;
    MemorySource* m_owner; // null: the memory's own end suffices
};

/// Every block of it must end before it does.
class MemorySource
{
public:
    /// Throws a Refusal if there is one function without the other.
    MemorySource(rhi::Device& device, const DeviceMemoryCallbacks& callbacks);

    /// `tag` names the block and its line of the memory report. Throws rhi::Error or a Refusal.
    MemoryBlock allocate(const VkMemoryRequirements& needs, const std::string& tag);
    /// Of the application's allocator, which no memory report knows.
    uint64_t byteSize() const { return m_byteSize; }

private:
    friend class MemoryBlock;
    void free(const NrdMemory& place);

    rhi::Device& m_device;
    DeviceMemoryCallbacks m_callbacks;
    uint64_t m_byteSize = 0;
};

/// A block that is lent for `needs`. Throws a Refusal that names the field which does not serve; `where` ends it.
MemoryBlock lentBlock(rhi::Device& device, const NrdMemory& memory, const VkMemoryRequirements& needs,
                      const std::string& tag, const std::string& where);
} // namespace nrd
