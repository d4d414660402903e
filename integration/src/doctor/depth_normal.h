// The normal that the depths around a pixel have.
#pragma once
#include "frame.h"
#include <optional>

namespace nrd::doctor
{
/// Unit, facing the camera; `depth(x, y)` in place of the frame's own. None at edges and creases.
template <class Depth> std::optional<Vec3> depthNormal(const Frame& frame, int x, int y, Depth&& depth)
{
    // On a plane 1 / z is linear over the screen, or z itself without perspective.
    const bool isOrthographic = frame.camera().isOrthographic();
    const auto linear = [&](int px, int py) { return isOrthographic ? depth(px, py) : 1.0 / depth(px, py); };
    constexpr double kBend = 2e-3; // relative
    const double center = linear(x, y);
    const int r = frame.reach();
    for (const auto& [dx, dy] : {std::pair(r, 0), std::pair(0, r)})
    {
        const double bend = linear(x + dx, y + dy) + linear(x - dx, y - dy) - 2.0 * center;
        if (!(std::abs(bend) < kBend * std::abs(center))) return {};
    }
    const auto at = [&](int px, int py) { return frame.positionAt(px, py, depth(px, py)); };
    const Vec3 normal = normalize(cross(at(x + r, y) - at(x - r, y), at(x, y + r) - at(x, y - r)));
    if (!isFinite(normal)) return {};
    return dot(normal, frame.camera().toCamera(at(x, y))) < 0.0 ? -normal : normal;
}
} // namespace nrd::doctor
