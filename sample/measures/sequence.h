// Measures of a whole sequence, frame by frame as they come.
#pragma once
#include "frame_measures.h"

namespace sample
{
// The first frames hold no history yet; means leave them out.
inline constexpr size_t kFirstMeanFrame = 7;

struct SequenceFrame
{
    size_t frame = 0;
    FrameMeasures noisy;
    FrameMeasures denoised;  // empty where nothing was denoised
    FrameMeasures extracted; // SH: of the colours before the resolve; else empty
};

// What the last frame that was added looks like; linear HDR.
struct ComposedPictures
{
    Picture noisy;
    Picture denoised;
    Picture reference;
};

class SequenceMeasurer
{
public:
    // `produced`: the signals of the denoiser, which the noisy input is measured for too. `info` must outlive this.
    SequenceMeasurer(const CaptureInfo& info, const SignalSet& produced) : m_info(info), m_produced(produced) {}

    // Frames in order, those with a reference only. `denoised` is null for the noisy input alone, `extracted` but for
    // SH denoisers.
    void add(size_t frameIndex, const Planes& frame, const Planes& reference, const Signals* denoised,
             const Signals* extracted = nullptr);

    const std::vector<SequenceFrame>& frames() const { return m_frames; }
    const ComposedPictures& pictures() const { return m_pictures; }
    // Means over the frames from kFirstMeanFrame on.
    FrameMeasures meanNoisy() const;
    FrameMeasures meanDenoised() const;
    FrameMeasures meanExtracted() const;

private:
    struct Kept
    {
        size_t frame = 0;
        Comparable noisy;
        Comparable denoised;
        Comparable extracted;
        Comparable reference;
        Mask surface;
    };
    FrameMeasures mean(FrameMeasures SequenceFrame::*field) const;

    const CaptureInfo& m_info;
    SignalSet m_produced;
    std::vector<SequenceFrame> m_frames;
    std::optional<Kept> m_before;
    ComposedPictures m_pictures;
};
} // namespace sample
