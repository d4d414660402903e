// Error of one picture against its reference. Pictures of a pair have equal size and plane count; pixels outside the
// mask do not count. A mask without any pixel gives 0 (and 120 dB).
#pragma once
#include "picture.h"

namespace sample
{
inline constexpr double kMaxPsnr = 120.0; // dB, identical pictures

// The tone mapping T = srgb(x / (1 + x)) of every plane; without the sRGB curve it is FLIP's linear input.
Picture toneMapped(const Picture& linear);
Picture rangeCompressed(const Picture& linear);

// Root mean square difference over pixels and planes.
double rmse(const Picture& result, const Picture& reference, const Mask& mask);
// -20 log10(rmse), dB, peak 1, at most kMaxPsnr.
double psnr(const Picture& result, const Picture& reference, const Mask& mask);
// Mean structural similarity in [-1; 1] of the luma of two tone-mapped RGB pictures.
double ssim(const Picture& result, const Picture& reference, const Mask& mask);
// Mean LDR-FLIP in [0; 1] of two range-compressed linear RGB pictures.
double flip(const Picture& result, const Picture& reference, const Mask& mask);
// Trimmed mean of squared relative error of two linear HDR pictures: per pixel the mean over the planes of
// (a - b)^2 / (b^2 + 0.01), the largest floor(N / 1000) pixels left out. Not finite in `result` counts as 0.
double relMse(const Picture& result, const Picture& reference, const Mask& mask);
// Relative difference of the mean of two linear HDR pictures; 0 where the reference is black.
double bias(const Picture& result, const Picture& reference, const Mask& mask);
// Mean over pixels and planes of |(a_t - a_t-1) - (b_t - b_t-1)|: change that the scene did not ask for.
struct FlickerInput
{
    const Picture& result;
    const Picture& resultBefore;
    const Picture& reference;
    const Picture& referenceBefore;
};
double flicker(const FlickerInput& input, const Mask& mask);
} // namespace sample
