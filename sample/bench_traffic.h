// The bandwidth floor: what a frame's passes must move at least, from the dispatches alone.
#pragma once
#include "bench_options.h"

#include <nrd/descs.h>

#include <array>
#include <span>

namespace sample::bench
{
// Bytes per texel by user-pool slot; 0 where there is no image.
using SlotTexels = std::array<uint32_t, static_cast<size_t>(nrd::ResourceType::TRANSIENT_POOL)>;

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
