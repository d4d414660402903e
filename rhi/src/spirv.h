// The little of a SPIR-V module that can be checked before a driver sees it.
#pragma once
#include <cstdint>
#include <rhi/span.h>
#include <vector>

namespace rhi
{
struct SpirvBinding
{
    uint32_t set = 0;
    uint32_t binding = 0;
    bool isReadOnly = false; // declared readonly: images and storage buffers
};

struct SpirvInfo
{
    const char* error = nullptr; // what is wrong with the module, null if nothing is
    std::vector<SpirvBinding> bindings;
};

SpirvInfo inspectSpirv(Span<const uint32_t> words);
} // namespace rhi
