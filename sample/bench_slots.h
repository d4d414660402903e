// The user-pool slots that nrd-bench can fill, as one table.
#pragma once
#include "replay_denoisers.h"
#include "shaders/bench_constants.h"

#include <nrd/nrd.h>

#include <vulkan/vulkan.h>

namespace sample::bench
{
struct BenchSlot
{
    nrd::ResourceType type;
    Family family; // that packs the slot so; None: every family
    VkFormat format;
    uint32_t content; // inputs: BENCH_...
    bool isSpecular;  // of the content
    bool isOutput;
    uint32_t divisor = 1; // of the size
};

// Null when the benchmark cannot generate the slot for that family.
const BenchSlot* findBenchSlot(nrd::ResourceType type, Family family);

// The slots the denoiser reads and writes under the given settings, inputs first. Throws engine::Error when one of them
// is not in the table.
std::vector<BenchSlot> requiredSlots(const nrd::Instance& instance, nrd::Identifier identifier,
                                     const ReplayDenoiser& denoiser);
} // namespace sample::bench
