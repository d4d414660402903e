// Hit distances: normalisation, what is no sample, the nearest of several.
#pragma once
#include <array>
#include <glm/glm.hpp>

namespace nrdtest
{
struct HitDistanceRange
{
    double A, B, C; // of ReblurSettings::hitDistanceParameters
};

double hitDistanceRange(double viewZ, const HitDistanceRange& range, double roughness);

// In [0; 1]; NaN is no sample, infinity a miss.
double normalizedHitDistance(double hitDist, double viewZ, const HitDistanceRange& range, double roughness);

double nearestHitDistance(const std::array<float, 4>& hitDists); // 0: none
double trimmedHitDistance(double hitDist, double threshold);
double relaxHitDistance(double hitDist); // as half floats hold it
} // namespace nrdtest
