#include "confidence.h"
#include "weights.h"
#include <algorithm>
#include <cmath>

namespace nrdtest
{
namespace
{
struct Gradient
{
    glm::dvec2 difference{0.0}, luminance{0.0};
};

Gradient gradientOf(const ConfidenceInput& in, const ConfidenceTile& tile)
{
    const double a = tile.stored.z, b = tile.retraced.z;
    for (int c = 0; c < 3; c++)
        if (!std::isfinite(tile.stored[c]) || !std::isfinite(tile.retraced[c])) return {};
    if (!(a < in.denoisingRange) || !(b < in.denoisingRange)) return {};
    const double weight = ramp(0.25, 0.05, std::abs(a - b) / std::max(a, b));
    const glm::dvec2 before = glm::clamp(glm::dvec2(tile.stored), 0.0, in.maxLuminance);
    const glm::dvec2 now = glm::clamp(glm::dvec2(tile.retraced), 0.0, in.maxLuminance);
    return {weight * glm::abs(now - before), weight * glm::max(now, before)};
}

double tapWeight(const ConfidenceInput& in, const ConfidenceTile& centre, const ConfidenceTile& other, int x, int y)
{
    if (!(centre.stored.z < in.denoisingRange) || !(other.stored.z < in.denoisingRange)) return 0.0;
    const double distance = std::abs(glm::dot(centre.normal, other.position - centre.position));
    const double cosine = std::max(glm::dot(centre.normal, other.normal), 0.0);
    return std::exp(-2.0 * (x * x + y * y) / 4.0) * soft(distance / (in.planeDistance * centre.stored.z)) * cosine *
           cosine;
}

std::vector<Gradient> blur(const ConfidenceInput& in, const std::vector<Gradient>& from, int stride)
{
    std::vector<Gradient> to;
    for (int i = 0; i < in.width * in.height; i++)
    {
        Gradient sum = from[size_t(i)];
        double weights = 1.0;
        for (int tap = 0; tap < 25; tap++)
        {
            const int dx = tap % 5 - 2, dy = tap / 5 - 2;
            const int x = i % in.width + stride * dx, y = i / in.width + stride * dy;
            if (tap == 12 || x < 0 || y < 0 || x >= in.width || y >= in.height) continue;
            const size_t other = size_t(y * in.width + x);
            const double weight = tapWeight(in, in.tiles[size_t(i)], in.tiles[other], dx, dy);
            sum.difference += weight * from[other].difference;
            sum.luminance += weight * from[other].luminance;
            weights += weight;
        }
        to.push_back({sum.difference / weights, sum.luminance / weights});
    }
    return to;
}
} // namespace

std::vector<glm::dvec2> confidences(const ConfidenceInput& in)
{
    std::vector<Gradient> gradients;
    for (const ConfidenceTile& tile : in.tiles) gradients.push_back(gradientOf(in, tile));
    for (int pass = 1; pass <= in.blurPassNum; pass++) gradients = blur(in, gradients, pass);
    std::vector<glm::dvec2> result(gradients.size(), glm::dvec2(1.0));
    for (int i = 0; i < in.width * in.height; i++)
        for (int neighbour = 0; neighbour < 9; neighbour++)
        {
            const int x = std::clamp(i % in.width + neighbour % 3 - 1, 0, in.width - 1);
            const int y = std::clamp(i / in.width + neighbour / 3 - 1, 0, in.height - 1);
            const Gradient& g = gradients[size_t(y * in.width + x)];
            const glm::dvec2 change = g.difference / glm::max(g.luminance, in.minLuminance);
            result[size_t(i)] =
                glm::min(result[size_t(i)], 1.0 - glm::clamp(in.sensitivity * (change - in.tolerance), 0.0, 1.0));
        }
    return result;
}
} // namespace nrdtest
