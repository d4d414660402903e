#include "reprojection.h"
#include "geometry.h"
#include "lobes.h"

namespace nrdtest
{
namespace
{
constexpr double kMaxMagnification = 5.0;

Vec3d transformed(const glm::dmat4& m, const Vec3d& p) { return Vec3d(m * glm::dvec4(p, 1.0)); }
} // namespace

glm::dvec2 projectedUv(const glm::dmat4& worldToClip, const Vec3d& position)
{
    const glm::dvec4 clip = worldToClip * glm::dvec4(position, 1.0);
    if (!(clip.w > 1e-9)) return glm::dvec2(-1.0);
    return {0.5 + 0.5 * clip.x / clip.w, 0.5 - 0.5 * clip.y / clip.w};
}

PreviousPlace followedMotion(const ReprojectionFrame& frame, const glm::dvec2& uv, double viewZ, const Vec3d& X,
                             const Vec3d& motion)
{
    if (frame.motion == MotionKind::World) return {projectedUv(frame.worldToClipPrev, X + motion), X + motion};
    const glm::dvec2 uvPrev = uv + glm::dvec2(motion);
    const bool hasDepth = frame.motion == MotionKind::ScreenWithDepth;
    const double viewZPrev = hasDepth ? viewZ + motion.z : transformed(frame.worldToViewPrev, X).z;
    const Vec3d seen = viewPosition(uvPrev, frame.frustumPrev, std::max(viewZPrev, 1e-4), frame.isOrtho);
    return {uvPrev, transformed(frame.viewToWorldPrev, seen)};
}

double lensDenominator(const Mirror& m, double hitDist)
{
    const double NoD = glm::dot(m.N, dominantDirection(m.N, -glm::normalize(m.X), m.roughness));
    return -2.0 * m.curvature * std::abs(NoD) * hitDist - 1.0;
}

double imageDistance(const Mirror& m, double hitDist)
{
    const double NoV = std::abs(glm::dot(m.N, glm::normalize(m.X)));
    double denominator = lensDenominator(m, hitDist);
    if (std::abs(denominator) < 1e-3) denominator = -1.0;
    const double silhouette = 1.0 + glm::length(m.X) * saturated(1.0 - NoV) * std::max(m.curvature, 0.0);
    return -dominantFactor(NoV, m.roughness) * hitDist / (denominator * silhouette);
}

Vec3d virtualPosition(const Mirror& m, double hitDist)
{
    const double along = imageDistance(m, hitDist);
    return glm::mix(m.Xprev, m.X, saturated(std::abs(along) / (hitDist + 1e-6))) + along * glm::normalize(m.X);
}

Vec3d imageMotion(const Mirror& m, double hitDist, const Vec3d& motion)
{
    const double magnification = imageDistance(m, hitDist) / (hitDist + 1e-6);
    return std::clamp(magnification, -kMaxMagnification, kMaxMagnification) *
           (motion - 2.0 * glm::dot(motion, m.N) * m.N);
}
} // namespace nrdtest
