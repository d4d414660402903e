// An application's allocator of device memory, which keeps account.
#pragma once
#include "common.h"
#include <bit>
#include <map>
#include <rhi/vulkan.h>
#include <string>
#include <vector>

namespace test
{
// Gives every block at an offset that is not 0, and takes it back.
struct Allocator
{
    explicit Allocator(rhi::Device& memoryDevice) : device(memoryDevice) {}
    nrd::DeviceMemoryCallbacks callbacks() { return {allocate, free, this}; }

    static bool allocate(void* self, const VkMemoryRequirements& needs, const char* name, nrd::NrdMemory& memory)
    {
        Allocator& allocator = *static_cast<Allocator*>(self);
        if (allocator.isExhausted) return false;
        auto block =
            allocator.device.createMemory({needs.alignment + needs.size, needs.memoryTypeBits, name, "application's"});
        memory = {rhi::vulkanMemory(*block), needs.alignment, needs.size,
                  static_cast<uint32_t>(std::countr_zero(block->memoryTypeBits()))};
        allocator.given[memory.memory] = std::move(block);
        allocator.byteSize += needs.size;
        allocator.names.push_back(name);
        return true;
    }
    static void free(void* self, const nrd::NrdMemory& memory)
    {
        Allocator& allocator = *static_cast<Allocator*>(self);
        CHECK(allocator.given.erase(memory.memory) == 1);
        allocator.byteSize -= memory.size;
    }

    rhi::Device& device;
    std::map<VkDeviceMemory, std::unique_ptr<rhi::Memory>> given;
    std::vector<std::string> names;
    uint64_t byteSize = 0;
    bool isExhausted = false;
};
} // namespace test
