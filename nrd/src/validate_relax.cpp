// The rules of RelaxSettings, one per line.
#include "checker.h"

namespace nrd
{
namespace
{
void checkAntilag(Checker& check, const RelaxAntilagSettings& s)
{
    check.inside("antilagSettings.accelerationAmount", s.accelerationAmount, 0.0f, 1.0f);
    check.aboveUpTo("antilagSettings.spatialSigmaScale", s.spatialSigmaScale, 0.0f, 100.0f);
    check.aboveUpTo("antilagSettings.temporalSigmaScale", s.temporalSigmaScale, 0.0f, 100.0f);
    check.inside("antilagSettings.resetAmount", s.resetAmount, 0.0f, 1.0f);
}

void checkHistory(Checker& check, const RelaxSettings& s)
{
    check.inside("diffuseMaxAccumulatedFrameNum", s.diffuseMaxAccumulatedFrameNum, 0u, 63u);
    check.inside("specularMaxAccumulatedFrameNum", s.specularMaxAccumulatedFrameNum, 0u, 63u);
    check.inside("diffuseMaxFastAccumulatedFrameNum", s.diffuseMaxFastAccumulatedFrameNum, 0u, 63u);
    check.inside("specularMaxFastAccumulatedFrameNum", s.specularMaxFastAccumulatedFrameNum, 0u, 63u);
    check.inside("historyFixFrameNum", s.historyFixFrameNum, 0u, 3u);
    check.require(s.historyFixFrameNum == 0 || s.historyFixFrameNum < s.diffuseMaxFastAccumulatedFrameNum,
                  "historyFixFrameNum", s.historyFixFrameNum, "0 or below diffuseMaxFastAccumulatedFrameNum");
    check.require(s.historyFixFrameNum == 0 || s.historyFixFrameNum < s.specularMaxFastAccumulatedFrameNum,
                  "historyFixFrameNum", s.historyFixFrameNum, "0 or below specularMaxFastAccumulatedFrameNum");
    check.inside("historyFixBasePixelStride", s.historyFixBasePixelStride, 1u, 64u);
    check.inside("historyFixAlternatePixelStride", s.historyFixAlternatePixelStride, 1u, 64u);
    check.aboveUpTo("historyFixEdgeStoppingNormalPower", s.historyFixEdgeStoppingNormalPower, 0.0f, 128.0f);
    check.inside("fastHistoryClampingSigmaScale", s.fastHistoryClampingSigmaScale, 1.0f, 3.0f);
}

void checkPrepass(Checker& check, const RelaxSettings& s)
{
    check.enumerator("prePassMode", s.prePassMode);
    check.inside("diffusePrepassBlurRadius", s.diffusePrepassBlurRadius, 0.0f, 256.0f);
    check.inside("specularPrepassBlurRadius", s.specularPrepassBlurRadius, 0.0f, 256.0f);
    check.aboveUpTo("minHitDistanceWeight", s.minHitDistanceWeight, 0.0f, 0.2f);
    check.enumerator("checkerboardMode", s.checkerboardMode);
    check.enumerator("hitDistanceReconstructionMode", s.hitDistanceReconstructionMode);
}

void checkWavelet(Checker& check, const RelaxSettings& s)
{
    check.inside("atrousIterationNum", s.atrousIterationNum, 2u, 8u);
    check.inside("spatialVarianceEstimationHistoryThreshold", s.spatialVarianceEstimationHistoryThreshold, 0u, 63u);
    check.inside("diffusePhiLuminance", s.diffusePhiLuminance, 0.0f, 100.0f);
    check.inside("specularPhiLuminance", s.specularPhiLuminance, 0.0f, 100.0f);
    check.inside("diffuseMinLuminanceWeight", s.diffuseMinLuminanceWeight, 0.0f, 1.0f);
    check.inside("specularMinLuminanceWeight", s.specularMinLuminanceWeight, 0.0f, 1.0f);
    check.inside("specularVarianceBoost", s.specularVarianceBoost, 0.0f, 65504.0f);
    check.aboveUpTo("depthThreshold", s.depthThreshold, 0.0f, 1.0f);
    check.inside("lobeAngleFraction", s.lobeAngleFraction, 0.0f, 1.0f);
    check.inside("specularLobeAngleSlack", s.specularLobeAngleSlack, 0.0f, 90.0f);
    check.inside("roughnessFraction", s.roughnessFraction, 0.0f, 1.0f);
}

void checkRelaxation(Checker& check, const RelaxSettings& s)
{
    check.inside("luminanceEdgeStoppingRelaxation", s.luminanceEdgeStoppingRelaxation, 0.0f, 1.0f);
    check.inside("normalEdgeStoppingRelaxation", s.normalEdgeStoppingRelaxation, 0.0f, 1.0f);
    check.inside("roughnessEdgeStoppingRelaxation", s.roughnessEdgeStoppingRelaxation, 0.0f, 1.0f);
    check.inside("confidenceDrivenRelaxationMultiplier", s.confidenceDrivenRelaxationMultiplier, 0.0f, 1.0f);
    check.inside("confidenceDrivenLuminanceEdgeStoppingRelaxation", s.confidenceDrivenLuminanceEdgeStoppingRelaxation,
                 0.0f, 1.0f);
    check.inside("confidenceDrivenNormalEdgeStoppingRelaxation", s.confidenceDrivenNormalEdgeStoppingRelaxation, 0.0f,
                 1.0f);
}
} // namespace

Error findError(const RelaxSettings& s)
{
    Checker check("RelaxSettings");
    checkAntilag(check, s.antilagSettings);
    checkHistory(check, s);
    checkPrepass(check, s);
    checkWavelet(check, s);
    checkRelaxation(check, s);
    return check.error();
}
} // namespace nrd
