#include "sequence.h"

#include <future>

namespace sample
{
void SequenceMeasurer::add(size_t frameIndex, const Planes& frame, const Planes& reference, const Signals* denoised,
                           const Signals* extracted)
{
    Signals expected = referenceSignals(reference, frame);
    Signals noisy = noisySignals(frame, m_info, m_produced);
    compose(noisy, frame, expected);
    Signals result = denoised ? *denoised : Signals();
    if (denoised) compose(result, frame, expected);
    Signals unresolved = extracted ? *extracted : Signals();
    if (extracted) compose(unresolved, frame, expected);
    m_pictures = {noisy[Signal::Composed], result[Signal::Composed], expected[Signal::Composed]};

    Kept now;
    now.frame = frameIndex;
    now.surface = surfaceMask(frame, m_info.denoisingRange);
    now.reference = makeComparable(std::move(expected));
    const bool hasBefore = m_before && m_before->frame + 1 == frameIndex;
    const auto measure = [&](Signals signals, Comparable Kept::*which)
    {
        now.*which = makeComparable(std::move(signals));
        const MeasuredFrame current{now.*which, now.reference, now.surface};
        if (!hasBefore) return measureFrame(current, nullptr);
        const MeasuredFrame before{(*m_before).*which, m_before->reference, m_before->surface};
        return measureFrame(current, &before);
    };
    SequenceFrame row;
    row.frame = frameIndex;
    std::future<FrameMeasures> noisyMeasures = std::async(std::launch::async, measure, std::move(noisy), &Kept::noisy);
    row.denoised = measure(std::move(result), &Kept::denoised);
    row.extracted = measure(std::move(unresolved), &Kept::extracted);
    row.noisy = noisyMeasures.get();
    m_frames.push_back(std::move(row));
    m_before = std::move(now);
}

FrameMeasures SequenceMeasurer::mean(FrameMeasures SequenceFrame::*field) const
{
    std::vector<FrameMeasures> rows;
    for (const SequenceFrame& frame : m_frames)
        if (frame.frame >= kFirstMeanFrame) rows.push_back(frame.*field);
    return meanOf(rows);
}

FrameMeasures SequenceMeasurer::meanNoisy() const { return mean(&SequenceFrame::noisy); }

FrameMeasures SequenceMeasurer::meanDenoised() const { return mean(&SequenceFrame::denoised); }

FrameMeasures SequenceMeasurer::meanExtracted() const { return mean(&SequenceFrame::extracted); }
} // namespace sample
