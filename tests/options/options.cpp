#include "options.h"
#include "long_form.h"
#include <algorithm>
#include <iterator>

namespace options
{
namespace
{
using Common = nrd::CommonSettings;

using Reconstruction = nrd::HitDistanceReconstructionMode;
using Relax = nrd::RelaxSettings;

void leaveHalfOut(Setup& setup, Reconstruction mode)
{
    setup.isHalfMissing = true;
    setup.changeSettings([mode](auto& s) { s.hitDistanceReconstructionMode = mode; });
}

void dropPrePass(Setup& setup)
{
    setup.changeSettings([](auto& s) { s.diffusePrepassBlurRadius = s.specularPrepassBlurRadius = 0.0f; });
}

const Option kDefaults[] = {{"defaults", [](Setup&) {}}};

const Option kIncomplete[] = {
    {"checkerboard black", [](Setup& s) { setCheckerboard(s, nrd::CheckerboardMode::BLACK); }},
    {"checkerboard white", [](Setup& s) { setCheckerboard(s, nrd::CheckerboardMode::WHITE); }},
    {"broken samples", [](Setup& s) { s.isBroken = true; }},
};

const Option kSettings[] = {
    {"reconstruction 3x3", [](Setup& s) { leaveHalfOut(s, Reconstruction::AREA_3X3); }},
    {"reconstruction 5x5", [](Setup& s) { leaveHalfOut(s, Reconstruction::AREA_5X5); }},
    {"checkerboard with reconstruction",
     [](Setup& s)
     {
         setCheckerboard(s, nrd::CheckerboardMode::BLACK);
         leaveHalfOut(s, Reconstruction::AREA_5X5);
     }},
    {"no pre-pass", dropPrePass},
    {"pre-pass off", [](Setup& s) { s.changeSettings([](auto& r) { r.prePassMode = nrd::PrePassMode::OFF; }); }},
    {"no anti-firefly", [](Setup& s) { s.changeSettings([](auto& r) { r.enableAntiFirefly = false; }); }},
    {"anti-firefly", [](Setup& s) { s.changeSettings([](auto& r) { r.enableAntiFirefly = true; }); }},
    {"no history fix", [](Setup& s) { s.changeSettings([](auto& r) { r.historyFixFrameNum = 0; }); }},
    {"wide history fix", [](Setup& s) { s.changeSettings([](auto& r) { r.historyFixBasePixelStride = 64; }); }},
    {"strict clamp", [](Setup& s) { s.changeSettings([](auto& r) { r.fastHistoryClampingSigmaScale = 1.0f; }); }},
    {"broken samples without pre-pass",
     [](Setup& s)
     {
         s.isBroken = true;
         dropPrePass(s);
     }},
    {"materials",
     [](Setup& s)
     {
         s.hasMaterials = true;
         s.changeSettings([](auto& r) { r.minMaterialForDiffuse = r.minMaterialForSpecular = 0; });
     }},
};

const Option kReblurSettings[] = {
    {"responsive accumulation", [](Setup& s) { s.settings.responsiveAccumulationSettings.roughnessThreshold = 0.5f; }},
    {"reference accumulation", [](Setup& s) { s.settings.enableReferenceAccumulation = true; }},
    {"pre-pass for tracking only", [](Setup& s) { s.settings.usePrepassOnlyForSpecularMotionEstimation = true; }},
    {"history length output", [](Setup& s) { s.settings.returnHistoryLengthInsteadOfOcclusion = true; }},
    {"no stabilisation", [](Setup& s) { s.settings.maxStabilizedFrameNum = 0; }},
    {"no fast clamp", [](Setup& s) { s.settings.maxFastAccumulatedFrameNum = 63; }},
    {"no history", [](Setup& s) { s.settings.maxAccumulatedFrameNum = 0; }},
};

void setHistories(Relax& r, uint32_t diffuse, uint32_t specular)
{
    r.diffuseMaxAccumulatedFrameNum = diffuse;
    r.specularMaxAccumulatedFrameNum = specular;
}

void relaxByConfidence(Setup& s)
{
    s.confidence = 0.25f;
    s.relaxSettings.confidenceDrivenRelaxationMultiplier = 1.0f;
    s.relaxSettings.confidenceDrivenLuminanceEdgeStoppingRelaxation = 1.0f;
    s.relaxSettings.confidenceDrivenNormalEdgeStoppingRelaxation = 1.0f;
}

void setEdgeRelaxation(Relax& r, float amount)
{
    r.luminanceEdgeStoppingRelaxation = r.normalEdgeStoppingRelaxation = amount;
    r.roughnessEdgeStoppingRelaxation = amount;
}

const Option kRelaxHistory[] = {
    {"no antilag", [](Setup& s)
     { s.relaxSettings.antilagSettings.accelerationAmount = s.relaxSettings.antilagSettings.resetAmount = 0; }},
    {"full antilag", [](Setup& s)
     { s.relaxSettings.antilagSettings.accelerationAmount = s.relaxSettings.antilagSettings.resetAmount = 1; }},
    {"no history", [](Setup& s) { setHistories(s.relaxSettings, 0, 0); }},
    {"long diffuse, short specular history", [](Setup& s) { setHistories(s.relaxSettings, 63, 4); }},
    {"long specular, short diffuse history", [](Setup& s) { setHistories(s.relaxSettings, 4, 63); }},
    {"no fast clamp", [](Setup& s)
     { s.relaxSettings.diffuseMaxFastAccumulatedFrameNum = s.relaxSettings.specularMaxFastAccumulatedFrameNum = 63; }},
    {"strict normals in the history fix", [](Setup& s) { s.relaxSettings.historyFixEdgeStoppingNormalPower = 128.0f; }},
    {"variance boost", [](Setup& s) { s.relaxSettings.specularVarianceBoost = 65504.0f; }},
};

const Option kRelaxWavelet[] = {
    {"2 steps", [](Setup& s) { s.relaxSettings.atrousIterationNum = 2; }},
    {"3 steps", [](Setup& s) { s.relaxSettings.atrousIterationNum = 3; }},
    {"8 steps", [](Setup& s) { s.relaxSettings.atrousIterationNum = 8; }},
    {"no spatial variance", [](Setup& s) { s.relaxSettings.spatialVarianceEstimationHistoryThreshold = 0; }},
    {"spatial variance always", [](Setup& s) { s.relaxSettings.spatialVarianceEstimationHistoryThreshold = 63; }},
    {"phi 0", [](Setup& s) { s.relaxSettings.diffusePhiLuminance = s.relaxSettings.specularPhiLuminance = 0.0f; }},
    {"phi 100", [](Setup& s) { s.relaxSettings.diffusePhiLuminance = s.relaxSettings.specularPhiLuminance = 100.0f; }},
    {"no luminance stop",
     [](Setup& s) { s.relaxSettings.diffuseMinLuminanceWeight = s.relaxSettings.specularMinLuminanceWeight = 1.0f; }},
    {"thick planes", [](Setup& s) { s.relaxSettings.depthThreshold = 1.0f; }},
    {"lobe angle 0", [](Setup& s) { s.relaxSettings.lobeAngleFraction = 0.0f; }},
    {"lobe angle 1", [](Setup& s) { s.relaxSettings.lobeAngleFraction = 1.0f; }},
    {"lobe angle slack 0", [](Setup& s) { s.relaxSettings.specularLobeAngleSlack = 0.0f; }},
    {"lobe angle slack 90", [](Setup& s) { s.relaxSettings.specularLobeAngleSlack = 90.0f; }},
    {"no roughness stop", [](Setup& s) { s.relaxSettings.enableRoughnessEdgeStopping = false; }},
    {"roughness fraction 0", [](Setup& s) { s.relaxSettings.roughnessFraction = 0.0f; }},
    {"edges do not relax", [](Setup& s) { setEdgeRelaxation(s.relaxSettings, 0.0f); }},
    {"edges relax", [](Setup& s) { setEdgeRelaxation(s.relaxSettings, 1.0f); }},
    {"edges relax by confidence", relaxByConfidence},
};

void pointLight(Setup& s, glm::vec3 direction)
{
    for (int i = 0; i < 3; i++) s.sigmaSettings.lightDirection[i] = direction[i];
}

void placeLight(Setup& s, glm::vec3 position)
{
    s.sigmaSettings.isLightLocal = true;
    for (int i = 0; i < 3; i++) s.sigmaSettings.lightPosition[i] = position[i] * s.unitsPerMeter;
}

void dropHistory(Setup& s) { s.hasHistory = false; }

const Option kSigmaSettings[] = {
    {"steep light",
     [](Setup& s) {
         pointLight(s, {0.2f, 3.0f, -0.1f});
     }},
    {"flat light",
     [](Setup& s) {
         pointLight(s, {1.0f, 0.1f, 0.3f});
     }},
    {"local light",
     [](Setup& s) {
         placeLight(s, {0.5f, 1.0f, 4.0f});
     }},
    {"light at the camera",
     [](Setup& s) {
         placeLight(s, {0.0f, 1.5f, -1.0f});
     }},
    {"thick planes", [](Setup& s) { s.sigmaSettings.planeDistanceSensitivity = 1.0f; }},
    {"no stabilisation", [](Setup& s) { s.sigmaSettings.maxStabilizedFrameNum = 0; }},
    {"longest stabilisation", [](Setup& s) { s.sigmaSettings.maxStabilizedFrameNum = 15; }},
    {"no history", dropHistory},
    {"no history, checkerboard",
     [](Setup& s)
     {
         dropHistory(s);
         setCheckerboard(s, nrd::CheckerboardMode::WHITE);
     }},
    {"no history, half resolution in a rectangle",
     [](Setup& s)
     {
         dropHistory(s);
         s.resolutionDivisor = 2;
         s.rect = glm::max(s.size * 3 / 4, glm::ivec2(1));
     }},
    {"no history, split screen",
     [](Setup& s)
     {
         dropHistory(s);
         s.changeCommon = [](Common& common, int) { common.splitScreen = 0.5f; };
     }},
    {"checkerboard, half resolution",
     [](Setup& s)
     {
         setCheckerboard(s, nrd::CheckerboardMode::BLACK);
         s.resolutionDivisor = 2;
     }},
};

const Option kLobeFrames[] = {
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
};

const Option kFrames[] = {
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

void halve(Setup& s, nrd::FullSize fullSize)
{
    s.resolutionDivisor = 2;
    s.fullSize = fullSize;
}

void placeMovingOnScreen(Setup& s)
{
    s.rect = glm::max(s.size * 3 / 4, glm::ivec2(1));
    s.origin = s.size - s.rect;
    s.motion = MotionKind::Screen;
    s.isJittered = true;
}

const Option kUpsampled[] = {
    {"every fourth pixel, upsampled", [](Setup& s) { halve(s, nrd::FullSize::GUIDES_AND_OUTPUTS); }},
    {"the same in a rectangle with origin, 2D motion, jitter",
     [](Setup& s)
     {
         halve(s, nrd::FullSize::GUIDES_AND_OUTPUTS);
         placeMovingOnScreen(s);
     }},
};

const Option kDownsampled[] = {
    {"means of four pixels, upsampled", [](Setup& s) { halve(s, nrd::FullSize::EVERYTHING); }},
    {"the same in a rectangle with origin, 2D motion, jitter, broken samples",
     [](Setup& s)
     {
         halve(s, nrd::FullSize::EVERYTHING);
         placeMovingOnScreen(s);
         s.isBroken = true;
     }},
};

const Option kPlaces[] = {
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
    {"jitter", [](Setup& s) { s.isJittered = true; }},
};

const Option kMotions[] = {
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
};
} // namespace

const std::vector<Option>& allOptions(nrd::Denoiser denoiser)
{
    const auto join = [](std::initializer_list<std::span<const Option>> tables)
    {
        std::vector<Option> all;
        for (const auto& table : tables) all.insert(all.end(), table.begin(), table.end());
        return all;
    };
    static const std::vector<Option> reblur = join({kDefaults, kIncomplete, kSettings, kReblurSettings, kLobeFrames,
                                                    kFrames, kUpsampled, kDownsampled, kPlaces, kMotions});
    static const std::vector<Option> relax = join({kDefaults, kIncomplete, kSettings, kRelaxHistory, kRelaxWavelet,
                                                   kLobeFrames, kFrames, kUpsampled, kDownsampled, kPlaces, kMotions});
    static const std::vector<Option> sigma =
        join({kDefaults, kIncomplete, kSigmaSettings, kFrames, kUpsampled, kPlaces, kMotions});
    static const std::vector<Option> reference = join({kDefaults, kFrames, kPlaces});
    switch (familyOf(denoiser))
    {
    case Family::Reblur:
        return reblur;
    case Family::Relax:
        return relax;
    case Family::Sigma:
        return sigma;
    case Family::Reference:
        break;
    }
    return reference;
}

std::span<const nrd::Denoiser> allDenoisers()
{
    const nrd::LibraryDesc& library = nrd::GetLibraryDesc();
    return {library.supportedDenoisers, library.supportedDenoisersNum};
}

bool isWidest(nrd::Denoiser denoiser)
{
    using D = nrd::Denoiser;
    for (const D widest :
         {D::REBLUR_DIFFUSE_SPECULAR_SH, D::REBLUR_DIFFUSE_SPECULAR_OCCLUSION, D::REBLUR_DIFFUSE_DIRECTIONAL_OCCLUSION,
          D::RELAX_DIFFUSE_SPECULAR_SH, D::SIGMA_SHADOW_TRANSLUCENCY, D::REFERENCE})
        if (denoiser == widest) return true;
    return false;
}

std::span<const nrd::Denoiser> testedDenoisers()
{
    if (test::isMiddle()) return allDenoisers();
    static const std::vector<nrd::Denoiser> some = []
    {
        std::vector<nrd::Denoiser> result = {nrd::Denoiser::REBLUR_SPECULAR, nrd::Denoiser::RELAX_DIFFUSE,
                                             nrd::Denoiser::SIGMA_SHADOW};
        std::copy_if(allDenoisers().begin(), allDenoisers().end(), std::back_inserter(result), isWidest);
        return result;
    }();
    return some;
}

bool isRepresentative(nrd::Denoiser denoiser)
{
    return test::isLong() || !isRelax(denoiser) || denoiser == nrd::Denoiser::RELAX_DIFFUSE ||
           denoiser == nrd::Denoiser::RELAX_SPECULAR || denoiser == nrd::Denoiser::RELAX_DIFFUSE_SPECULAR_SH;
}

Setup makeSetup(nrd::Denoiser denoiser, glm::ivec2 size)
{
    Setup setup;
    setup.denoiser = denoiser;
    setup.size = setup.rect = size;
    if (denoiser == nrd::Denoiser::REFERENCE) setup.speed = 0.0f; // another camera starts another mean
    return setup;
}
} // namespace options
