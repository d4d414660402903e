// Every measure of every signal of a frame, and their means: the inner shape of the reports.
#pragma once
#include "signals.h"

#include <optional>

namespace sample
{
// Absent where it does not apply.
struct SignalMeasures
{
    std::optional<double> psnr;    // dB, at most 120
    std::optional<double> rmse;    // scalars and translucency
    std::optional<double> ssim;    // radiance
    std::optional<double> flip;    // radiance, [0; 1]
    std::optional<double> relMse;  // radiance
    std::optional<double> flicker; // where the frame before has a reference too
    std::optional<double> bias;    // radiance, relative
};

struct MeasureInfo
{
    const char* name; // key of the report
    std::optional<double> SignalMeasures::*field;
    int decimals; // printed
};
inline constexpr MeasureInfo kMeasures[] = {
    {"psnr", &SignalMeasures::psnr, 2},     {"rmse", &SignalMeasures::rmse, 4},
    {"ssim", &SignalMeasures::ssim, 4},     {"flip", &SignalMeasures::flip, 4},
    {"relMSE", &SignalMeasures::relMse, 4}, {"flicker", &SignalMeasures::flicker, 4},
    {"bias", &SignalMeasures::bias, 4},
};

using FrameMeasures = std::array<SignalMeasures, kSignalCount>;

// Signals with their tone-mapped pictures, which several measures and two frames share.
struct Comparable
{
    Signals linear;
    Signals encoded; // T of the radiance; the rest is not repeated here
};
Comparable makeComparable(Signals linear);

// A frame's signals, its reference and the pixels that are not sky.
struct MeasuredFrame
{
    const Comparable& result;
    const Comparable& reference;
    const Mask& surface;
};
// `before` is the frame before; null when that has no reference, and then there is no flicker.
FrameMeasures measureFrame(const MeasuredFrame& frame, const MeasuredFrame* before);

// The mean of each measure over the frames that have it.
FrameMeasures meanOf(const std::vector<FrameMeasures>& frames);
} // namespace sample
