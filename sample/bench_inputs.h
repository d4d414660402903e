// The noisy inputs of nrd-bench: traced once on the device, then resident in its memory.
#pragma once
#include "bench_camera.h"
#include "bench_slots.h"

#include "engine/compute.h"

#include <optional>

namespace sample::bench
{
class Inputs
{
public:
    // Traces every input slot of `slots` for every input frame, and waits. Throws engine::Error.
    Inputs(const engine::Device& device, const std::vector<BenchSlot>& slots, const Workload& workload, Extent size);

    // The image of the slot's input frame, in the sampled state; the slot must be an input among those of the creation.
    engine::Image& image(nrd::ResourceType slot, uint32_t inputFrame);

    // Mean share of the sky over the input frames, counted; nothing when the slots have no depth.
    std::optional<double> skyPercent(const engine::Device& device);

private:
    struct Sequence
    {
        BenchSlot slot;
        std::vector<engine::Image> frames;
    };
    Sequence* find(nrd::ResourceType slot);

    std::vector<Sequence> m_sequences;
};
} // namespace sample::bench
