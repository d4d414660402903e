// What goes in: settings of a frame and of each denoiser family. Every field has a default, a unit and a range;
// a setter refuses what is out of range with one sentence that names the field and keeps the old settings.
#pragma once
#include <nrd/types.h>

namespace nrd
{
// Matrices are column-major, for column vectors, without jitter; clip space is Y up with depth in [0; 1], reversed
// and infinite depth allowed; view space is X right, Y up, Z either way. What is last frame's is this frame's in the
// first one and after a cut.
struct CommonSettings
{
    float viewToClipMatrix[16] = {};     // perspective or orthographic, invertible
    float viewToClipMatrixPrev[16] = {}; // last frame's
    float worldToViewMatrix[16] = {};    // rotation and translation
    float worldToViewMatrixPrev[16] = {};

    // mv = IN_MV * motionVectorScale. World space: scene motion only, camera excluded, (0; 0; 0) = static scene.
    // Otherwise uvPrev = uv + mv.xy and, with z != 0, viewZPrev = viewZ + mv.z, both as stored in IN_VIEWZ;
    // z = 0 derives the depth from the camera. In world space z = 0 is taken as x unless all three are 0.
    float motionVectorScale[3] = {1.0f, 1.0f, 0.0f};
    bool isMotionVectorInWorldSpace = false;

    float cameraJitter[2] = {};     // [-0.5; 0.5] pixels, sample position = pixel centre + jitter
    float cameraJitterPrev[2] = {}; // last frame's

    uint16_t resourceSize[2] = {};     // >= 1 pixels, size of all full-resolution textures
    uint16_t resourceSizePrev[2] = {}; // last frame's
    uint16_t rectSize[2] = {};         // [1; resourceSize] pixels, the active part
    uint16_t rectSizePrev[2] = {};     // last frame's
    uint16_t rectOrigin[2] = {};       // pixels, offset of the guides (motion, normal-roughness, viewZ) only

    // Previous minus current camera position, world units. Derived from the matrices unless the flag is set:
    // far from the origin 32-bit matrices have already lost it.
    double cameraDelta[3] = {};
    bool isCameraDeltaAvailable = false;

    float metersToUnits = 1.0f;          // > 0, world units per metre; scales every setting given in metres
    float viewZScale = 1.0f;             // > 0, viewZ = abs(IN_VIEWZ * viewZScale)
    float timeDeltaBetweenFrames = 0.0f; // >= 0 ms, 0 = measured inside
    float denoisingRange = 500000.0f;    // > 0 units; beyond it outputs are not written; at most 1e6 are told apart

    float disocclusionThreshold = 0.01f;               // (0; 1], fraction of the frustum's size at that depth
    float disocclusionThresholdAlternate = 0.05f;      // (0; 1], reached where IN_DISOCCLUSION_THRESHOLD_MIX is 1
    uint32_t cameraAttachedReflectionMaterialID = 999; // reflections that move with the camera, 999 = none
    uint32_t strandMaterialID = 999;                   // hair and grass, 999 = none
    uint32_t historyFixAlternatePixelStrideMaterialID = 999;
    float strandThickness = 80e-6f; // > 0 metres

    float splitScreen = 0.0f; // [0; 1], left part shows the input, 1 = only that; REFERENCE leaves that part alone

    uint32_t frameIndex = 0; // + 1 per frame
    AccumulationMode accumulationMode = AccumulationMode::CONTINUE;
    // Treats a frame as RESTART does when the matrices leave no overlap with the last frame or hardly a pixel finds
    // its surface there.
    bool enableCutDetection = true;

    bool isHistoryConfidenceAvailable = false;        // IN_DIFF_CONFIDENCE and IN_SPEC_CONFIDENCE are bound
    bool isDisocclusionThresholdMixAvailable = false; // IN_DISOCCLUSION_THRESHOLD_MIX is bound
    bool isSpecularMotionAvailable = false;           // IN_SPEC_MV is bound
    bool enableValidation = false;                    // OUT_VALIDATION is bound; REBLUR writes it
};

// Hit distance is divided by (A + viewZ * B) * mix(C, 1, spread(roughness)), see REBLUR_FrontEnd_GetNormHitDist.
struct HitDistanceParameters
{
    float A = 3.0f;  // > 0 metres; the shader takes A * CommonSettings::metersToUnits
    float B = 0.1f;  // > 0, units per unit of viewZ
    float C = 20.0f; // >= 1, how much longer the range of a mirror is
};

struct ReblurAntilagSettings
{
    float luminanceSigmaScale = 2.0f;  // (0; 100], half width of the box in standard deviations
    float luminanceSensitivity = 3.0f; // (0; 100], smaller reacts faster
};

struct ResponsiveAccumulationSettings
{
    float roughnessThreshold = 0.0f;     // [0; 1], 0 = off
    uint32_t minAccumulatedFrameNum = 3; // [0; historyFixFrameNum] frames
};

// e(n) = s * mix(b, 1, sat(n / (1 + p * maxAccumulatedFrameNum))), the filters' footprint area is 1 / (1 + e(n) * n).
struct ConvergenceSettings
{
    float s = 0.6f; // (0; 10]
    float b = 0.2f; // [0; 1]
    float p = 0.8f; // [0; 1]
};

struct ReblurSettings
{
    HitDistanceParameters hitDistanceParameters = {};
    ReblurAntilagSettings antilagSettings = {};
    ResponsiveAccumulationSettings responsiveAccumulationSettings = {};
    ConvergenceSettings convergenceSettings = {};

    uint32_t maxAccumulatedFrameNum = 40;         // [0; 63] frames, about two thirds of a second
    uint32_t maxFastAccumulatedFrameNum = 6;      // [0; 63] frames, >= maxAccumulatedFrameNum = no fast-history clamp
    uint32_t maxStabilizedFrameNum = 63;          // [0; 255] frames, 0 = no temporal stabilisation and no antilag
    uint32_t historyFixFrameNum = 3;              // [0; 8] frames, below maxFastAccumulatedFrameNum
    uint32_t historyFixBasePixelStride = 14;      // [1; 64] pixels
    uint32_t historyFixAlternatePixelStride = 14; // [1; 64] pixels

    float fastHistoryClampingSigmaScale = 2.0f; // [1; 3] standard deviations
    // Radii are pixels at a rectangle of 1440 lines and scale with the square root of its height: fewer pixels average
    // less noise away, but each spans more of the scene. The pre-pass is of use where most samples are missing or
    // wrong; what it blurs no later pass brings back.
    PrePassMode prePassMode = PrePassMode::AUTO;
    float diffusePrepassBlurRadius = 18.0f;         // [0; 256] pixels, 0 = off
    float specularPrepassBlurRadius = 36.0f;        // [0; 256] pixels, 0 = off
    float minHitDistanceWeight = 0.1f;              // [0; 0.2]
    float minBlurRadius = 1.0f;                     // [0; 256] pixels, whatever the height
    float maxBlurRadius = 30.0f;                    // [0; 256] pixels
    float lobeAngleFraction = 0.15f;                // [0; 1]
    float roughnessFraction = 0.15f;                // [0; 1]
    float planeDistanceSensitivity = 0.02f;         // (0; 1], fraction of the frustum's size at that depth
    float fireflySuppressorMinRelativeScale = 2.0f; // [1; 3]
    uint32_t minMaterialForDiffuse = 4;             // >= 0, material IDs from here on do not mix, 4 = test off
    uint32_t minMaterialForSpecular = 4;            // >= 0

    CheckerboardMode checkerboardMode = CheckerboardMode::OFF; // orientation of diffuse; specular is the opposite
    HitDistanceReconstructionMode hitDistanceReconstructionMode = HitDistanceReconstructionMode::OFF;
    bool enableAntiFirefly = true; // what one path in thousands finds; without pre-pass less sure of what that is
    bool usePrepassOnlyForSpecularMotionEstimation = false;
    bool returnHistoryLengthInsteadOfOcclusion = false; // colour only
    // For debugging: no filter but the reprojected mean of up to maxAccumulatedFrameNum frames.
    bool enableReferenceAccumulation = false;
};

struct RelaxAntilagSettings
{
    float accelerationAmount = 0.3f; // [0; 1], push towards the local mean where the fast history clamps, 0 = off
    float spatialSigmaScale = 4.5f;  // (0; 100], tolerated change in standard deviations of the fast history
    float temporalSigmaScale = 0.5f; // (0; 100], ... plus as many of the noisy input
    float resetAmount = 0.5f;        // [0; 1], how far a greater change throws the history away, 0 = off
};

// For direct light of resampled reservoirs: hit distance steers the pre-pass and the motion of reflections, never the
// filter. Radiance is RGB with luminance at most 250; hit distance is in world units.
struct RelaxSettings
{
    RelaxAntilagSettings antilagSettings = {};

    uint32_t diffuseMaxAccumulatedFrameNum = 30;     // [0; 63] frames, about half a second
    uint32_t specularMaxAccumulatedFrameNum = 30;    // [0; 63] frames
    uint32_t diffuseMaxFastAccumulatedFrameNum = 6;  // [0; 63] frames, >= diffuseMaxAccumulatedFrameNum = no clamp
    uint32_t specularMaxFastAccumulatedFrameNum = 6; // [0; 63] frames, >= specularMaxAccumulatedFrameNum = no clamp
    uint32_t historyFixFrameNum = 3;                 // [0; 3] frames, below both fast maxima; 0 = off
    uint32_t historyFixBasePixelStride = 14;         // [1; 64] pixels, divided by 1 + history length
    uint32_t historyFixAlternatePixelStride = 14;    // [1; 64] pixels
    float historyFixEdgeStoppingNormalPower = 8.0f;  // (0; 128], of the cosine between normals; diffuse only
    float fastHistoryClampingSigmaScale = 2.0f;      // [1; 3] standard deviations

    // Radii are pixels at a rectangle of 1440 lines and scale with the square root of its height, as REBLUR's do.
    PrePassMode prePassMode = PrePassMode::AUTO;
    float diffusePrepassBlurRadius = 18.0f;  // [0; 256] pixels, 0 = off
    float specularPrepassBlurRadius = 36.0f; // [0; 256] pixels, 0 = off
    float minHitDistanceWeight = 0.1f;       // (0; 0.2]

    // The wavelet reaches 2^atrousIterationNum - 1 pixels. A difference of luminance counts in standard deviations of
    // the signal: the phis say how many of them lower a weight to 1/e, the minima below what no difference lowers it.
    uint32_t atrousIterationNum = 3;                        // [2; 8] passes
    uint32_t spatialVarianceEstimationHistoryThreshold = 3; // [0; 63] frames, shorter histories look at 6x6 pixels
    float diffusePhiLuminance = 2.0f;                       // [0; 100]
    float specularPhiLuminance = 1.0f;                      // [0; 100]
    float diffuseMinLuminanceWeight = 0.0f;                 // [0; 1], 0 = none, 1 = no luminance stop
    float specularMinLuminanceWeight = 0.0f;                // [0; 1], 0 = none, 1 = no luminance stop
    float specularVarianceBoost = 0.0f;                     // [0; 65504], luminance squared, where motion is doubtful
    float depthThreshold = 0.003f;                          // (0; 1], distance from the plane, fraction of viewZ
    float lobeAngleFraction = 0.5f;                         // [0; 1], a third more if the SH are resolved
    float specularLobeAngleSlack = 0.15f;                   // [0; 90] degrees, added to that of the lobe
    float roughnessFraction = 0.15f;                        // [0; 1]
    // How little a change of the view direction counts as one of the reflection: 0 = in full, 1 = half.
    float roughnessEdgeStoppingRelaxation = 1.0f; // [0; 1]

    // How much edges give way to blur where the history of specular cannot be trusted: 0 = not at all.
    float luminanceEdgeStoppingRelaxation = 0.5f; // [0; 1]
    float normalEdgeStoppingRelaxation = 0.3f;    // [0; 1]
    // The same where IN_DIFF_CONFIDENCE and IN_SPEC_CONFIDENCE are low, by saturate(multiplier * (1 - confidence)).
    float confidenceDrivenRelaxationMultiplier = 0.0f;            // [0; 1], 0 = off
    float confidenceDrivenLuminanceEdgeStoppingRelaxation = 0.0f; // [0; 1]
    float confidenceDrivenNormalEdgeStoppingRelaxation = 0.0f;    // [0; 1]

    uint32_t minMaterialForDiffuse = 4;  // >= 0, material IDs from here on do not mix, 4 = test off
    uint32_t minMaterialForSpecular = 4; // >= 0

    CheckerboardMode checkerboardMode = CheckerboardMode::OFF; // orientation of diffuse; specular is the opposite
    HitDistanceReconstructionMode hitDistanceReconstructionMode = HitDistanceReconstructionMode::OFF;
    bool enableAntiFirefly = false;
    bool enableRoughnessEdgeStopping = true; // false: specular stops at normals as diffuse does
};

// For the visibility of one light, IN_PENUMBRA and IN_TRANSLUCENCY; the output is its square root.
struct SigmaSettings
{
    // Where the light is, so that a penumbra is stretched along the direction the light comes from: on a floor under a
    // low sun it is several times as long as wide. A direction for the sun, a position for a local light.
    float lightDirection[3] = {0.0f, 0.0f, 0.0f}; // world space, from the surface to the light; (0; 0; 0) = unknown
    float lightPosition[3] = {0.0f, 0.0f, 0.0f};  // world space, of use if isLightLocal
    bool isLightLocal = false;

    float planeDistanceSensitivity = 0.02f; // (0; 1], fraction of the frustum's size at that depth
    uint32_t maxStabilizedFrameNum = 8;     // [0; 15] frames, 0 = no temporal stabilisation; longer lags more

    CheckerboardMode checkerboardMode = CheckerboardMode::OFF;
};

// History lengths should come from time: floor(seconds * fps + 0.5), at most 63, the longest history of any family.
// With frame generation fps is the rendered rate. Nothing sensible (NaN, negative) gives 0.
inline uint32_t GetMaxAccumulatedFrameNum(float seconds, float fps)
{
    if (!(seconds > 0.0f) || !(fps > 0.0f)) return 0;
    const float frameNum = seconds * fps + 0.5f;
    return frameNum < 63.0f ? static_cast<uint32_t>(frameNum) : 63; // clamped before the cast: infinity has none
}

// What luminances of samples that were traced again say about history: confidence = 1 - saturate(sensitivity *
// (change - tolerance)), change = mean |now - before| / max(mean max(now, before), minLuminance) of a neighbourhood; of
// a tile and those round it the least. A history whose light changes steadily settles at 1 / (sensitivity * change)
// frames.
struct ConfidenceSettings
{
    float sensitivity = 4.0f;               // (0; 100]
    float tolerance = 0.01f;                // [0; 1], change that may be rounding
    float minLuminance = 0.001f;            // (0; 65504], mean below which nothing matters
    float maxLuminance = 32.0f;             // (0; 65504], brighter samples count as that: one must not speak for all
    float planeDistanceSensitivity = 0.02f; // (0; 1], fraction of the frustum's size at that depth
    uint32_t blurPassNum = 3;               // [0; 5] passes of 5x5 tiles, 1, 2, 3... tiles apart
};

struct ReferenceSettings
{
    uint32_t maxAccumulatedFrameNum = 120; // [0; 4095] frames, exact mean up to here, exponential beyond
};
} // namespace nrd
