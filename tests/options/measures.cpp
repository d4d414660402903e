#include "measures.h"
#include <cmath>

namespace options
{
namespace
{
using Slot = nrd::ResourceType;

// The channels that are the signal.
glm::vec4 maskOf(Slot output)
{
    switch (output)
    {
    case Slot::OUT_DIFF_SH1:
    case Slot::OUT_SPEC_SH1:
        return {1, 1, 1, 0};
    case Slot::OUT_DIFF_DIRECTION_HITDIST:
    case Slot::OUT_SHADOW_TRANSLUCENCY:
        return glm::vec4(1);
    default:
        return {1, 0, 0, 0};
    }
}

double squaredDistance(glm::vec4 a, glm::vec4 b, glm::vec4 mask)
{
    const glm::vec4 d = (a - b) * mask;
    return static_cast<double>(glm::dot(d, d));
}

bool isFinite(glm::vec4 v) { return std::isfinite(v.x + v.y + v.z + v.w); }

double rootMean(double sum, size_t count) { return std::sqrt(sum / static_cast<double>(std::max<size_t>(count, 1))); }

double errorOf(const Result& result, Slot output, glm::vec4 mask)
{
    const Plane &plane = result.outputs.at(output), &means = result.frame.means.at(output);
    double sum = 0.0;
    size_t count = 0;
    forEachPixel(result.frame,
                 [&](size_t pixel, size_t texel)
                 {
                     sum += squaredDistance(plane[texel], means[pixel], mask);
                     count++;
                 });
    return rootMean(sum, count);
}
} // namespace

double signalError(const Result& result, Slot output) { return errorOf(result, output, maskOf(output)); }
double hitDistError(const Result& result, Slot output) { return errorOf(result, output, {0, 0, 0, 1}); }

double noisyError(const Result& result, Slot output)
{
    const Plane &plane = result.frame.noisy.at(output), &means = result.frame.means.at(output);
    double sum = 0.0;
    size_t count = 0;
    forEachPixel(result.frame,
                 [&](size_t pixel, size_t)
                 {
                     sum += squaredDistance(plane[pixel], means[pixel], maskOf(output));
                     count++;
                 });
    return rootMean(sum, count);
}

double signalMean(const Result& result, Slot output)
{
    const Plane& plane = result.outputs.at(output);
    const int channel = output == Slot::OUT_DIFF_DIRECTION_HITDIST ? 3 : 0;
    double sum = 0.0;
    size_t count = 0;
    forEachPixel(result.frame,
                 [&](size_t, size_t texel)
                 {
                     sum += static_cast<double>(plane[texel][channel]);
                     count++;
                 });
    return sum / static_cast<double>(std::max<size_t>(count, 1));
}

size_t countBroken(const Result& result)
{
    size_t broken = 0;
    for (const auto& [slot, plane] : result.outputs)
        forEachPixel(result.frame, [&, &plane = plane](size_t, size_t texel) { broken += !isFinite(plane[texel]); });
    return broken;
}

size_t countStray(const Result& result)
{
    const Frame& frame = result.frame;
    size_t stray = 0;
    for (const auto& [slot, plane] : result.outputs)
    {
        for (int y = 0; y < frame.size.y; y++)
        {
            for (int x = 0; x < frame.size.x; x++)
            {
                const bool isInside = x < frame.rect.x && y < frame.rect.y && frame.isInRange(x, y);
                stray += !isInside && plane[frame.texel(x, y)] != result.poison.at(slot);
            }
        }
    }
    return stray;
}

size_t countDifferent(const Result& a, const Result& b)
{
    size_t different = 0;
    for (const auto& [slot, plane] : a.outputs)
    {
        const Plane& other = b.outputs.at(slot);
        for (int y = 0; y < a.frame.rect.y; y++)
            for (int x = 0; x < a.frame.rect.x; x++)
                different += a.frame.isInRange(x, y) && plane[a.frame.texel(x, y)] != other[b.frame.texel(x, y)];
    }
    return different;
}

double worstDifference(const Result& a, const Result& b)
{
    double worst = 0.0;
    for (const auto& [slot, plane] : a.outputs)
    {
        const Plane& other = b.outputs.at(slot);
        for (int y = 0; y < a.frame.rect.y; y++)
        {
            for (int x = 0; x < a.frame.rect.x; x++)
            {
                if (!a.frame.isInRange(x, y)) continue;
                const glm::vec4 d = glm::abs(plane[a.frame.texel(x, y)] - other[b.frame.texel(x, y)]);
                worst = std::max(worst, static_cast<double>(std::max({d.x, d.y, d.z, d.w})));
            }
        }
    }
    return worst;
}
} // namespace options
