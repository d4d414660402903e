#include "memory_source.h"
#include "refusal.h"
#include <bit>
#include <rhi/vulkan.h>
#include <utility>

namespace nrd
{
namespace
{
using Number = unsigned long long;

// `field`: where the application named the memory. `where` ends the sentence about its size.
void check(const NrdMemory& memory, const VkMemoryRequirements& needs, const char* field, const std::string& where)
{
    if (memory.memoryTypeIndex >= 32 || !(needs.memoryTypeBits >> memory.memoryTypeIndex & 1))
        throw Refusal(Result::INVALID_ARGUMENT, sentence("%s.memoryTypeIndex is %u, must be a bit of 0x%x", field,
                                                         memory.memoryTypeIndex, needs.memoryTypeBits));
    if (memory.offset % needs.alignment != 0)
        throw Refusal(Result::INVALID_ARGUMENT, sentence("%s.offset is %llu, must be a multiple of %llu", field,
                                                         Number(memory.offset), Number(needs.alignment)));
    if (memory.size < needs.size || memory.size > ~memory.offset)
        throw Refusal(Result::INVALID_ARGUMENT, sentence("%s.size is %llu, must be at least %llu%s", field,
                                                         Number(memory.size), Number(needs.size), where.c_str()));
}

std::unique_ptr<rhi::Memory> wrap(rhi::Device& device, const NrdMemory& place, const std::string& tag)
{
    return rhi::wrapVulkanMemory(device, place.memory,
                                 {place.offset + place.size, 1u << place.memoryTypeIndex, tag.c_str(), tag.c_str()});
}
} // namespace

MemoryBlock::MemoryBlock(MemoryBlock&& other) noexcept
    : m_memory(std::move(other.m_memory)), m_place(other.m_place), m_owner(std::exchange(other.m_owner, nullptr))
{
}

MemoryBlock::~MemoryBlock()
{
    m_memory.reset();
    if (m_owner) m_owner->free(m_place);
}

MemorySource::MemorySource(rhi::Device& device, const DeviceMemoryCallbacks& callbacks)
    : m_device(device), m_callbacks(callbacks)
{
    if ((callbacks.allocate == nullptr) != (callbacks.free == nullptr))
        throw Refusal(Result::INVALID_ARGUMENT,
                      sentence("deviceMemory.%s is null, but deviceMemory.%s is not",
                               callbacks.free ? "allocate" : "free", callbacks.free ? "free" : "allocate"));
}

MemoryBlock MemorySource::allocate(const VkMemoryRequirements& needs, const std::string& tag)
{
    if (!m_callbacks.allocate)
    {
        auto memory = m_device.createMemory({needs.size, needs.memoryTypeBits, tag.c_str(), tag.c_str()});
        const NrdMemory place = {rhi::vulkanMemory(*memory), 0, needs.size,
                                 static_cast<uint32_t>(std::countr_zero(memory->memoryTypeBits()))};
        return {std::move(memory), place, nullptr};
    }
    NrdMemory place;
    if (!m_callbacks.allocate(m_callbacks.userArg, needs, tag.c_str(), place))
        throw Refusal(Result::FAILURE,
                      sentence("deviceMemory.allocate() has no %llu bytes for '%s'", Number(needs.size), tag.c_str()));
    m_byteSize += place.size;
    MemoryBlock block(nullptr, place, this); // gives it back if it does not serve
    if (place.memory == VK_NULL_HANDLE)
        throw Refusal(Result::INVALID_ARGUMENT, "deviceMemory.allocate() returned true, but memory is null");
    check(place, needs, "deviceMemory.allocate(): memory", "");
    block.m_memory = wrap(m_device, place, tag);
    return block;
}

void MemorySource::free(const NrdMemory& place)
{
    m_byteSize -= place.size;
    m_callbacks.free(m_callbacks.userArg, place);
}

MemoryBlock lentBlock(rhi::Device& device, const NrdMemory& memory, const VkMemoryRequirements& needs,
                      const std::string& tag, const std::string& where)
{
    if (needs.memoryTypeBits == 0)
        throw Refusal(Result::UNSUPPORTED, "transientMemory: no memory type of this device serves the whole pool");
    check(memory, needs, "transientMemory", where);
    const NrdMemory place = {memory.memory, memory.offset, needs.size, memory.memoryTypeIndex};
    return {wrap(device, place, tag), place, nullptr};
}
} // namespace nrd
