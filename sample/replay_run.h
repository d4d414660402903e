// A capture replayed from its first frame on and measured: what nrd-replay and nrd-report both do.
#pragma once
#include "replay_gpu.h"

namespace sample
{
struct ReplayRunDesc
{
    ReplayGpuDesc gpu;     // its denoiser may be NONE here
    std::string out;       // folder of the pictures, which exists; empty: none
    size_t frameCount = 0; // 0: all
};

class ReplayRun
{
public:
    // Throws engine::Error, SettingError and FileError, as does run().
    explicit ReplayRun(const ReplayRunDesc& desc);

    const ReplayReport& report() const { return m_report; }

    // Replays, and tells `progress` of (frames done, frames in all). Everything but the validation layers' verdict is
    // in the report. Once.
    const ReplayReport& run(void (*progress)(size_t, size_t));

    // Throws engine::Error when the validation layers had a message.
    void checkValidation() const;

private:
    void replayFrame(size_t index);
    void write(size_t index, const ReplayedFrame& result, bool hasReference) const;
    void fillReport();

    const ReplayRunDesc m_desc;
    const Capture& m_capture;
    SequenceMeasurer m_measurer;
    ReplayReport m_report;
    std::unique_ptr<ReplayGpu> m_gpu; // null: NONE
};
} // namespace sample
