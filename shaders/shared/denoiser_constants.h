// One block for every pass of REBLUR or RELAX in a frame. World positions have their origin at the current camera.
#ifndef DENOISER_CONSTANTS_H
#define DENOISER_CONSTANTS_H
#include "shared_types.h"

SHARED_BEGIN
struct DenoiserConstants
{
    mat4 worldToClip;     // current, origin at the current camera
    mat4 worldToClipPrev; // previous camera, same origin
    mat4 worldToViewPrev; // left-handed: z forward
    mat4 viewToWorld;     // rotation only (the origin is the camera)
    mat4 viewToWorldPrev; // previous view to current-camera-relative world
    vec4 frustum;         // .xy slopes of the top left corner, .zw extent: Xv.xy = (xy + uv * zw) * z
    vec4 frustumPrev;
    vec4 cameraDelta;     // .xyz previous minus current camera position, .w 1 = orthographic
    vec4 viewDirection;   // .xyz surface to camera in world space, for orthographic projections
    vec4 cameraPosition;  // .xyz absolute, modulo 1024 units; only to show world positions
    vec4 cameraJitter;    // .xy pixels, .zw last frame's; only to show it
    vec4 rotatorPrePass;  // cos, sin, -sin, cos
    vec4 rotatorBlur;
    vec4 rotatorPostBlur;
    vec4 hitDistanceParameters; // A, B, C, unused
    vec4 motionVectorScale;     // .w 1 = world space
    vec4 relaxDoubt;      // by confidence: multiplier, of the luma stop, of the normal stop; .w unused
    vec4 relaxAntilag;    // acceleration, spatial sigma, temporal sigma, reset
    vec4 sigmaLight;      // .xyz in view space: .w 1 = direction to the light, 2 = its position, 0 = unknown
    vec2 rectSize;        // pixels
    vec2 rectSizeInv;
    vec2 rectSizePrev;
    vec2 resourceSizeInv;     // 1 / size of the textures
    vec2 resourceSizeInvPrev;
    vec2 relaxPhi;         // of the luma stops, diffuse and specular
    vec2 relaxMaxLumaStop; // cap of their exponents
    vec2 relaxEdgeRelaxation; // of the luma and the normal stop, by doubt about the reprojection
    vec2 maxAccumulatedFrameNum; // diffuse, specular
    vec2 maxFastAccumulatedFrameNum;
    vec2 convergence;     // s * b, s * (1 - b): e(n) = x + y * sat(n * convergenceLengthInv)
    ivec2 rectOrigin;     // of the guides, pixels
    ivec2 rectSizeMinusOne;
    ivec2 fullRectSizeMinusOne; // of the guides, where signals are smaller
    float convergenceLengthInv;  // 1 / (1 + p * Nmax)
    float unproject;      // world size of a pixel at z = 1 (perspective) or at any z (orthographic)
    float minRectDim;     // pixels
    float denoisingRange;
    float viewZScale;
    float disocclusionThreshold; // jitter and slope bonus included
    float disocclusionThresholdAlternate;
    float planeDistanceSensitivity;
    float historyFixFrameNum;
    float minBlurRadius;
    float maxBlurRadius;
    float diffusePrepassRadius;
    float specularPrepassRadius;
    float lobeAngleFraction; // squared
    float roughnessFraction;
    float minHitDistanceWeight;
    float historyFixStride;
    float historyFixAlternateStride;
    float fastClampSigmaScale;
    float fireflyMinScale;
    float fireflyHeadroom;
    float fireflyStrictness; // how soon with the length of a history a limit relative to it counts
    float antilagSigmaScale;
    float antilagSensitivity;
    float stabilizationStrength;
    float frameRateScale; // >= 1
    float responsiveRoughnessThreshold;
    float responsiveMinFrameNum;
    float splitScreen;
    float splitScreenPrev;
    float strandThickness;
    float relaxLobeAngle; // share of the lobe
    float relaxLobeAngleSlack; // radians
    float relaxDepthThreshold; // fraction of the depth
    float relaxFixNormalPower;
    float relaxViewRelaxation;
    float relaxVarianceBoost;
    float relaxSpatialVarianceFrameNum;
    uint relaxRoughnessStop;  // 1: on
    uint strandMaterialID;
    uint cameraAttachedMaterialID;
    uint historyFixAlternateMaterialID;
    uint minMaterialForDiffuse;
    uint minMaterialForSpecular;
    uint frameIndex;
    uint isHistoryReset;      // 1: every history length is 0 in this frame
    uint isPrepassTrackingOnly;
    uint returnHistoryLength;
    uint hasValidation;       // 1: OUT_VALIDATION is drawn
    uint isCutDetected;       // 1: the texture "Cut" holds the votes of this frame's pixels
    uint hasDisocclusionMix;  // 1: IN_DISOCCLUSION_THRESHOLD_MIX is bound
    uint isCapped;            // 1: the texture "Cap" says how bright a sample may be
    uint checkerboard;        // value of CheckerboardMode
    float checkerboardResolve;
    int reconstructionRadius; // pixels, 0 = hit distances are complete
    int guideStride;          // pixels of the guides from one pixel of the signals to the next
    int signalStride;         // of what the application hands over as a signal; above 1, it is averaged first
};
SHARED_END

#endif
