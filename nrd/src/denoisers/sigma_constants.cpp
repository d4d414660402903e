#include "common_constants.h"
#include "frame_state.h"
#include "sigma.h"

namespace nrd
{
namespace
{
Double3 toDouble3(const float (&v)[3]) { return {v[0], v[1], v[2]}; }

// .w as the shader wants it: a direction, a position, or nothing known.
shared::vec4 makeLight(const CommonSettings& common, const SigmaSettings& s)
{
    const Double3 given = toDouble3(s.isLightLocal ? s.lightPosition : s.lightDirection);
    Double3 light = toViewSpace(common, given, s.isLightLocal);
    const double length = std::sqrt(light.x * light.x + light.y * light.y + light.z * light.z);
    if (!s.isLightLocal && !(length > 1e-6)) return {0.0f, 0.0f, 0.0f, 0.0f};
    const double scale = s.isLightLocal ? 1.0 : 1.0 / length;
    return {static_cast<float>(light.x * scale), static_cast<float>(light.y * scale),
            static_cast<float>(light.z * scale), s.isLightLocal ? 2.0f : 1.0f};
}
} // namespace

shared::DenoiserConstants makeSigmaConstants(const Request& request)
{
    const SigmaSettings& settings = std::get<SigmaSettings>(request.settings);
    shared::DenoiserConstants g = {};
    fillCommon(request, g);
    fillIncomplete(request, settings.checkerboardMode, HitDistanceReconstructionMode::OFF, g);
    g.sigmaLight = makeLight(request.common, settings);
    g.planeDistanceSensitivity = settings.planeDistanceSensitivity;
    g.maxAccumulatedFrameNum.x = static_cast<float>(settings.maxStabilizedFrameNum);
    return g;
}
} // namespace nrd
