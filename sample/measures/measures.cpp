#include "measures.h"
#include "filter.h"
#include "flip.h"
#include "image_io.h"

#include <algorithm>
#include <cmath>

namespace sample
{
namespace
{
constexpr double kRelativeFloor = 0.01; // keeps black pixels from dominating relMSE
constexpr size_t kTrimmedShare = 1000;  // one pixel in so many is left out as a firefly of the measure

template <class F> Picture mapped(const Picture& picture, F&& function)
{
    Picture result = picture;
    for (auto& plane : result.planes)
        for (float& v : plane) v = function(v);
    return result;
}

float finite(float v) { return std::isfinite(v) ? v : 0.0f; }

// Mean over the pixels that count of a function of (plane, pixel).
template <class F> double meanOver(const Picture& shape, const Mask& mask, F&& function)
{
    double sum = 0.0;
    size_t count = 0;
    for (size_t c = 0; c < shape.planes.size(); c++)
    {
        for (size_t i = 0; i < shape.pixelCount(); i++)
        {
            if (!counts(mask, i)) continue;
            sum += function(c, i);
            count++;
        }
    }
    return count ? sum / static_cast<double>(count) : 0.0;
}

double meanOf(const std::vector<float>& values, const Mask& mask)
{
    double sum = 0.0;
    size_t count = 0;
    for (size_t i = 0; i < values.size(); i++)
    {
        if (!counts(mask, i)) continue;
        sum += values[i];
        count++;
    }
    return count ? sum / static_cast<double>(count) : 0.0;
}

// Both pictures are black outside the mask, so that what is there does not leak in through a filter.
Picture masked(const Picture& picture, const Mask& mask)
{
    Picture result = picture;
    for (auto& plane : result.planes)
        for (size_t i = 0; i < plane.size(); i++)
            if (!counts(mask, i)) plane[i] = 0.0f;
    return result;
}

Plane lumaOf(const Picture& rgb, const Mask& mask)
{
    Plane luma(rgb.pixelCount());
    for (size_t i = 0; i < luma.size(); i++)
        if (counts(mask, i))
            luma[i] = 0.2126f * rgb.planes[0][i] + 0.7152f * rgb.planes[1][i] + 0.0722f * rgb.planes[2][i];
    return luma;
}

Plane product(const Plane& a, const Plane& b)
{
    Plane result(a.size());
    for (size_t i = 0; i < a.size(); i++) result[i] = a[i] * b[i];
    return result;
}
} // namespace

Picture toneMapped(const Picture& linear) { return mapped(linear, toneMap); }

Picture rangeCompressed(const Picture& linear) { return mapped(linear, compressRange); }

double rmse(const Picture& result, const Picture& reference, const Mask& mask)
{
    const auto squared = [&](size_t c, size_t i)
    {
        const double d = static_cast<double>(finite(result.planes[c][i])) - finite(reference.planes[c][i]);
        return d * d;
    };
    return std::sqrt(meanOver(result, mask, squared));
}

double psnr(const Picture& result, const Picture& reference, const Mask& mask)
{
    const double error = rmse(result, reference, mask);
    return error > 0.0 ? std::min(-20.0 * std::log10(error), kMaxPsnr) : kMaxPsnr;
}

double ssim(const Picture& result, const Picture& reference, const Mask& mask)
{
    constexpr float kC1 = 0.01f * 0.01f;
    constexpr float kC2 = 0.03f * 0.03f;
    const Kernel window = gaussian(1.5, 5);
    const auto blur = [&](const Plane& plane) { return convolve(plane, result.width, result.height, window, window); };
    const Plane a = lumaOf(result, mask);
    const Plane b = lumaOf(reference, mask);
    const Plane meanA = blur(a);
    const Plane meanB = blur(b);
    const Plane squareA = blur(product(a, a));
    const Plane squareB = blur(product(b, b));
    const Plane cross = blur(product(a, b));
    std::vector<float> map(a.size());
    for (size_t i = 0; i < map.size(); i++)
    {
        const float mab = meanA[i] * meanB[i];
        const float maa = meanA[i] * meanA[i];
        const float mbb = meanB[i] * meanB[i];
        const float variances = (squareA[i] - maa) + (squareB[i] - mbb);
        map[i] = (2.0f * mab + kC1) * (2.0f * (cross[i] - mab) + kC2) / ((maa + mbb + kC1) * (variances + kC2));
    }
    return meanOf(map, mask);
}

double flip(const Picture& result, const Picture& reference, const Mask& mask)
{
    if (mask.empty()) return meanOf(flipMap(reference, result), mask);
    return meanOf(flipMap(masked(reference, mask), masked(result, mask)), mask);
}

double relMse(const Picture& result, const Picture& reference, const Mask& mask)
{
    std::vector<double> errors;
    errors.reserve(result.pixelCount());
    for (size_t i = 0; i < result.pixelCount(); i++)
    {
        if (!counts(mask, i)) continue;
        double sum = 0.0;
        for (size_t c = 0; c < result.planes.size(); c++)
        {
            const double b = reference.planes[c][i];
            const double d = finite(result.planes[c][i]) - b;
            sum += d * d / (b * b + kRelativeFloor);
        }
        errors.push_back(sum / static_cast<double>(result.planes.size()));
    }
    if (errors.empty()) return 0.0;
    const size_t kept = errors.size() - errors.size() / kTrimmedShare;
    std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(kept - 1), errors.end());
    double sum = 0.0;
    for (size_t i = 0; i < kept; i++) sum += errors[i];
    return sum / static_cast<double>(kept);
}

double bias(const Picture& result, const Picture& reference, const Mask& mask)
{
    const double a = meanOver(result, mask, [&](size_t c, size_t i) { return finite(result.planes[c][i]); });
    const double b = meanOver(result, mask, [&](size_t c, size_t i) { return finite(reference.planes[c][i]); });
    return b > 0.0 ? (a - b) / b : 0.0;
}

double flicker(const FlickerInput& input, const Mask& mask)
{
    const auto change = [&](size_t c, size_t i)
    {
        const float result = finite(input.result.planes[c][i]) - finite(input.resultBefore.planes[c][i]);
        const float expected = finite(input.reference.planes[c][i]) - finite(input.referenceBefore.planes[c][i]);
        return std::abs(static_cast<double>(result) - expected);
    };
    return meanOver(input.result, mask, change);
}
} // namespace sample
