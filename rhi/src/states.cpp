#include <rhi/states.h>

namespace rhi
{
bool operator==(const TextureState& a, const TextureState& b)
{
    if (a.layout != b.layout) return false;
    if (a.layout == Layout::Native)
        return a.native.stages == b.native.stages && a.native.access == b.native.access &&
               a.native.layout == b.native.layout;
    return a.access == b.access && a.stages == b.stages;
}
} // namespace rhi
