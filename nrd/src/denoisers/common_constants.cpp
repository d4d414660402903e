#include "common_constants.h"
#include "frame_state.h"
#include <cmath>

namespace nrd
{
namespace
{
float toFloat(double x) { return static_cast<float>(x); }
shared::vec2 toVec2(const uint16_t (&size)[2]) { return {static_cast<float>(size[0]), static_cast<float>(size[1])}; }
shared::vec2 inverse(const uint16_t (&size)[2]) { return {1.0f / size[0], 1.0f / size[1]}; }

// Golden-ratio sequence frac(start + frame * phi) in 24 bits; 90 degrees cover the kernel's four-fold symmetry.
double kernelAngle(double start, uint32_t frameIndex)
{
    const double x = start + static_cast<double>(frameIndex * 10368889u) / 16777216.0;
    return (x - std::floor(x)) * 1.57079632679489661923;
}

shared::vec4 makeRotator(double angle)
{
    const float c = toFloat(std::cos(angle)), s = toFloat(std::sin(angle));
    return {c, s, -s, c};
}

void fillFrame(const Request& request, shared::DenoiserConstants& g)
{
    const CommonSettings& common = request.common;
    const FrameState& frame = request.frame;
    g.worldToClip = frame.worldToClip;
    g.worldToClipPrev = frame.worldToClipPrev;
    g.worldToViewPrev = frame.worldToViewPrev;
    g.viewToWorld = frame.viewToWorld;
    g.viewToWorldPrev = frame.viewToWorldPrev;
    g.frustum = frame.frustum;
    g.frustumPrev = frame.frustumPrev;
    g.cameraDelta = frame.cameraDelta;
    g.viewDirection = frame.viewDirection;
    g.cameraPosition = frame.cameraPosition;
    g.cameraJitter = {common.cameraJitter[0], common.cameraJitter[1], common.cameraJitterPrev[0],
                      common.cameraJitterPrev[1]};
    g.motionVectorScale = frame.motionVectorScale;
    g.rectSize = toVec2(common.rectSize);
    g.rectSizeInv = inverse(common.rectSize);
    g.rectSizePrev = toVec2(common.rectSizePrev);
    g.resourceSizeInv = inverse(common.resourceSize);
    g.resourceSizeInvPrev = inverse(common.resourceSizePrev);
    g.rectOrigin = {common.rectOrigin[0], common.rectOrigin[1]};
    g.guideStride = static_cast<int32_t>(request.guideStride);
    g.signalStride = static_cast<int32_t>(request.signalStride);
    g.fullRectSizeMinusOne = {request.full.rectSize[0] - 1, request.full.rectSize[1] - 1};
    g.rectSizeMinusOne = {common.rectSize[0] - 1, common.rectSize[1] - 1};
    g.unproject = frame.unproject;
    g.minRectDim = frame.minRectDim;
    g.denoisingRange = common.denoisingRange;
    g.viewZScale = common.viewZScale;
    g.frameRateScale = frame.frameRateScale;
    g.frameIndex = common.frameIndex;
    g.splitScreen = common.splitScreen;
    g.splitScreenPrev = request.isReset ? common.splitScreen : request.history.splitScreen;
    g.isHistoryReset = request.isReset ? 1 : 0;
    g.hasValidation = common.enableValidation ? 1 : 0;
    g.hasDisocclusionMix = common.isDisocclusionThresholdMixAvailable ? 1 : 0;
    g.isCutDetected = common.enableCutDetection ? 1 : 0;
}

void fillRotators(uint32_t frameIndex, shared::DenoiserConstants& g)
{
    // SIGMA blurs twice; 22.5 degrees keep the taps of the second blur off the directions of the first.
    constexpr double kPostBlurOffset = 0.39269908169872415481;
    const double blurAngle = kernelAngle(std::sqrt(1.0 / 3.0), frameIndex);
    g.rotatorPrePass = makeRotator(kernelAngle(std::sqrt(0.5), frameIndex));
    g.rotatorBlur = makeRotator(blurAngle);
    g.rotatorPostBlur = makeRotator(blurAngle + kPostBlurOffset);
}

// A slanted plane moves by up to a pixel between frames, and by the jitter.
void fillDisocclusion(const Request& request, shared::DenoiserConstants& g)
{
    const float bonus = (1.0f + request.frame.jitterDelta) / request.common.rectSize[1];
    g.disocclusionThreshold = request.common.disocclusionThreshold + bonus;
    g.disocclusionThresholdAlternate = request.common.disocclusionThresholdAlternate + bonus;
    g.strandThickness = request.common.strandThickness * request.common.metersToUnits;
    g.strandMaterialID = request.common.strandMaterialID;
    g.cameraAttachedMaterialID = request.common.cameraAttachedReflectionMaterialID;
    g.historyFixAlternateMaterialID = request.common.historyFixAlternatePixelStrideMaterialID;
}

} // namespace

void fillCommon(const Request& request, shared::DenoiserConstants& g)
{
    fillFrame(request, g);
    fillRotators(request.common.frameIndex, g);
    fillDisocclusion(request, g);
}

// Which pixels of this frame have data, and how much a pixel without counts: less the higher the frame rate, since the
// real sample comes with the next frame; half if the jitter makes the frames different anyway.
void fillIncomplete(const Request& request, CheckerboardMode checkerboard, HitDistanceReconstructionMode reconstruction,
                    shared::DenoiserConstants& g)
{
    const double framesPerSecond = 30.0 * request.frame.frameRateScale, a = framesPerSecond / 4.0;
    g.checkerboard = static_cast<uint32_t>(checkerboard);
    g.checkerboardResolve = toFloat(mix(a / (1.0 + a), 0.5, saturate(request.frame.jitterDelta)));
    g.reconstructionRadius = static_cast<int32_t>(reconstruction);
}

// Of a mean against its history: a sample of about 70 times the history passes a loose limit, one of 35 a tight one; of
// what is more, a share that shrinks as the history grows, so that light may come to where all was black.
void fillFireflies(bool isCapped, float minScale, float headroom, float maxBlurRadius, shared::DenoiserConstants& g)
{
    g.isCapped = isCapped ? 1 : 0;
    g.fireflyMinScale = minScale;
    g.fireflyHeadroom = headroom;
    g.fireflyStrictness = 0.1f * maxBlurRadius;
}
} // namespace nrd
