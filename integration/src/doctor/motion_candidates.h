// What IN_MV may hold instead of what the settings say, and where each reading of it puts a pixel in the last frame.
#pragma once
#include "frame.h"
#include <string>

namespace nrd::doctor
{
struct MotionCandidate
{
    bool isWorldSpace = false;
    Vec3 factor = {1.0, 1.0, 1.0}; // of the scaled vector
    double jitter = 0.0;           // share of the jitter's change that is taken out
    const char* shape = "";        // "current - previous"; may be empty
    const char* unit = "";         // "in pixels instead of uv"; may be empty
};

/// The first is as the settings say; of two that fit alike, the earlier is meant.
std::vector<MotionCandidate> motionCandidates(const Frame& frame);

/// Depth and place of a pixel in the last frame, by its static position `world` or by the motion vector.
struct MotionQuery
{
    const Frame& frame;
    const Frame& before;
    Camera cameraBefore; // in the world of `frame`

    Vec3 vector(int x, int y) const; // scaled as the settings say
    Camera::Pixel still(int x, int y) const { return cameraBefore.project(frame.position(x, y)); }
    Camera::Pixel moved(const MotionCandidate& candidate, int x, int y) const;
    double pixelsBetween(const Camera::Pixel& a, const Camera::Pixel& b) const
    {
        return std::hypot((a.u - b.u) * frame.width(), (a.v - b.v) * frame.height());
    }
};

/// "looks like current - previous, in pixels instead of uv: multiply motionVectorScale by (-0.1; -0.2)"
std::string describe(const MotionCandidate& candidate, bool isSaidToBeWorldSpace);
} // namespace nrd::doctor
