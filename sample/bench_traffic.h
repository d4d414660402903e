// The bandwidth floor: what a frame's passes must move at least, from the dispatches alone.
#pragma once
#include "bench_options.h"

#include <nrd/descs.h>

#include <array>
#include <span>

namespace sample::bench
{
struct SlotTexel
{
    uint32_t byteSize = 0; // 0 where there is no image
    uint32_t divisor = 1;  // of the size
};
using SlotTexels = std::array<SlotTexel, static_cast<size_t>(nrd::ResourceType::TRANSIENT_POOL)>; // by slot

struct PassTraffic
{
    std::string name; // without the denoiser's; dispatches of equal name are one pass
    uint64_t byteCount = 0;
};

// Each texel of every bound texture read once, of every storage texture written once, whatever the number of bindings.
std::vector<PassTraffic> findTraffic(const nrd::InstanceDesc& instance, std::span<const nrd::DispatchDesc> dispatches,
                                     const SlotTexels& slots, Extent size);

// "REBLUR_DIFFUSE - Blur" -> "Blur"
std::string passName(const char* dispatchName);
} // namespace sample::bench
