#include "options.h"

namespace options
{
namespace
{
using Common = nrd::CommonSettings;

const Option kSettings[] = {
    {"defaults", [](Setup&) {}},
    {"checkerboard black", [](Setup& s) { s.settings.checkerboardMode = nrd::CheckerboardMode::BLACK; }},
    {"checkerboard white", [](Setup& s) { s.settings.checkerboardMode = nrd::CheckerboardMode::WHITE; }},
    {"reconstruction 3x3",
     [](Setup& s)
     {
         s.settings.hitDistanceReconstructionMode = nrd::HitDistanceReconstructionMode::AREA_3X3;
         s.isHalfMissing = true;
     }},
    {"reconstruction 5x5",
     [](Setup& s)
     {
         s.settings.hitDistanceReconstructionMode = nrd::HitDistanceReconstructionMode::AREA_5X5;
         s.isHalfMissing = true;
     }},
    {"checkerboard with reconstruction",
     [](Setup& s)
     {
         s.settings.checkerboardMode = nrd::CheckerboardMode::BLACK;
         s.settings.hitDistanceReconstructionMode = nrd::HitDistanceReconstructionMode::AREA_5X5;
         s.isHalfMissing = true;
     }},
    {"responsive accumulation", [](Setup& s) { s.settings.responsiveAccumulationSettings.roughnessThreshold = 0.5f; }},
    {"reference accumulation", [](Setup& s) { s.settings.enableReferenceAccumulation = true; }},
    {"pre-pass for tracking only", [](Setup& s) { s.settings.usePrepassOnlyForSpecularMotionEstimation = true; }},
    {"history length output", [](Setup& s) { s.settings.returnHistoryLengthInsteadOfOcclusion = true; }},
    {"no pre-pass",
     [](Setup& s) { s.settings.diffusePrepassBlurRadius = s.settings.specularPrepassBlurRadius = 0.0f; }},
    {"no stabilisation", [](Setup& s) { s.settings.maxStabilizedFrameNum = 0; }},
    {"no anti-firefly", [](Setup& s) { s.settings.enableAntiFirefly = false; }},
    {"no fast clamp", [](Setup& s) { s.settings.maxFastAccumulatedFrameNum = 63; }},
    {"no history", [](Setup& s) { s.settings.maxAccumulatedFrameNum = 0; }},
    {"no history fix", [](Setup& s) { s.settings.historyFixFrameNum = 0; }},
    {"broken samples", [](Setup& s) { s.isBroken = true; }},
    {"broken samples without pre-pass",
     [](Setup& s)
     {
         s.isBroken = true;
         s.settings.diffusePrepassBlurRadius = s.settings.specularPrepassBlurRadius = 0.0f;
     }},
    {"materials",
     [](Setup& s)
     {
         s.hasMaterials = true;
         s.settings.minMaterialForDiffuse = s.settings.minMaterialForSpecular = 0;
     }},
};

const Option kFrames[] = {
    {"confidence 0", [](Setup& s) { s.confidence = 0.0f; }},
    {"confidence 0.5", [](Setup& s) { s.confidence = 0.5f; }},
    {"threshold mix", [](Setup& s) { s.thresholdMix = 1.0f; }},
    {"strands",
     [](Setup& s)
     {
         s.hasMaterials = true;
         s.changeCommon = [](Common& common, int) { common.strandMaterialID = 1; };
     }},
    {"reflections attached to the camera",
     [](Setup& s)
     {
         s.hasMaterials = true;
         s.changeCommon = [](Common& common, int) { common.cameraAttachedReflectionMaterialID = 1; };
     }},
    {"alternate stride of the history fix",
     [](Setup& s)
     {
         s.hasMaterials = true;
         s.changeCommon = [](Common& common, int) { common.historyFixAlternatePixelStrideMaterialID = 1; };
     }},
    {"split screen 0.5", [](Setup& s) { s.changeCommon = [](Common& common, int) { common.splitScreen = 0.5f; }; }},
    {"split screen 1", [](Setup& s) { s.changeCommon = [](Common& common, int) { common.splitScreen = 1.0f; }; }},
    {"restart in the middle",
     [](Setup& s)
     {
         s.changeCommon = [](Common& common, int frame)
         { common.accumulationMode = frame == 1 ? nrd::AccumulationMode::RESTART : nrd::AccumulationMode::CONTINUE; };
     }},
    {"no cut detection",
     [](Setup& s) { s.changeCommon = [](Common& common, int) { common.enableCutDetection = false; }; }},
    {"centimetres", [](Setup& s) { s.unitsPerMeter = 100.0f; }},
    {"half resolution", [](Setup& s) { s.resolutionDivisor = 2; }},
};

const Option kInputs[] = {
    {"large formats", [](Setup& s) { s.hasLargeFormats = true; }},
    {"rectangle with origin",
     [](Setup& s)
     {
         s.rect = glm::max(s.size * 3 / 4, glm::ivec2(1));
         s.origin = s.size - s.rect;
     }},
    {"dynamic resolution", [](Setup& s) { s.isRectVarying = true; }},
    {"reversed depth", [](Setup& s) { s.projection = Projection::Reversed; }},
    {"infinite depth", [](Setup& s) { s.projection = Projection::Infinite; }},
    {"reversed infinite depth", [](Setup& s) { s.projection = Projection::ReversedInfinite; }},
    {"orthographic", [](Setup& s) { s.projection = Projection::Orthographic; }},
    {"orthographic, right-handed",
     [](Setup& s)
     {
         s.projection = Projection::Orthographic;
         s.isRightHanded = true;
     }},
    {"right-handed", [](Setup& s) { s.isRightHanded = true; }},
    {"negative half depths, scaled",
     [](Setup& s)
     {
         s.viewZFactor = -0.125f;
         s.hasHalfViewZ = true;
     }},
    {"2D motion", [](Setup& s) { s.motion = MotionKind::Screen; }},
    {"2.5D motion", [](Setup& s) { s.motion = MotionKind::Screen25; }},
    {"2.5D motion of negative scaled depths",
     [](Setup& s)
     {
         s.motion = MotionKind::Screen25;
         s.isRightHanded = true;
         s.viewZFactor = 0.5f;
     }},
    {"3D motion, scaled",
     [](Setup& s)
     {
         s.motionFactor = 128.0f;
         s.sceneVelocity = {0.25f, 0.0f, 0.125f};
     }},
    {"jitter", [](Setup& s) { s.isJittered = true; }},
};
} // namespace

const std::vector<Option>& allOptions()
{
    static const std::vector<Option> options = []
    {
        std::vector<Option> all(std::begin(kSettings), std::end(kSettings));
        all.insert(all.end(), std::begin(kFrames), std::end(kFrames));
        all.insert(all.end(), std::begin(kInputs), std::end(kInputs));
        return all;
    }();
    return options;
}

Setup makeSetup(nrd::Denoiser denoiser, glm::ivec2 size)
{
    Setup setup;
    setup.denoiser = denoiser;
    setup.size = setup.rect = size;
    return setup;
}
} // namespace options
