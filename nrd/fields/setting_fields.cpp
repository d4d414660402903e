// Every field of the settings: its name, what it writes to, its range and the group a panel shows it in.
#include "setting_fields.h"
#include <limits>
#include <utility>

namespace nrd
{
namespace
{
constexpr const char* kApplications = nullptr; // follows from what is rendered: nothing for a user to turn
constexpr double kUnlimited = std::numeric_limits<double>::infinity();

constexpr SettingRange above(double low, double high) { return {low, high, true}; }

template <class T> SettingField field(const char* name, T& value, SettingRange range = {})
{
    return {name, &value, 1, nullptr, range};
}
template <class T, size_t N> SettingField field(const char* name, T (&values)[N])
{
    return {name, &values[0], N, nullptr, {}};
}

void add(std::vector<SettingField>& all, const char* group, std::vector<SettingField> fields)
{
    for (SettingField& row : fields)
    {
        row.group = group;
        all.push_back(std::move(row));
    }
}

} // namespace

// The ranges are those of nrd/settings.h; a test holds them against what the library takes.
// clang-format off
std::vector<SettingField> settingFields(CommonSettings& s)
{
    std::vector<SettingField> all;
    add(all, kApplications, {
        field("viewToClipMatrix", s.viewToClipMatrix),
        field("viewToClipMatrixPrev", s.viewToClipMatrixPrev),
        field("worldToViewMatrix", s.worldToViewMatrix),
        field("worldToViewMatrixPrev", s.worldToViewMatrixPrev),
        field("motionVectorScale", s.motionVectorScale),
        field("isMotionVectorInWorldSpace", s.isMotionVectorInWorldSpace),
        field("cameraJitter", s.cameraJitter),
        field("cameraJitterPrev", s.cameraJitterPrev),
        field("resourceSize", s.resourceSize),
        field("resourceSizePrev", s.resourceSizePrev),
        field("rectSize", s.rectSize),
        field("rectSizePrev", s.rectSizePrev),
        field("rectOrigin", s.rectOrigin),
        field("cameraDelta", s.cameraDelta),
        field("isCameraDeltaAvailable", s.isCameraDeltaAvailable),
        field("metersToUnits", s.metersToUnits),
        field("viewZScale", s.viewZScale),
        field("timeDeltaBetweenFrames", s.timeDeltaBetweenFrames),
        field("denoisingRange", s.denoisingRange),
        field("frameIndex", s.frameIndex),
        field("accumulationMode", s.accumulationMode),
        field("isHistoryConfidenceAvailable", s.isHistoryConfidenceAvailable),
        field("isDisocclusionThresholdMixAvailable", s.isDisocclusionThresholdMixAvailable),
        field("isSpecularMotionAvailable", s.isSpecularMotionAvailable),
    });
    add(all, "Disocclusion", {
        field("disocclusionThreshold", s.disocclusionThreshold, above(0, 1)),
        field("disocclusionThresholdAlternate", s.disocclusionThresholdAlternate, above(0, 1)),
        field("strandThickness", s.strandThickness, above(0, kUnlimited)),
        field("enableCutDetection", s.enableCutDetection),
    });
    add(all, "Materials", {
        field("cameraAttachedReflectionMaterialID", s.cameraAttachedReflectionMaterialID, {0, kUnlimited}),
        field("strandMaterialID", s.strandMaterialID, {0, kUnlimited}),
        field("historyFixAlternatePixelStrideMaterialID", s.historyFixAlternatePixelStrideMaterialID, {0, kUnlimited}),
    });
    add(all, "Look inside", {
        field("splitScreen", s.splitScreen, {0, 1}),
        field("enableValidation", s.enableValidation),
    });
    return all;
}

std::vector<SettingField> settingFields(ReblurSettings& s)
{
    std::vector<SettingField> all;
    add(all, kApplications, {
        field("checkerboardMode", s.checkerboardMode),
    });
    add(all, "History", {
        field("maxAccumulatedFrameNum", s.maxAccumulatedFrameNum, {0, 63}),
        field("maxFastAccumulatedFrameNum", s.maxFastAccumulatedFrameNum, {0, 63}),
        field("maxStabilizedFrameNum", s.maxStabilizedFrameNum, {0, 255}),
        field("fastHistoryClampingSigmaScale", s.fastHistoryClampingSigmaScale, {1, 3}),
        field("antilagSettings.luminanceSigmaScale", s.antilagSettings.luminanceSigmaScale, above(0, 100)),
        field("antilagSettings.luminanceSensitivity", s.antilagSettings.luminanceSensitivity, above(0, 100)),
        field("responsiveAccumulationSettings.roughnessThreshold",
              s.responsiveAccumulationSettings.roughnessThreshold, {0, 1}),
        field("responsiveAccumulationSettings.minAccumulatedFrameNum",
              s.responsiveAccumulationSettings.minAccumulatedFrameNum, {0, 8}),
    });
    add(all, "History fix", {
        field("historyFixFrameNum", s.historyFixFrameNum, {0, 8}),
        field("historyFixBasePixelStride", s.historyFixBasePixelStride, {1, 64}),
        field("historyFixAlternatePixelStride", s.historyFixAlternatePixelStride, {1, 64}),
    });
    add(all, "Hit distances", {
        field("hitDistanceParameters.A", s.hitDistanceParameters.A, above(0, kUnlimited)),
        field("hitDistanceParameters.B", s.hitDistanceParameters.B, above(0, kUnlimited)),
        field("hitDistanceParameters.C", s.hitDistanceParameters.C, {1, kUnlimited}),
        field("hitDistanceReconstructionMode", s.hitDistanceReconstructionMode),
        field("minHitDistanceWeight", s.minHitDistanceWeight, {0, 0.2}),
    });
    add(all, "Pre-pass", {
        field("prePassMode", s.prePassMode),
        field("diffusePrepassBlurRadius", s.diffusePrepassBlurRadius, {0, 256}),
        field("specularPrepassBlurRadius", s.specularPrepassBlurRadius, {0, 256}),
        field("usePrepassOnlyForSpecularMotionEstimation", s.usePrepassOnlyForSpecularMotionEstimation),
    });
    add(all, "Blur", {
        field("minBlurRadius", s.minBlurRadius, {0, 256}),
        field("maxBlurRadius", s.maxBlurRadius, {0, 256}),
        field("lobeAngleFraction", s.lobeAngleFraction, {0, 1}),
        field("roughnessFraction", s.roughnessFraction, {0, 1}),
        field("planeDistanceSensitivity", s.planeDistanceSensitivity, above(0, 1)),
        field("convergenceSettings.s", s.convergenceSettings.s, above(0, 10)),
        field("convergenceSettings.b", s.convergenceSettings.b, {0, 1}),
        field("convergenceSettings.p", s.convergenceSettings.p, {0, 1}),
    });
    add(all, "Fireflies", {
        field("enableAntiFirefly", s.enableAntiFirefly),
        field("fireflySuppressorMinRelativeScale", s.fireflySuppressorMinRelativeScale, {1, 3}),
    });
    add(all, "Materials", {
        field("minMaterialForDiffuse", s.minMaterialForDiffuse, {0, kUnlimited}),
        field("minMaterialForSpecular", s.minMaterialForSpecular, {0, kUnlimited}),
    });
    add(all, "Look inside", {
        field("returnHistoryLengthInsteadOfOcclusion", s.returnHistoryLengthInsteadOfOcclusion),
        field("enableReferenceAccumulation", s.enableReferenceAccumulation),
    });
    return all;
}

std::vector<SettingField> settingFields(RelaxSettings& s)
{
    std::vector<SettingField> all;
    add(all, kApplications, {
        field("checkerboardMode", s.checkerboardMode),
    });
    add(all, "History", {
        field("diffuseMaxAccumulatedFrameNum", s.diffuseMaxAccumulatedFrameNum, {0, 63}),
        field("specularMaxAccumulatedFrameNum", s.specularMaxAccumulatedFrameNum, {0, 63}),
        field("diffuseMaxFastAccumulatedFrameNum", s.diffuseMaxFastAccumulatedFrameNum, {0, 63}),
        field("specularMaxFastAccumulatedFrameNum", s.specularMaxFastAccumulatedFrameNum, {0, 63}),
        field("fastHistoryClampingSigmaScale", s.fastHistoryClampingSigmaScale, {1, 3}),
        field("antilagSettings.accelerationAmount", s.antilagSettings.accelerationAmount, {0, 1}),
        field("antilagSettings.spatialSigmaScale", s.antilagSettings.spatialSigmaScale, above(0, 100)),
        field("antilagSettings.temporalSigmaScale", s.antilagSettings.temporalSigmaScale, above(0, 100)),
        field("antilagSettings.resetAmount", s.antilagSettings.resetAmount, {0, 1}),
    });
    add(all, "History fix", {
        field("historyFixFrameNum", s.historyFixFrameNum, {0, 3}),
        field("historyFixBasePixelStride", s.historyFixBasePixelStride, {1, 64}),
        field("historyFixAlternatePixelStride", s.historyFixAlternatePixelStride, {1, 64}),
        field("historyFixEdgeStoppingNormalPower", s.historyFixEdgeStoppingNormalPower, above(0, 128)),
    });
    add(all, "Hit distances", {
        field("hitDistanceReconstructionMode", s.hitDistanceReconstructionMode),
        field("minHitDistanceWeight", s.minHitDistanceWeight, above(0, 0.2)),
    });
    add(all, "Pre-pass", {
        field("prePassMode", s.prePassMode),
        field("diffusePrepassBlurRadius", s.diffusePrepassBlurRadius, {0, 256}),
        field("specularPrepassBlurRadius", s.specularPrepassBlurRadius, {0, 256}),
    });
    add(all, "Wavelet", {
        field("atrousIterationNum", s.atrousIterationNum, {2, 8}),
        field("spatialVarianceEstimationHistoryThreshold", s.spatialVarianceEstimationHistoryThreshold, {0, 63}),
        field("diffusePhiLuminance", s.diffusePhiLuminance, {0, 100}),
        field("specularPhiLuminance", s.specularPhiLuminance, {0, 100}),
        field("diffuseMinLuminanceWeight", s.diffuseMinLuminanceWeight, {0, 1}),
        field("specularMinLuminanceWeight", s.specularMinLuminanceWeight, {0, 1}),
        field("specularVarianceBoost", s.specularVarianceBoost, {0, 65504}),
        field("depthThreshold", s.depthThreshold, above(0, 1)),
        field("lobeAngleFraction", s.lobeAngleFraction, {0, 1}),
        field("specularLobeAngleSlack", s.specularLobeAngleSlack, {0, 90}),
        field("roughnessFraction", s.roughnessFraction, {0, 1}),
        field("enableRoughnessEdgeStopping", s.enableRoughnessEdgeStopping),
    });
    add(all, "Relaxation", {
        field("roughnessEdgeStoppingRelaxation", s.roughnessEdgeStoppingRelaxation, {0, 1}),
        field("luminanceEdgeStoppingRelaxation", s.luminanceEdgeStoppingRelaxation, {0, 1}),
        field("normalEdgeStoppingRelaxation", s.normalEdgeStoppingRelaxation, {0, 1}),
        field("confidenceDrivenRelaxationMultiplier", s.confidenceDrivenRelaxationMultiplier, {0, 1}),
        field("confidenceDrivenLuminanceEdgeStoppingRelaxation",
              s.confidenceDrivenLuminanceEdgeStoppingRelaxation, {0, 1}),
        field("confidenceDrivenNormalEdgeStoppingRelaxation", s.confidenceDrivenNormalEdgeStoppingRelaxation, {0, 1}),
    });
    add(all, "Fireflies", {
        field("enableAntiFirefly", s.enableAntiFirefly),
    });
    add(all, "Materials", {
        field("minMaterialForDiffuse", s.minMaterialForDiffuse, {0, kUnlimited}),
        field("minMaterialForSpecular", s.minMaterialForSpecular, {0, kUnlimited}),
    });
    return all;
}

std::vector<SettingField> settingFields(SigmaSettings& s)
{
    std::vector<SettingField> all;
    add(all, kApplications, {
        field("lightDirection", s.lightDirection),
        field("lightPosition", s.lightPosition),
        field("isLightLocal", s.isLightLocal),
        field("checkerboardMode", s.checkerboardMode),
    });
    add(all, "Shadow", {
        field("planeDistanceSensitivity", s.planeDistanceSensitivity, above(0, 1)),
        field("maxStabilizedFrameNum", s.maxStabilizedFrameNum, {0, 15}),
    });
    return all;
}

std::vector<SettingField> settingFields(ReferenceSettings& s)
{
    std::vector<SettingField> all;
    add(all, "Accumulation", {
        field("maxAccumulatedFrameNum", s.maxAccumulatedFrameNum, {0, 4095}),
    });
    return all;
}

std::vector<SettingField> settingFields(ConfidenceSettings& s)
{
    std::vector<SettingField> all;
    add(all, "History confidence", {
        field("sensitivity", s.sensitivity, above(0, 100)),
        field("tolerance", s.tolerance, {0, 1}),
        field("minLuminance", s.minLuminance, above(0, 65504)),
        field("maxLuminance", s.maxLuminance, above(0, 65504)),
        field("planeDistanceSensitivity", s.planeDistanceSensitivity, above(0, 1)),
        field("blurPassNum", s.blurPassNum, {0, 5}),
    });
    return all;
}
// clang-format on
} // namespace nrd
