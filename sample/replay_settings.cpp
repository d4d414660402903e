#include "replay_settings.h"

#include <charconv>
#include <cmath>
#include <iterator>
#include <sstream>

namespace sample
{
namespace
{
template <class T> SettingField field(const char* name, T& value) { return {name, &value, 1}; }
template <class T, size_t N> SettingField field(const char* name, T (&values)[N]) { return {name, &values[0], N}; }

// The enumerators' names in the order of their values.
template <class Mode> struct ModeNames;
template <> struct ModeNames<nrd::AccumulationMode>
{
    static constexpr const char* names[] = {"CONTINUE", "RESTART", "CLEAR_AND_RESTART"};
};
template <> struct ModeNames<nrd::PrePassMode>
{
    static constexpr const char* names[] = {"OFF", "SIMPLE", "AUTO"};
};
template <> struct ModeNames<nrd::CheckerboardMode>
{
    static constexpr const char* names[] = {"OFF", "BLACK", "WHITE"};
};
template <> struct ModeNames<nrd::HitDistanceReconstructionMode>
{
    static constexpr const char* names[] = {"OFF", "AREA_3X3", "AREA_5X5"};
};

template <> struct ModeNames<nrd::Quality>
{
    static constexpr const char* names[] = {"FAST", "BALANCED", "BEST"};
};

std::vector<SettingField> commonFields(nrd::CommonSettings& s)
{
    return {
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
        field("disocclusionThreshold", s.disocclusionThreshold),
        field("disocclusionThresholdAlternate", s.disocclusionThresholdAlternate),
        field("cameraAttachedReflectionMaterialID", s.cameraAttachedReflectionMaterialID),
        field("strandMaterialID", s.strandMaterialID),
        field("historyFixAlternatePixelStrideMaterialID", s.historyFixAlternatePixelStrideMaterialID),
        field("strandThickness", s.strandThickness),
        field("splitScreen", s.splitScreen),
        field("frameIndex", s.frameIndex),
        field("accumulationMode", s.accumulationMode),
        field("enableCutDetection", s.enableCutDetection),
        field("isHistoryConfidenceAvailable", s.isHistoryConfidenceAvailable),
        field("isDisocclusionThresholdMixAvailable", s.isDisocclusionThresholdMixAvailable),
        field("isSpecularMotionAvailable", s.isSpecularMotionAvailable),
        field("enableValidation", s.enableValidation),
    };
}

std::vector<SettingField> reblurFields(nrd::ReblurSettings& s)
{
    return {
        field("hitDistanceParameters.A", s.hitDistanceParameters.A),
        field("hitDistanceParameters.B", s.hitDistanceParameters.B),
        field("hitDistanceParameters.C", s.hitDistanceParameters.C),
        field("antilagSettings.luminanceSigmaScale", s.antilagSettings.luminanceSigmaScale),
        field("antilagSettings.luminanceSensitivity", s.antilagSettings.luminanceSensitivity),
        field("responsiveAccumulationSettings.roughnessThreshold", s.responsiveAccumulationSettings.roughnessThreshold),
        field("responsiveAccumulationSettings.minAccumulatedFrameNum",
              s.responsiveAccumulationSettings.minAccumulatedFrameNum),
        field("convergenceSettings.s", s.convergenceSettings.s),
        field("convergenceSettings.b", s.convergenceSettings.b),
        field("convergenceSettings.p", s.convergenceSettings.p),
        field("maxAccumulatedFrameNum", s.maxAccumulatedFrameNum),
        field("maxFastAccumulatedFrameNum", s.maxFastAccumulatedFrameNum),
        field("maxStabilizedFrameNum", s.maxStabilizedFrameNum),
        field("historyFixFrameNum", s.historyFixFrameNum),
        field("historyFixBasePixelStride", s.historyFixBasePixelStride),
        field("historyFixAlternatePixelStride", s.historyFixAlternatePixelStride),
        field("fastHistoryClampingSigmaScale", s.fastHistoryClampingSigmaScale),
        field("prePassMode", s.prePassMode),
        field("diffusePrepassBlurRadius", s.diffusePrepassBlurRadius),
        field("specularPrepassBlurRadius", s.specularPrepassBlurRadius),
        field("minHitDistanceWeight", s.minHitDistanceWeight),
        field("minBlurRadius", s.minBlurRadius),
        field("maxBlurRadius", s.maxBlurRadius),
        field("lobeAngleFraction", s.lobeAngleFraction),
        field("roughnessFraction", s.roughnessFraction),
        field("planeDistanceSensitivity", s.planeDistanceSensitivity),
        field("fireflySuppressorMinRelativeScale", s.fireflySuppressorMinRelativeScale),
        field("minMaterialForDiffuse", s.minMaterialForDiffuse),
        field("minMaterialForSpecular", s.minMaterialForSpecular),
        field("checkerboardMode", s.checkerboardMode),
        field("hitDistanceReconstructionMode", s.hitDistanceReconstructionMode),
        field("enableAntiFirefly", s.enableAntiFirefly),
        field("usePrepassOnlyForSpecularMotionEstimation", s.usePrepassOnlyForSpecularMotionEstimation),
        field("returnHistoryLengthInsteadOfOcclusion", s.returnHistoryLengthInsteadOfOcclusion),
        field("enableReferenceAccumulation", s.enableReferenceAccumulation),
    };
}

std::vector<SettingField> relaxFields(nrd::RelaxSettings& s)
{
    return {
        field("antilagSettings.accelerationAmount", s.antilagSettings.accelerationAmount),
        field("antilagSettings.spatialSigmaScale", s.antilagSettings.spatialSigmaScale),
        field("antilagSettings.temporalSigmaScale", s.antilagSettings.temporalSigmaScale),
        field("antilagSettings.resetAmount", s.antilagSettings.resetAmount),
        field("diffuseMaxAccumulatedFrameNum", s.diffuseMaxAccumulatedFrameNum),
        field("specularMaxAccumulatedFrameNum", s.specularMaxAccumulatedFrameNum),
        field("diffuseMaxFastAccumulatedFrameNum", s.diffuseMaxFastAccumulatedFrameNum),
        field("specularMaxFastAccumulatedFrameNum", s.specularMaxFastAccumulatedFrameNum),
        field("historyFixFrameNum", s.historyFixFrameNum),
        field("historyFixBasePixelStride", s.historyFixBasePixelStride),
        field("historyFixAlternatePixelStride", s.historyFixAlternatePixelStride),
        field("historyFixEdgeStoppingNormalPower", s.historyFixEdgeStoppingNormalPower),
        field("fastHistoryClampingSigmaScale", s.fastHistoryClampingSigmaScale),
        field("prePassMode", s.prePassMode),
        field("diffusePrepassBlurRadius", s.diffusePrepassBlurRadius),
        field("specularPrepassBlurRadius", s.specularPrepassBlurRadius),
        field("minHitDistanceWeight", s.minHitDistanceWeight),
        field("atrousIterationNum", s.atrousIterationNum),
        field("spatialVarianceEstimationHistoryThreshold", s.spatialVarianceEstimationHistoryThreshold),
        field("diffusePhiLuminance", s.diffusePhiLuminance),
        field("specularPhiLuminance", s.specularPhiLuminance),
        field("diffuseMinLuminanceWeight", s.diffuseMinLuminanceWeight),
        field("specularMinLuminanceWeight", s.specularMinLuminanceWeight),
        field("specularVarianceBoost", s.specularVarianceBoost),
        field("depthThreshold", s.depthThreshold),
        field("lobeAngleFraction", s.lobeAngleFraction),
        field("specularLobeAngleSlack", s.specularLobeAngleSlack),
        field("roughnessFraction", s.roughnessFraction),
        field("roughnessEdgeStoppingRelaxation", s.roughnessEdgeStoppingRelaxation),
        field("luminanceEdgeStoppingRelaxation", s.luminanceEdgeStoppingRelaxation),
        field("normalEdgeStoppingRelaxation", s.normalEdgeStoppingRelaxation),
        field("confidenceDrivenRelaxationMultiplier", s.confidenceDrivenRelaxationMultiplier),
        field("confidenceDrivenLuminanceEdgeStoppingRelaxation", s.confidenceDrivenLuminanceEdgeStoppingRelaxation),
        field("confidenceDrivenNormalEdgeStoppingRelaxation", s.confidenceDrivenNormalEdgeStoppingRelaxation),
        field("minMaterialForDiffuse", s.minMaterialForDiffuse),
        field("minMaterialForSpecular", s.minMaterialForSpecular),
        field("checkerboardMode", s.checkerboardMode),
        field("hitDistanceReconstructionMode", s.hitDistanceReconstructionMode),
        field("enableAntiFirefly", s.enableAntiFirefly),
        field("enableRoughnessEdgeStopping", s.enableRoughnessEdgeStopping),
    };
}

std::vector<SettingField> sigmaFields(nrd::SigmaSettings& s)
{
    return {
        field("lightDirection", s.lightDirection),
        field("lightPosition", s.lightPosition),
        field("isLightLocal", s.isLightLocal),
        field("planeDistanceSensitivity", s.planeDistanceSensitivity),
        field("maxStabilizedFrameNum", s.maxStabilizedFrameNum),
        field("checkerboardMode", s.checkerboardMode),
    };
}

std::vector<SettingField> referenceFields(nrd::ReferenceSettings& s)
{
    return {field("maxAccumulatedFrameNum", s.maxAccumulatedFrameNum)};
}

// Parses one value of type T out of the whole of `text`; returns what was expected when it is none, else null.
template <class T> const char* parseValue(const std::string& text, T& value)
{
    if constexpr (std::is_same_v<T, bool>)
    {
        if (text != "true" && text != "false" && text != "1" && text != "0") return "true or false";
        value = text == "true" || text == "1";
        return nullptr;
    }
    else if constexpr (std::is_enum_v<T>)
    {
        static_assert(std::size(ModeNames<T>::names) == static_cast<size_t>(T::MAX_NUM));
        static const std::string expected = []
        {
            std::string list = "one of";
            for (const char* name : ModeNames<T>::names) list += std::string(" ") + name;
            return list;
        }();
        for (size_t i = 0; i < std::size(ModeNames<T>::names); i++)
        {
            if (text != ModeNames<T>::names[i]) continue;
            value = static_cast<T>(i);
            return nullptr;
        }
        return expected.c_str();
    }
    else
    {
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool isWhole = error == std::errc() && end == text.data() + text.size();
        if constexpr (std::is_floating_point_v<T>)
            return isWhole && std::isfinite(value) ? nullptr : "a finite number";
        else
            return isWhole          ? nullptr
                   : sizeof(T) == 2 ? "a whole number from 0 to 65535"
                                    : "a whole number of at least 0";
    }
}

std::vector<std::string> split(const std::string& text)
{
    std::vector<std::string> parts;
    size_t begin = 0;
    while (true)
    {
        const size_t comma = text.find(',', begin);
        parts.push_back(text.substr(begin, comma - begin));
        if (comma == std::string::npos) return parts;
        begin = comma + 1;
    }
}

void assign(const SettingField& target, const std::string& text)
{
    const std::vector<std::string> parts = split(text);
    const auto fail = [&](const std::string& expected)
    { throw SettingError("--set " + target.name + "=" + text + ": expected " + expected); };
    if (parts.size() != target.count) fail(std::to_string(target.count) + " value(s), separated by commas");
    for (size_t i = 0; i < parts.size(); i++)
    {
        const auto parse = [&](auto* values) -> const char*
        {
            auto value = values[i];
            const char* expected = parseValue(parts[i], value);
            if (!expected) values[i] = value;
            return expected;
        };
        if (const char* expected = std::visit(parse, target.target)) fail(expected);
    }
}
} // namespace

nrd::CheckerboardMode checkerboardModeOf(const ReplaySettings& settings, Family family)
{
    if (family == Family::Reblur) return settings.reblur.checkerboardMode;
    if (family == Family::Sigma) return settings.sigma.checkerboardMode;
    return family == Family::Relax ? settings.relax.checkerboardMode : nrd::CheckerboardMode::OFF;
}

std::vector<SettingField> settingFields(ReplaySettings& settings, Family family)
{
    std::vector<SettingField> fields = commonFields(settings.common);
    std::vector<SettingField> own;
    switch (family)
    {
    case Family::Reblur:
        own = reblurFields(settings.reblur);
        break;
    case Family::Relax:
        own = relaxFields(settings.relax);
        break;
    case Family::Reference:
        own = referenceFields(settings.reference);
        break;
    case Family::Sigma:
        own = sigmaFields(settings.sigma);
        break;
    case Family::None:
        break;
    }
    fields.insert(fields.end(), std::make_move_iterator(own.begin()), std::make_move_iterator(own.end()));
    return fields;
}

ReplaySettings presetSettings(nrd::Quality preset)
{
    ReplaySettings settings;
    settings.reblur = nrd::GetReblurSettings(preset);
    settings.relax = nrd::GetRelaxSettings(preset);
    settings.sigma = nrd::GetSigmaSettings(preset);
    return settings;
}

nrd::Quality parsePreset(const std::string& text)
{
    nrd::Quality preset = nrd::Quality::BALANCED;
    if (const char* expected = parseValue(text, preset))
        throw SettingError("--preset " + text + ": expected " + expected);
    return preset;
}

const char* nameOf(nrd::Quality preset) { return ModeNames<nrd::Quality>::names[static_cast<size_t>(preset)]; }

Assignment parseAssignment(const std::string& text)
{
    const size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0) throw SettingError("--set " + text + ": expected key=value");
    return {text.substr(0, equals), text.substr(equals + 1)};
}

void applySettings(ReplaySettings& settings, Family family, const std::vector<Assignment>& assignments)
{
    const std::vector<SettingField> fields = settingFields(settings, family);
    for (const auto& [key, value] : assignments)
    {
        const SettingField* found = nullptr;
        for (const SettingField& candidate : fields)
            if (candidate.name == key) found = &candidate;
        if (!found) throw SettingError("--set " + key + ": the denoiser has no setting of that name");
        assign(*found, value);
    }
}
} // namespace sample
