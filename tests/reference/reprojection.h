// Where a surface, and what is seen in it, was one frame ago.
#pragma once
#include "vectors.h"

namespace nrdtest
{
// (-1; -1) on or behind the camera plane.
glm::dvec2 projectedUv(const glm::dmat4& worldToClip, const Vec3d& position);

enum class MotionKind
{
    Screen,          // 2D: the surface is taken as static
    ScreenWithDepth, // 2.5D
    World
};

// Of the constants that one reprojection needs; the world's origin is the current camera.
struct ReprojectionFrame
{
    glm::dmat4 worldToClipPrev, worldToViewPrev, viewToWorldPrev;
    glm::dvec4 frustumPrev;
    MotionKind motion;
    bool isOrtho;
};
struct PreviousPlace
{
    glm::dvec2 uv;
    Vec3d X;
};
PreviousPlace followedMotion(const ReprojectionFrame& frame, const glm::dvec2& uv, double viewZ, const Vec3d& X,
                             const Vec3d& motion);

// A thin lens, or a flat mirror where its focus would be.
struct Mirror
{
    Vec3d X, Xprev, N;
    double roughness, curvature;
};
double lensDenominator(const Mirror& mirror, double hitDist); // -1 flat, 0 at the focus
double imageDistance(const Mirror& mirror, double hitDist);   // positive behind the surface
Vec3d virtualPosition(const Mirror& mirror, double hitDist);
Vec3d imageMotion(const Mirror& mirror, double hitDist, const Vec3d& motion);
} // namespace nrdtest
