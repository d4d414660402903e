#include "replay_camera.h"

namespace sample
{
namespace
{
void copyMatrix(const Matrix& source, float (&target)[16])
{
    for (size_t i = 0; i < 16; i++) target[i] = static_cast<float>(source[i]);
}
} // namespace

nrd::SigmaSettings sigmaSettingsOf(const CaptureLight* light, nrd::SigmaSettings settings)
{
    if (!light) return settings;
    settings.isLightLocal = light->isLocal;
    for (size_t i = 0; i < 3; i++)
    {
        settings.lightDirection[i] = static_cast<float>(light->isLocal ? 0.0 : light->direction[i]);
        settings.lightPosition[i] = static_cast<float>(light->position[i]);
    }
    return settings;
}

std::array<double, 3> cameraPositionOf(const Matrix& worldToView)
{
    // Rigid: the inverse of the rotation is its transpose.
    std::array<double, 3> position = {};
    for (size_t i = 0; i < 3; i++)
        for (size_t row = 0; row < 3; row++) position[i] -= worldToView[i * 4 + row] * worldToView[12 + row];
    return position;
}

std::array<double, 4> frustumOf(const Matrix& viewToClip)
{
    // ndc.x = (m0 x + m8 z) / (m11 z), solved for x / z.
    const Matrix& m = viewToClip;
    return {(-m[11] - m[8]) / m[0], (m[11] - m[9]) / m[5], 2.0 * m[11] / m[0], -2.0 * m[11] / m[5]};
}

nrd::CommonSettings commonSettingsOf(const CaptureInfo& info, size_t frameIndex)
{
    const CaptureFrame& now = info.frames.at(frameIndex);
    const CaptureFrame& before = now.isCut || frameIndex == 0 ? now : info.frames[frameIndex - 1];
    nrd::CommonSettings settings;
    copyMatrix(now.viewToClip, settings.viewToClipMatrix);
    copyMatrix(before.viewToClip, settings.viewToClipMatrixPrev);
    copyMatrix(now.worldToView, settings.worldToViewMatrix);
    copyMatrix(before.worldToView, settings.worldToViewMatrixPrev);
    const std::array<double, 3> position = cameraPositionOf(now.worldToView);
    const std::array<double, 3> positionBefore = cameraPositionOf(before.worldToView);
    for (size_t i = 0; i < 3; i++)
    {
        settings.cameraDelta[i] = positionBefore[i] - position[i];
        settings.motionVectorScale[i] = 1.0f;
    }
    settings.isCameraDeltaAvailable = true;
    settings.isMotionVectorInWorldSpace = true;
    for (size_t i = 0; i < 2; i++)
    {
        settings.cameraJitter[i] = static_cast<float>(now.jitter[i]);
        settings.cameraJitterPrev[i] = static_cast<float>(before.jitter[i]);
        const uint16_t size = static_cast<uint16_t>(i == 0 ? info.width : info.height);
        settings.resourceSize[i] = settings.resourceSizePrev[i] = size;
        settings.rectSize[i] = settings.rectSizePrev[i] = size;
    }
    settings.metersToUnits = static_cast<float>(1.0 / info.metersPerUnit);
    settings.timeDeltaBetweenFrames = static_cast<float>(now.deltaTimeMs);
    settings.denoisingRange = static_cast<float>(info.denoisingRange);
    settings.frameIndex = static_cast<uint32_t>(frameIndex);
    settings.accumulationMode = now.isCut ? nrd::AccumulationMode::RESTART : nrd::AccumulationMode::CONTINUE;
    return settings;
}

nrd::HitDistanceParameters hitDistanceParametersOf(const CaptureInfo& info)
{
    nrd::HitDistanceParameters parameters;
    parameters.A = static_cast<float>(info.hitDistanceParameters[0] * info.metersPerUnit);
    parameters.B = static_cast<float>(info.hitDistanceParameters[1]);
    parameters.C = static_cast<float>(info.hitDistanceParameters[2]);
    return parameters;
}
} // namespace sample
