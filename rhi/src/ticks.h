// Arithmetic on timestamps.
#pragma once
#include <cstdint>

namespace rhi
{
/// Ticks from `begin` to `end` of a counter of `validBits` bits [1; 64] that may have wrapped around once.
inline uint64_t tickDifference(uint64_t begin, uint64_t end, uint32_t validBits)
{
    const uint64_t mask = validBits >= 64 ? ~uint64_t{0} : (uint64_t{1} << validBits) - 1;
    return (end - begin) & mask;
}
} // namespace rhi
