#include "hit_distance.h"
#include "lobes.h"
#include <limits>

namespace nrdtest
{
double hitDistanceRange(double viewZ, const HitDistanceRange& range, double roughness)
{
    return (range.A + std::abs(viewZ) * range.B) * lerp(range.C, 1.0, lobeSpread(roughness, 0.5));
}

double normalizedHitDistance(double hitDist, double viewZ, const HitDistanceRange& range, double roughness)
{
    const double share = hitDist / std::max(hitDistanceRange(viewZ, range, roughness), 1e-15);
    return std::isnan(share) ? 0.0 : saturated(share);
}

double nearestHitDistance(const std::array<float, 4>& hitDists)
{
    double nearest = std::numeric_limits<double>::infinity();
    for (const float hitDist : hitDists)
        if (hitDist > 0.0f) nearest = std::min(nearest, std::min(double{hitDist}, double{1e30f}));
    return std::isinf(nearest) ? 0.0 : nearest;
}

double trimmedHitDistance(double hitDist, double threshold) { return hitDist >= threshold ? hitDist : 0.0; }

double relaxHitDistance(double hitDist) { return std::isnan(hitDist) ? 0.0 : std::clamp(hitDist, 0.0, 65504.0); }
} // namespace nrdtest
