#include "common_constants.h"
#include "frame_state.h"
#include "relax.h"
#include <algorithm>
#include <cmath>

namespace nrd
{
namespace
{
shared::vec2 frames(const Request& request, uint32_t diffuse, uint32_t specular)
{
    if (request.isReset) return {0.0f, 0.0f};
    return {static_cast<float>(std::min(diffuse, kHistoryMaxFrameNum)),
            static_cast<float>(std::min(specular, kHistoryMaxFrameNum))};
}

// A least weight is a cap on the exponent; 0 is none.
float exponentCap(float minWeight) { return minWeight > 0.0f ? -std::log(std::min(minWeight, 1.0f)) : 1e4f; }

void fillHistory(const Request& request, const RelaxSettings& s, shared::DenoiserConstants& g)
{
    g.maxAccumulatedFrameNum = frames(request, s.diffuseMaxAccumulatedFrameNum, s.specularMaxAccumulatedFrameNum);
    g.maxFastAccumulatedFrameNum =
        frames(request, s.diffuseMaxFastAccumulatedFrameNum, s.specularMaxFastAccumulatedFrameNum);
    g.historyFixFrameNum = static_cast<float>(s.historyFixFrameNum);
    g.historyFixStride = static_cast<float>(s.historyFixBasePixelStride);
    g.historyFixAlternateStride = static_cast<float>(s.historyFixAlternatePixelStride);
    g.relaxFixNormalPower = s.historyFixEdgeStoppingNormalPower;
    g.fastClampSigmaScale = s.fastHistoryClampingSigmaScale;
    // Without a pre-pass samples vary by more than twice as much, but each by itself, so that their means tell as much.
    const float sigmaShare = isPrefiltered(s) ? 1.0f : 0.6f;
    g.relaxAntilag = {s.antilagSettings.accelerationAmount, sigmaShare * s.antilagSettings.spatialSigmaScale,
                      sigmaShare * s.antilagSettings.temporalSigmaScale, s.antilagSettings.resetAmount};
    fillFireflies(s.enableAntiFirefly, s.enableAntiFirefly ? 1.5f : 2.0f, s.enableAntiFirefly ? 19.0f : 38.0f,
                  isPrefiltered(s) ? 30.0f : 3.0f, g);
    g.responsiveMinFrameNum = static_cast<float>(kHistoryMaxFrameNum);
}

void fillPrePass(const Request& request, const RelaxSettings& s, shared::DenoiserConstants& g)
{
    const float scale = isPrefiltered(s) ? request.frame.radiusScale : 0.0f;
    const HitDistanceParameters parameters; // of no effect but on what "far" is
    g.diffusePrepassRadius = s.diffusePrepassBlurRadius * scale;
    g.specularPrepassRadius = s.specularPrepassBlurRadius * scale;
    g.minBlurRadius = 1.0f;
    g.minHitDistanceWeight = s.minHitDistanceWeight;
    g.hitDistanceParameters = {parameters.A * request.common.metersToUnits, parameters.B, parameters.C, 0.0f};
    g.planeDistanceSensitivity = 0.02f;
    g.lobeAngleFraction = 0.0225f;
    g.roughnessFraction = s.roughnessFraction;
    g.minMaterialForDiffuse = s.minMaterialForDiffuse;
    g.minMaterialForSpecular = s.minMaterialForSpecular;
}

void fillWavelet(const RelaxSettings& s, shared::DenoiserConstants& g)
{
    constexpr float kRadians = 0.01745329252f;
    g.relaxPhi = {s.diffusePhiLuminance, s.specularPhiLuminance};
    g.relaxMaxLumaStop = {exponentCap(s.diffuseMinLuminanceWeight), exponentCap(s.specularMinLuminanceWeight)};
    g.relaxEdgeRelaxation = {s.luminanceEdgeStoppingRelaxation, s.normalEdgeStoppingRelaxation};
    g.relaxLobeAngle = s.lobeAngleFraction;
    g.relaxLobeAngleSlack = s.specularLobeAngleSlack * kRadians;
    g.relaxDepthThreshold = s.depthThreshold;
    g.relaxSpatialVarianceFrameNum = static_cast<float>(s.spatialVarianceEstimationHistoryThreshold);
    g.relaxDoubt = {s.confidenceDrivenRelaxationMultiplier, s.confidenceDrivenLuminanceEdgeStoppingRelaxation,
                    s.confidenceDrivenNormalEdgeStoppingRelaxation, 0.0f};
    g.relaxViewRelaxation = s.roughnessEdgeStoppingRelaxation;
    g.relaxVarianceBoost = s.specularVarianceBoost;
    g.relaxRoughnessStop = s.enableRoughnessEdgeStopping ? 1 : 0;
}
} // namespace

shared::DenoiserConstants makeRelaxConstants(const Request& request)
{
    const RelaxSettings& settings = std::get<RelaxSettings>(request.settings);
    shared::DenoiserConstants constants = {};
    fillCommon(request, constants);
    fillHistory(request, settings, constants);
    fillPrePass(request, settings, constants);
    fillWavelet(settings, constants);
    fillIncomplete(request, settings.checkerboardMode, settings.hitDistanceReconstructionMode, constants);
    return constants;
}
} // namespace nrd
