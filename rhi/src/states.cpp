#include <rhi/states.h>

namespace rhi
{
namespace
{
bool isSame(const NativeState& a, const NativeState& b)
{
    return a.stages == b.stages && a.access == b.access && a.layout == b.layout;
}
} // namespace

bool operator==(const TextureState& a, const TextureState& b)
{
    if (a.layout != b.layout) return false;
    if (a.layout == Layout::Native) return isSame(a.native, b.native);
    return a.access == b.access && a.stages == b.stages;
}

bool operator==(const MemoryState& a, const MemoryState& b)
{
    if (a.isNative != b.isNative) return false;
    return a.isNative ? isSame(a.native, b.native) : a.access == b.access && a.stages == b.stages;
}
} // namespace rhi
