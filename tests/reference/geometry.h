// Surfaces: how far two of them are apart, how curved one is.
#pragma once
#include "vectors.h"

namespace nrdtest
{
// frustum: slopes of the top left corner, extent.
Vec3d viewPosition(const glm::dvec2& uv, const glm::dvec4& frustum, double viewZ, bool isOrtho);
glm::dvec2 mirroredUv(const glm::dvec2& uv); // folded back at the screen's borders

double planeDistance(const Vec3d& N, const Vec3d& X, const Vec3d& other);                   // world units
double curvature(const Vec3d& X, const Vec3d& N, const Vec3d& otherX, const Vec3d& otherN); // convex > 0

// World units of depth by which a surface may differ from what was there. threshold: share of the frustum's size.
double disocclusionDistance(double NoV, double frustumSize, double threshold, double parallax);

struct Basis
{
    Vec3d T, B;
};
Basis tangentBasis(const Vec3d& N);
} // namespace nrdtest
