#include "geometry.h"

namespace nrdtest
{
Vec3d viewPosition(const glm::dvec2& uv, const glm::dvec4& frustum, double viewZ, bool isOrtho)
{
    const double scale = isOrtho ? 1.0 : viewZ;
    return {(frustum.x + uv.x * frustum.z) * scale, (frustum.y + uv.y * frustum.w) * scale, viewZ};
}

glm::dvec2 mirroredUv(const glm::dvec2& uv)
{
    const glm::dvec2 folded = 1.0 - glm::abs(1.0 - 2.0 * glm::fract(uv * 0.5));
    return glm::min(folded, glm::dvec2(0.99999));
}

double planeDistance(const Vec3d& N, const Vec3d& X, const Vec3d& other) { return std::abs(glm::dot(N, other - X)); }

double curvature(const Vec3d& X, const Vec3d& N, const Vec3d& otherX, const Vec3d& otherN)
{
    const Vec3d edge = otherX - X;
    const double squared = glm::dot(edge, edge);
    return squared > 1e-20 ? glm::dot(otherN - N, edge) / squared : 0.0;
}

double disocclusionDistance(double NoV, double frustumSize, double threshold, double parallax)
{
    const double cosine = lerp(NoV, 1.0, saturated(parallax / 30.0));
    return frustumSize * saturated(threshold / std::max(0.05, cosine));
}

Basis tangentBasis(const Vec3d& N)
{
    const double s = N.z < 0.0 ? -1.0 : 1.0, a = -1.0 / (s + N.z), b = N.x * N.y * a;
    return {{1.0 + s * N.x * N.x * a, s * b, -s * N.x}, {b, s + N.y * N.y * a, -N.y}};
}
} // namespace nrdtest
