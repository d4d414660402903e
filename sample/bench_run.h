// One denoiser at one size on the device, through NrdIntegration on the sample's own native objects.
#pragma once
#include "bench_inputs.h"
#include "bench_result.h"

#include "engine/commands.h"

#include <nrd/integration.h>

namespace sample::bench
{
struct RunDesc
{
    const engine::Device& device;
    const ReplayDenoiser& denoiser;
    Extent size;
    const Workload& workload;
};

// Throws engine::Error and SettingError.
class Run
{
public:
    explicit Run(const RunDesc& desc); // allocates the denoiser
    ~Run();                            // waits for the device

    MemoryResult memory() const;

    // Traces the inputs, denoises, and times it. Once.
    Result measure();

private:
    struct Times
    {
        std::vector<double> totals;
        std::vector<std::pair<std::string, std::vector<double>>> passes; // of equal name added up, as first recorded
    };
    void check(nrd::Result result, const char* action) const;
    void createImages();
    void beginFrame();
    void record(VkCommandBuffer cmd);
    void collect(Times& times);
    Times denoiseFrames(engine::FrameRing& ring);
    double timeRecording(engine::FrameRing& ring);

    const RunDesc m_desc;
    double m_createMs = 0.0;
    uint32_t m_index = 0; // of the next frame
    uint64_t m_collectedFrame = 0;
    std::vector<BenchSlot> m_slots;
    std::optional<Inputs> m_inputs;
    std::vector<engine::Image> m_outputs; // element i belongs to the i-th output of m_slots
    nrd::NrdUserPool m_pool;
    nrd::NrdIntegration m_integration; // after what it borrows, so that it goes first
};
} // namespace sample::bench
