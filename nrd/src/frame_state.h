// Common settings -> what the constants of every family are made of. Pure; computed in double precision, because the
// previous camera relative to the current one is a small difference of large numbers.
#pragma once
#include "math.h"
#include "shared_types.h"
#include <nrd/settings.h>

namespace nrd
{
// What a projection matrix says, for a left-handed view space (z forward).
struct Projection
{
    Double4x4 viewToClip; // acts on left-handed view space
    double frustum[4] =
        {};              // Xv.xy = (frustum.xy + uv * frustum.zw) * z, without z if orthographic; uv (0; 0) = top left
    double yScale = 1.0; // cot(fovY / 2), or 2 / height
    double viewZSign = 1.0; // of z in front of the camera: -1 for right-handed view spaces
    bool isOrthographic = false;
};
Projection makeProjection(const float (&viewToClip)[16]);

struct FrameState
{
    Double4x4 worldToClipAbsolute; // of the world as given, to compare with the last one

    shared::mat4 worldToClip; // the world of these has its origin at the current camera
    shared::mat4 worldToClipPrev;
    shared::mat4 worldToViewPrev;
    shared::mat4 viewToWorld;
    shared::mat4 viewToWorldPrev;
    shared::vec4 frustum;
    shared::vec4 frustumPrev;
    shared::vec4 cameraDelta;       // .w 1 = orthographic
    shared::vec4 viewDirection;     // surface to camera
    shared::vec4 cameraPosition;    // modulo 1024 units
    shared::vec4 motionVectorScale; // .w 1 = world space
    float unproject = 0.0f;         // world size of a pixel at z = 1, or at any z if orthographic
    float minRectDim = 0.0f;        // pixels
    float jitterDelta = 0.0f;       // pixels, largest axis
    float radiusScale = 0.0f;       // blur radii: their pixels at 1440 lines to this rectangle's
    float frameRateScale = 1.0f;    // 33.3 ms / frame time, at least 1
};
FrameState makeFrameState(const CommonSettings& common, float frameRateScale);

// A world-space point or direction in the left-handed view space of the shaders.
Double3 toViewSpace(const CommonSettings& common, const Double3& v, bool isPoint);

// On reset there is no previous frame to reproject: sizes and jitter become the current ones.
CommonSettings withoutPreviousFrame(const CommonSettings& common);

// A denoiser of a lower resolution: everything in pixels shrinks, sizes are rounded up.
CommonSettings atResolution(const CommonSettings& common, uint32_t divisor);
// The same for signals whose pixel p was traced from pixel p * divisor: its screen ends half a pixel of the signals
// around the outermost of these, so views and motion are those of that screen.
CommonSettings atPickedPixels(const CommonSettings& common, uint32_t divisor);

// Share of this frame's view directions that were inside the last frustum; translation is left to the device, which
// knows depths. Orthographic views overlap as long as they look roughly the same way.
double findViewOverlap(const CommonSettings& common);

// Degrees between two orientations, columns of rotation matrices.
double angleBetween(const float (&a)[16], const float (&b)[16]);

// Frame time from a monotonic clock, calm in steady state, quick after jumps.
struct FrameClock
{
    double lastTime = 0.0; // ms
    double smoothed = 0.0; // ms, 0 = nothing measured yet
    uint32_t frameIndex = 0;
    bool isRunning = false;
};
FrameClock tick(const FrameClock& clock, uint32_t frameIndex, double time);
double smoothFrameTime(double smoothed, double measured); // ms; smoothed 0 = none yet
float frameRateScale(double frameTime);                   // ms; 0 = unknown, gives 1
} // namespace nrd
