#include "motion_candidates.h"
#include "check.h"

namespace nrd::doctor
{
namespace
{
struct Shape
{
    Vec3 sign;
    const char* name;
};
constexpr Shape kScreenShapes[] = {
    {{1.0, 1.0, 1.0}, ""},
    {{-1.0, -1.0, 1.0}, "current - previous"},
    {{1.0, -1.0, 1.0}, "motion with y flipped"},
    {{-1.0, 1.0, 1.0}, "motion with x flipped"},
};
constexpr Shape kWorldShapes[] = {
    {{1.0, 1.0, 1.0}, ""},
    {{-1.0, -1.0, -1.0}, "current - previous"},
    {{1.0, -1.0, 1.0}, "motion with y flipped"},
    {{-1.0, 1.0, 1.0}, "motion with x flipped"},
    {{1.0, 1.0, -1.0}, "motion with z flipped"},
};

struct Unit
{
    double factor; // 0: pixels
    const char* name;
};
constexpr Unit kScreenUnits[] = {
    {1.0, ""},
    {0.5, "twice as long as it must be (as in normalised device coordinates)"},
    {2.0, "half as long as it must be"},
    {0.0, "in pixels instead of uv"},
};
constexpr Unit kWorldUnits[] = {
    {1.0, ""},
    {0.5, "twice as long as it must be"},
    {2.0, "half as long as it must be"},
};

void addScreen(std::vector<MotionCandidate>& candidates, const Frame& frame)
{
    for (const Unit& unit : kScreenUnits)
    {
        const bool isPixels = unit.factor == 0.0;
        const Vec3 factor =
            isPixels ? Vec3{1.0 / frame.width(), 1.0 / frame.height(), 1.0} : Vec3{unit.factor, unit.factor, 1.0};
        for (const Shape& shape : kScreenShapes)
            candidates.push_back({false, factor * shape.sign, 0.0, shape.name, unit.name});
    }
    for (const double jitter : {1.0, -1.0}) candidates.push_back({false, {1.0, 1.0, 1.0}, jitter, "", ""});
}

void addWorld(std::vector<MotionCandidate>& candidates)
{
    for (const Unit& unit : kWorldUnits)
        for (const Shape& shape : kWorldShapes)
            candidates.push_back({true, shape.sign * unit.factor, 0.0, shape.name, unit.name});
}
} // namespace

std::vector<MotionCandidate> motionCandidates(const Frame& frame)
{
    std::vector<MotionCandidate> result;
    if (frame.common().isMotionVectorInWorldSpace)
    {
        addWorld(result);
        addScreen(result, frame);
        return result;
    }
    addScreen(result, frame);
    result.push_back({true, {1.0, 1.0, 1.0}, 0.0, "", ""});
    return result;
}

Vec3 MotionQuery::vector(int x, int y) const
{
    const CommonSettings& common = frame.common();
    const float(&scale)[3] = common.motionVectorScale;
    // In world space the default 0 of the third component stands for the first.
    const bool isScaleShared = common.isMotionVectorInWorldSpace && scale[2] == 0.0f;
    const Vec3 factor = {double(scale[0]), double(scale[1]), double(isScaleShared ? scale[0] : scale[2])};
    return toVec3(frame.guide(frame.input().motion, x, y)) * factor;
}

Camera::Pixel MotionQuery::moved(const MotionCandidate& candidate, int x, int y) const
{
    const Vec3 motion = vector(x, y) * candidate.factor;
    if (candidate.isWorldSpace) return cameraBefore.project(frame.position(x, y) + motion);
    const CommonSettings& common = frame.common();
    const double jitterX = double(before.common().cameraJitter[0] - common.cameraJitter[0]) / frame.width();
    const double jitterY = double(before.common().cameraJitter[1] - common.cameraJitter[1]) / frame.height();
    return {frame.sampleU(x) + motion.x + candidate.jitter * jitterX,
            frame.sampleV(y) + motion.y + candidate.jitter * jitterY, still(x, y).z};
}

std::string describe(const MotionCandidate& candidate, bool isSaidToBeWorldSpace)
{
    std::string what = candidate.shape;
    if (*candidate.unit) what += (what.empty() ? "motion " : ", ") + std::string(candidate.unit);
    std::string how;
    if (candidate.isWorldSpace != isSaidToBeWorldSpace)
    {
        what = std::string(candidate.isWorldSpace ? "world-space" : "screen-space") + " motion" +
               (what.empty() ? "" : " (" + what + ")");
        how = candidate.isWorldSpace ? "set isMotionVectorInWorldSpace" : "clear isMotionVectorInWorldSpace";
    }
    const Vec3& f = candidate.factor;
    if (f.x != 1.0 || f.y != 1.0)
    {
        how += std::string(how.empty() ? "" : " and ") + "multiply motionVectorScale by ";
        const bool isOne = f.x == f.y && (!candidate.isWorldSpace || f.x == f.z);
        how += isOne                    ? text("%g", f.x)
               : candidate.isWorldSpace ? text("(%g; %g; %g)", f.x, f.y, f.z)
                                        : text("(%g; %g)", f.x, f.y);
    }
    else if (candidate.isWorldSpace && f.z != 1.0)
        how += text("multiply motionVectorScale by (1; 1; %g)", f.z);
    return "looks like " + what + "; " + how;
}
} // namespace nrd::doctor
