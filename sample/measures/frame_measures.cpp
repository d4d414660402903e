#include "frame_measures.h"
#include "measures.h"

namespace sample
{
namespace
{
// What is compared: T of a radiance, the values themselves of everything else.
const Picture& compared(const Comparable& signals, const SignalInfo& info)
{
    return info.isRadiance ? signals.encoded[info.signal] : signals.linear[info.signal];
}

SignalMeasures measureRadiance(const MeasuredFrame& frame, const SignalInfo& info, const Mask& mask)
{
    const Picture& result = frame.result.linear[info.signal];
    const Picture& reference = frame.reference.linear[info.signal];
    SignalMeasures m;
    m.psnr = psnr(compared(frame.result, info), compared(frame.reference, info), mask);
    m.ssim = ssim(compared(frame.result, info), compared(frame.reference, info), mask);
    m.flip = flip(rangeCompressed(result), rangeCompressed(reference), mask);
    m.relMse = relMse(result, reference, mask);
    m.bias = bias(result, reference, mask);
    return m;
}

SignalMeasures measureScalar(const Picture& result, const Picture& reference, const Mask& mask)
{
    SignalMeasures m;
    m.psnr = psnr(result, reference, mask);
    m.rmse = rmse(result, reference, mask);
    return m;
}

bool canCompare(const MeasuredFrame& frame, Signal signal)
{
    return frame.result.linear.has(signal) && frame.reference.linear.has(signal);
}
} // namespace

Comparable makeComparable(Signals linear)
{
    Comparable result{std::move(linear), {}};
    for (size_t s = 0; s < kSignalCount; s++)
        if (signalInfo(static_cast<Signal>(s)).isRadiance)
            result.encoded.pictures[s] = toneMapped(result.linear.pictures[s]);
    return result;
}

FrameMeasures measureFrame(const MeasuredFrame& frame, const MeasuredFrame* before)
{
    FrameMeasures measures;
    for (size_t s = 0; s < kSignalCount; s++)
    {
        const SignalInfo& info = signalInfo(static_cast<Signal>(s));
        if (!canCompare(frame, info.signal)) continue;
        const Mask mask = info.isSkyIncluded ? Mask() : frame.surface;
        const Picture& result = compared(frame.result, info);
        const Picture& reference = compared(frame.reference, info);
        measures[s] = info.isRadiance ? measureRadiance(frame, info, mask) : measureScalar(result, reference, mask);
        if (before && info.hasFlicker && canCompare(*before, info.signal))
            measures[s].flicker =
                flicker({result, compared(before->result, info), reference, compared(before->reference, info)}, mask);
    }
    return measures;
}

FrameMeasures meanOf(const std::vector<FrameMeasures>& frames)
{
    FrameMeasures mean;
    for (size_t s = 0; s < kSignalCount; s++)
    {
        for (const MeasureInfo& measure : kMeasures)
        {
            double sum = 0.0;
            size_t count = 0;
            for (const FrameMeasures& frame : frames)
            {
                const std::optional<double>& value = frame[s].*measure.field;
                if (!value) continue;
                sum += *value;
                count++;
            }
            if (count) mean[s].*measure.field = sum / static_cast<double>(count);
        }
    }
    return mean;
}
} // namespace sample
