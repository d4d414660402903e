// The library's settings for a frame of a capture.
#pragma once
#include "capture.h"

#include <nrd/settings.h>

namespace sample
{
// Camera, jitter, sizes, time and history of frame `frameIndex`; the rest at its defaults. Frames are in order.
nrd::CommonSettings commonSettingsOf(const CaptureInfo& info, size_t frameIndex);

// The capture's A, B and C; A is in world units there, in metres here.
nrd::HitDistanceParameters hitDistanceParametersOf(const CaptureInfo& info);

// `settings` with where the frame's light is, as SIGMA wants to know it; unknown without a light.
nrd::SigmaSettings sigmaSettingsOf(const CaptureLight* light, nrd::SigmaSettings settings = {});

// World position of the camera of a rigid world-to-view matrix.
std::array<double, 3> cameraPositionOf(const Matrix& worldToView);

// Slopes x/z and y/z of the view ray through uv (0, 0), then their change to uv (1, 1); rays of an orthographic camera
// have equal slopes.
std::array<double, 4> frustumOf(const Matrix& viewToClip);
} // namespace sample
