#include "common_constants.h"
#include "frame_state.h"
#include "reblur.h"
#include <algorithm>
#include <cmath>

namespace nrd
{
namespace
{
float toFloat(double x) { return static_cast<float>(x); }

void fillHistory(const Request& request, const ReblurSettings& s, shared::DenoiserConstants& g)
{
    const uint32_t maxFrameNum = std::min(s.maxAccumulatedFrameNum, kHistoryMaxFrameNum);
    const uint32_t maxFastFrameNum = std::min(s.maxFastAccumulatedFrameNum, kHistoryMaxFrameNum);
    const float stabilizedFrameNum = static_cast<float>(s.maxStabilizedFrameNum);
    const bool isStabReset = request.isReset || !request.history.isStabilized;

    const float longest = request.isReset ? 0.0f : static_cast<float>(maxFrameNum);
    const float fastest = request.isReset ? 0.0f : static_cast<float>(maxFastFrameNum);
    g.maxAccumulatedFrameNum = {longest, longest};
    g.maxFastAccumulatedFrameNum = {fastest, fastest};
    g.stabilizationStrength = isStabReset ? 0.0f : stabilizedFrameNum / (1.0f + stabilizedFrameNum);
    g.historyFixFrameNum = static_cast<float>(s.historyFixFrameNum);
    g.historyFixStride = static_cast<float>(s.historyFixBasePixelStride);
    g.historyFixAlternateStride = static_cast<float>(s.historyFixAlternatePixelStride);
    g.convergence = {s.convergenceSettings.s * s.convergenceSettings.b,
                     s.convergenceSettings.s * (1.0f - s.convergenceSettings.b)};
    g.convergenceLengthInv = 1.0f / (1.0f + s.convergenceSettings.p * static_cast<float>(maxFrameNum));
    // Without a pre-pass samples vary by more, but each by itself, so that their means tell as much.
    g.antilagSigmaScale = (isPrefiltered(s) ? 1.0f : 0.7f) * s.antilagSettings.luminanceSigmaScale;
    g.antilagSensitivity = s.antilagSettings.luminanceSensitivity;
    g.responsiveRoughnessThreshold = s.responsiveAccumulationSettings.roughnessThreshold;
    g.responsiveMinFrameNum = static_cast<float>(s.responsiveAccumulationSettings.minAccumulatedFrameNum);
}

void fillFilters(const Request& request, const ReblurSettings& s, shared::DenoiserConstants& g)
{
    const float scale = request.frame.radiusScale;
    g.minBlurRadius = s.minBlurRadius;
    g.maxBlurRadius = std::max(s.maxBlurRadius * scale, s.minBlurRadius);
    g.diffusePrepassRadius = s.diffusePrepassBlurRadius * scale;
    g.specularPrepassRadius = s.specularPrepassBlurRadius * scale;
    g.hitDistanceParameters = {s.hitDistanceParameters.A * request.common.metersToUnits, s.hitDistanceParameters.B,
                               s.hitDistanceParameters.C, 0.0f};
    g.planeDistanceSensitivity = s.planeDistanceSensitivity;
    g.lobeAngleFraction = s.lobeAngleFraction * s.lobeAngleFraction;
    g.roughnessFraction = s.roughnessFraction;
    g.minHitDistanceWeight = s.minHitDistanceWeight;
    // Without spatial filtering the long history is as noisy as the fast one, so the box must be wider.
    g.fastClampSigmaScale = toFloat(mix(3.0, s.fastHistoryClampingSigmaScale, saturate(s.maxBlurRadius / 2.0)));
    fillFireflies(s.enableAntiFirefly, s.fireflySuppressorMinRelativeScale, 38.0f,
                  isPrefiltered(s) ? g.maxBlurRadius : 0.0f, g);
    g.minMaterialForDiffuse = s.minMaterialForDiffuse;
    g.minMaterialForSpecular = s.minMaterialForSpecular;
    g.isPrepassTrackingOnly = s.usePrepassOnlyForSpecularMotionEstimation ? 1 : 0;
    g.returnHistoryLength = s.returnHistoryLengthInsteadOfOcclusion ? 1 : 0;
}

} // namespace

ReblurSettings effective(const ReblurSettings& settings)
{
    ReblurSettings s = settings;
    if (!isPrefiltered(s)) s.diffusePrepassBlurRadius = s.specularPrepassBlurRadius = 0.0f;
    if (!s.enableReferenceAccumulation) return s;
    s.diffusePrepassBlurRadius = s.specularPrepassBlurRadius = s.minBlurRadius = s.maxBlurRadius = 0.0f;
    s.historyFixFrameNum = s.maxStabilizedFrameNum = 0;
    s.maxFastAccumulatedFrameNum = s.maxAccumulatedFrameNum;
    s.responsiveAccumulationSettings.roughnessThreshold = 0.0f;
    s.enableAntiFirefly = false;
    return s;
}

shared::DenoiserConstants makeReblurConstants(const Request& request)
{
    const ReblurSettings settings = effective(std::get<ReblurSettings>(request.settings));
    shared::DenoiserConstants constants = {};
    fillCommon(request, constants);
    fillHistory(request, settings, constants);
    fillFilters(request, settings, constants);
    fillIncomplete(request, settings.checkerboardMode, settings.hitDistanceReconstructionMode, constants);
    return constants;
}
} // namespace nrd
