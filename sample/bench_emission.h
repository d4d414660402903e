// The descriptor library alone: what a settled frame consists of, and how long asking for it takes.
#pragma once
#include "bench_slots.h"
#include "bench_traffic.h"

namespace sample::bench
{
struct Emission
{
    double microseconds = 0.0; // median of SetCommonSettings() and GetComputeDispatches()
    std::vector<PassTraffic> passes;
};

// Throws engine::Error and SettingError.
Emission measureEmission(const ReplayDenoiser& denoiser, Extent size, const Workload& workload,
                         const std::vector<BenchSlot>& slots);
} // namespace sample::bench
