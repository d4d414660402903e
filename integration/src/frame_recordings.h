// What was recorded for frames that the GPU may still be at: each Recording has a `frame`, 0 where it is free.
#pragma once
#include <cstdint>
#include <memory>
#include <vector>

namespace nrd
{
template <class Recording> using FrameRecordings = std::vector<std::unique_ptr<Recording>>;

/// Null: none of this frame; of frame 0: none is free.
template <class Recording> Recording* findRecording(const FrameRecordings<Recording>& recordings, uint64_t frame)
{
    for (const std::unique_ptr<Recording>& recording : recordings)
        if (recording->frame == frame) return recording.get();
    return nullptr;
}

/// The earliest one up to this frame, which the GPU is done with; null: none.
template <class Recording> Recording* oldestRecording(const FrameRecordings<Recording>& recordings, uint64_t lastFrame)
{
    Recording* oldest = nullptr;
    for (const std::unique_ptr<Recording>& recording : recordings)
        if (recording->frame != 0 && recording->frame <= lastFrame && (!oldest || recording->frame < oldest->frame))
            oldest = recording.get();
    return oldest;
}
} // namespace nrd
