// What nrd-bench has measured of one denoiser at one size.
#pragma once
#include "bench_options.h"

#include <optional>

namespace sample::bench
{
struct PassResult
{
    std::string name;
    double ms = 0.0;        // median
    uint64_t byteCount = 0; // that it must move at least
};

struct GpuResult
{
    double total = 0.0, p10 = 0.0, p90 = 0.0; // ms
    std::vector<PassResult> passes;
};

struct CpuResult
{
    double emit = 0.0;     // median, us: SetCommonSettings() and GetComputeDispatches()
    double record = 0.0;   // median, us: NrdIntegration::Denoise(), which emits too, with timestamps on
    double createMs = 0.0; // once: NrdIntegration::Create() with default pipelines, without a cache
};

struct MemoryResult
{
    double permanent = 0.0, transient = 0.0; // bytes
};

struct Result
{
    std::string denoiser;
    Extent size;
    MemoryResult memory;
    std::optional<GpuResult> gpu;     // not with --memory, nor on a device without timestamps
    std::optional<CpuResult> cpu;     // not with --memory
    std::optional<double> skyPercent; // not with --memory, nor when the denoiser reads no depth
};

struct Report
{
    std::string device;
    double bytesPerSecond = 0.0; // of copies; 0: not measured
    Workload workload;
    std::vector<Result> results;
};

// Bytes over bandwidth; 0 when that was not measured.
inline double floorMs(uint64_t byteCount, double bytesPerSecond)
{
    return bytesPerSecond > 0.0 ? static_cast<double>(byteCount) / bytesPerSecond * 1e3 : 0.0;
}
} // namespace sample::bench
