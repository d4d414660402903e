// Pictures of path-traced noise under a known mean, and their distance from it.
#pragma once
#include <functional>
#include <harness.h>

namespace lag
{
constexpr int kWidth = 96, kHeight = 64;
constexpr size_t kPixelCount = size_t(kWidth) * size_t(kHeight);

using Means = std::vector<float>; // one per pixel
using IsCounted = std::function<bool(size_t pixel)>;

// Log-normal with a standard deviation as large as the mean: about one path of diffuse light.
quality::Signal makePathNoise(const Means& means, unsigned seed);

// T of the measures: what the eye sees of a luminance.
double toneMap(double luminance);

// Root mean square distance of the tone-mapped picture from the tone-mapped means.
double pictureError(const quality::Signal& picture, const Means& means, const IsCounted& isCounted);
} // namespace lag
