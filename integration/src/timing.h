// GPU time by pass: a timestamp before a call's first pass and after each of its passes, read when the frame's slot
// comes round again, so that nobody waits.
#pragma once
#include <nrd/integration.h>
#include <rhi/device.h>
#include <vector>

namespace nrd
{
class FrameTimer
{
public:
    /// Does nothing if `passesPerFrame` is 0 or the device has no timestamps.
    FrameTimer(rhi::Device& device, const char* name, uint32_t passesPerFrame, uint32_t framesInFlight);

    /// Reads the results of the frame that used this slot before; throws rhi::Error, and can then be tried again.
    void collect(uint32_t slot);
    /// Starts `frame` in a slot whose results are read.
    void beginFrame(uint64_t frame, uint32_t slot);
    /// Before the passes of one call, outside of them: resets `passCount` + 1 queries and writes the first.
    void beginCall(rhi::CommandBuffer& commands, uint32_t passCount);
    /// After a pass. `name` must live until the results are read.
    void endPass(rhi::CommandBuffer& commands, const char* name);

    Timings timings() const;

private:
    struct Mark
    {
        const char* name; // null: the begin of a call
    };
    struct Slot
    {
        std::unique_ptr<rhi::QueryPool> queries;
        std::vector<Mark> marks; // one per query written
        uint64_t frame = 0;
    };

    std::vector<Slot> m_slots; // empty: no timing
    Slot* m_current = nullptr;
    uint32_t m_capacity = 0; // queries of a slot
    std::vector<uint64_t> m_ticks;
    std::vector<PassTime> m_passes;
    uint64_t m_frame = 0;
    float m_total = 0.0f;
    bool m_isCallTimed = false;
};
} // namespace nrd
