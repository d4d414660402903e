// The camera of nrd-bench: along the input frames there and back again, so that few frames give endless motion.
#pragma once
#include "bench_options.h"
#include "shaders/bench_constants.h"

namespace sample::bench
{
inline constexpr uint32_t kInputFrameCount = 8; // resident in device memory
inline constexpr float kSkyViewZ = 1e6f;        // beyond the denoising range

// Which of the input frames is shown in frame `index`: 0, 1, ... last, last - 1, ... 1, 0, 1, ...
constexpr uint32_t inputFrameOf(uint32_t index)
{
    constexpr uint32_t period = 2 * (kInputFrameCount - 1);
    const uint32_t phase = index % period;
    return phase < kInputFrameCount ? phase : period - phase;
}

// What the tracing shader needs for an input frame; the target is the caller's.
BenchConstants traceConstants(const Workload& workload, Extent size, uint32_t inputFrame);

// Camera, jitter, sizes and time of frame `index`; the rest at its defaults.
nrd::CommonSettings commonSettingsOf(const Workload& workload, Extent size, uint32_t index);

// The above with what --set says on top, and the family's settings. Throws SettingError.
ReplaySettings settingsOf(const Workload& workload, const ReplayDenoiser& denoiser, Extent size, uint32_t index);
} // namespace sample::bench
