#include "frame_state.h"
#include <algorithm>
#include <iterator>

namespace nrd
{
namespace
{
constexpr double kRadiusLines = 1440.0; // height at which blur radii are given

shared::mat4 toShared(const Double4x4& matrix)
{
    shared::mat4 result;
    for (size_t i = 0; i < 16; i++) result.columns[i] = static_cast<float>(matrix.m[i]);
    return result;
}

shared::vec4 toShared(const Double3& v, double w)
{
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), static_cast<float>(w)};
}

shared::vec4 toShared(const double (&v)[4]) { return toShared({v[0], v[1], v[2]}, v[3]); }

// The visible half space says which way z goes. A perspective projection has w = +-z; an orthographic one maps a
// range of z to [0; 1], reversed or not, and the middle of that range lies in front of the camera.
double findViewZSign(const Double4x4& viewToClip, bool isOrthographic)
{
    if (!isOrthographic) return viewToClip.at(3, 2) > 0.0 ? 1.0 : -1.0;
    const double scale = viewToClip.at(2, 2);
    const double middle = (0.5 * viewToClip.at(3, 3) - viewToClip.at(2, 3)) / scale;
    return scale != 0.0 && middle < 0.0 ? -1.0 : 1.0;
}

// One camera of a frame: world to left-handed view without translation, and where it stands.
struct Camera
{
    Projection projection;
    Double4x4 rotation;
    Double3 position;
};

Camera makeCamera(const float (&viewToClip)[16], const float (&worldToView)[16])
{
    Camera camera;
    camera.projection = makeProjection(viewToClip);
    camera.rotation = toDouble(worldToView);
    const Double3 translation = camera.rotation.translation();
    camera.position = -rotate(transposedRotation(camera.rotation), translation);
    camera.rotation.setTranslation({});
    for (size_t column = 0; column < 3; column++) camera.rotation.at(2, column) *= camera.projection.viewZSign;
    return camera;
}

Double3 findCameraDelta(const CommonSettings& common, const Camera& current, const Camera& previous)
{
    if (!common.isCameraDeltaAvailable) return previous.position - current.position;
    return {common.cameraDelta[0], common.cameraDelta[1], common.cameraDelta[2]};
}

// What is left of an absolute position once single precision must do: its place in a cube of whole units.
Double3 wrapped(const Double3& position)
{
    constexpr double kPeriod = 1024.0;
    const auto wrap = [](double x) { return x - kPeriod * std::floor(x / kPeriod); };
    return {wrap(position.x), wrap(position.y), wrap(position.z)};
}

// Motion on screen is a difference of what IN_VIEWZ stores; the shaders know its absolute value in units, and look at
// the sign of each texel.
shared::vec4 makeMotionVectorScale(const CommonSettings& common)
{
    const float(&scale)[3] = common.motionVectorScale;
    if (!common.isMotionVectorInWorldSpace) return {scale[0], scale[1], scale[2] * common.viewZScale, 0.0f};
    // The default 0 would silently drop the third axis of a world-space vector.
    return {scale[0], scale[1], scale[2] != 0.0f ? scale[2] : scale[0], 1.0f};
}
} // namespace

Projection makeProjection(const float (&viewToClip)[16])
{
    Projection result;
    Double4x4& m = result.viewToClip;
    m = toDouble(viewToClip);
    result.isOrthographic = m.at(3, 2) == 0.0;
    result.viewZSign = findViewZSign(m, result.isOrthographic);
    for (size_t row = 0; row < 4; row++) m.at(row, 2) *= result.viewZSign;

    // ndc * w = scale * x + shift * (z or 1), so the slope at ndc is (ndc * w - shift) / scale.
    const double w = result.isOrthographic ? m.at(3, 3) : m.at(3, 2);
    const size_t column = result.isOrthographic ? 3 : 2;
    const double left = (-w - m.at(0, column)) / m.at(0, 0), right = (w - m.at(0, column)) / m.at(0, 0);
    const double top = (w - m.at(1, column)) / m.at(1, 1), bottom = (-w - m.at(1, column)) / m.at(1, 1);
    const double frustum[4] = {left, top, right - left, bottom - top};
    std::copy(std::begin(frustum), std::end(frustum), result.frustum);
    result.yScale = m.at(1, 1) / w;
    return result;
}

FrameState makeFrameState(const CommonSettings& common, float frameRateScale)
{
    const Camera current = makeCamera(common.viewToClipMatrix, common.worldToViewMatrix);
    const Camera previous = makeCamera(common.viewToClipMatrixPrev, common.worldToViewMatrixPrev);
    const Double3 delta = findCameraDelta(common, current, previous);

    Double4x4 worldToViewPrev = previous.rotation;
    worldToViewPrev.setTranslation(-rotate(previous.rotation, delta));
    Double4x4 viewToWorldPrev = transposedRotation(previous.rotation);
    viewToWorldPrev.setTranslation(delta);

    FrameState state;
    state.worldToClipAbsolute = toDouble(common.viewToClipMatrix) * toDouble(common.worldToViewMatrix);
    state.worldToClip = toShared(current.projection.viewToClip * current.rotation);
    state.worldToClipPrev = toShared(previous.projection.viewToClip * worldToViewPrev);
    state.worldToViewPrev = toShared(worldToViewPrev);
    state.viewToWorld = toShared(transposedRotation(current.rotation));
    state.viewToWorldPrev = toShared(viewToWorldPrev);
    state.frustum = toShared(current.projection.frustum);
    state.frustumPrev = toShared(previous.projection.frustum);
    state.cameraDelta = toShared(delta, current.projection.isOrthographic ? 1.0 : 0.0);
    state.viewDirection = toShared(-current.rotation.row(2), 0.0);
    state.cameraPosition = toShared(wrapped(current.position), 0.0);
    state.motionVectorScale = makeMotionVectorScale(common);

    state.unproject = static_cast<float>(2.0 / (common.rectSize[1] * current.projection.yScale));
    state.minRectDim = std::min(common.rectSize[0], common.rectSize[1]);
    state.jitterDelta = std::max(std::abs(common.cameraJitter[0] - common.cameraJitterPrev[0]),
                                 std::abs(common.cameraJitter[1] - common.cameraJitterPrev[1]));
    state.radiusScale = static_cast<float>(std::sqrt(common.rectSize[1] / kRadiusLines));
    state.frameRateScale = frameRateScale;
    return state;
}

Double3 toViewSpace(const CommonSettings& common, const Double3& v, bool isPoint)
{
    const Camera camera = makeCamera(common.viewToClipMatrix, common.worldToViewMatrix);
    return rotate(camera.rotation, isPoint ? v - camera.position : v);
}

CommonSettings withoutPreviousFrame(const CommonSettings& common)
{
    CommonSettings result = common;
    std::copy(std::begin(common.rectSize), std::end(common.rectSize), result.rectSizePrev);
    std::copy(std::begin(common.resourceSize), std::end(common.resourceSize), result.resourceSizePrev);
    std::copy(std::begin(common.cameraJitter), std::end(common.cameraJitter), result.cameraJitterPrev);
    return result;
}

CommonSettings atResolution(const CommonSettings& common, uint32_t divisor)
{
    CommonSettings result = common;
    for (size_t axis = 0; axis < 2; axis++)
    {
        for (auto size : {&CommonSettings::resourceSize, &CommonSettings::resourceSizePrev, &CommonSettings::rectSize,
                          &CommonSettings::rectSizePrev})
        {
            (result.*size)[axis] = static_cast<uint16_t>(((common.*size)[axis] + divisor - 1) / divisor);
        }
        result.rectOrigin[axis] = static_cast<uint16_t>(common.rectOrigin[axis] / divisor);
        result.cameraJitter[axis] = common.cameraJitter[axis] / static_cast<float>(divisor);
        result.cameraJitterPrev[axis] = common.cameraJitterPrev[axis] / static_cast<float>(divisor);
    }
    return result;
}

namespace
{
// uv of the full screen = uv of the picked pixels' screen * scale + offset
struct ScreenMap
{
    double scale[2], offset[2];
};

ScreenMap mapPickedPixels(const uint16_t (&rectSize)[2], uint32_t divisor)
{
    ScreenMap map;
    for (size_t axis = 0; axis < 2; axis++)
    {
        const uint32_t picked = (rectSize[axis] + divisor - 1) / divisor;
        map.scale[axis] = static_cast<double>(picked * divisor) / rectSize[axis];
        map.offset[axis] = 0.5 * (1.0 - divisor) / rectSize[axis];
    }
    return map;
}

// Clip space of a screen that is a piece of the given one, or reaches beyond it. Down the screen, y of clip space
// falls.
void crop(float (&viewToClip)[16], const ScreenMap& map)
{
    for (size_t axis = 0; axis < 2; axis++)
    {
        const double shift = (1.0 - 2.0 * map.offset[axis]) / map.scale[axis] - 1.0;
        for (size_t column = 0; column < 4; column++)
        {
            float& element = viewToClip[4 * column + axis];
            const double w = viewToClip[4 * column + 3];
            element = static_cast<float>(element / map.scale[axis] + (axis == 0 ? shift : -shift) * w);
        }
    }
}
} // namespace

CommonSettings atPickedPixels(const CommonSettings& common, uint32_t divisor)
{
    CommonSettings result = atResolution(common, divisor);
    std::copy(std::begin(common.rectOrigin), std::end(common.rectOrigin), result.rectOrigin);
    const ScreenMap map = mapPickedPixels(common.rectSize, divisor);
    crop(result.viewToClipMatrix, map);
    crop(result.viewToClipMatrixPrev, mapPickedPixels(common.rectSizePrev, divisor));
    if (common.isMotionVectorInWorldSpace) return result;
    for (size_t axis = 0; axis < 2; axis++)
        result.motionVectorScale[axis] = static_cast<float>(common.motionVectorScale[axis] / map.scale[axis]);
    return result;
}

double angleBetween(const float (&a)[16], const float (&b)[16])
{
    double trace = 0.0;
    for (size_t column = 0; column < 3; column++)
    {
        for (size_t row = 0; row < 3; row++)
            trace += static_cast<double>(a[column * 4 + row]) * static_cast<double>(b[column * 4 + row]);
    }
    constexpr double kDegrees = 57.295779513082320877;
    return std::acos(std::clamp(0.5 * (trace - 1.0), -1.0, 1.0)) * kDegrees;
}

double findViewOverlap(const CommonSettings& common)
{
    constexpr int kGrid = 5;
    const Camera current = makeCamera(common.viewToClipMatrix, common.worldToViewMatrix);
    const Camera previous = makeCamera(common.viewToClipMatrixPrev, common.worldToViewMatrixPrev);
    const Double4x4 viewToWorld = transposedRotation(current.rotation);
    if (current.projection.isOrthographic || previous.projection.isOrthographic)
    {
        constexpr double kSameSide = 60.0; // degrees
        return angleBetween(common.worldToViewMatrix, common.worldToViewMatrixPrev) < kSameSide ? 1.0 : 0.0;
    }
    const double(&now)[4] = current.projection.frustum;
    const double(&then)[4] = previous.projection.frustum;
    int found = 0;
    for (int i = 0; i < kGrid * kGrid; i++)
    {
        const double u = (i % kGrid + 0.5) / kGrid, v = (i / kGrid + 0.5) / kGrid;
        const Double3 ray = {now[0] + u * now[2], now[1] + v * now[3], 1.0};
        const Double3 seen = rotate(previous.rotation, rotate(viewToWorld, ray));
        const double uThen = (seen.x / seen.z - then[0]) / then[2], vThen = (seen.y / seen.z - then[1]) / then[3];
        found += seen.z > 0.0 && uThen >= 0.0 && uThen <= 1.0 && vThen >= 0.0 && vThen <= 1.0 ? 1 : 0;
    }
    return found / static_cast<double>(kGrid * kGrid);
}

FrameClock tick(const FrameClock& clock, uint32_t frameIndex, double time)
{
    if (!clock.isRunning) return {time, 0.0, frameIndex, true};
    if (clock.frameIndex == frameIndex) return clock; // another view of the same frame
    return {time, smoothFrameTime(clock.smoothed, time - clock.lastTime), frameIndex, true};
}

double smoothFrameTime(double smoothed, double measured)
{
    if (!(measured > 0.0)) return smoothed;
    if (!(smoothed > 0.0)) return measured;
    const double jump = std::abs(measured - smoothed) / std::min(measured, smoothed);
    return smoothed + (measured - smoothed) * std::max(jump / (1.0 + jump), 1.0 / 32.0);
}

float frameRateScale(double frameTime)
{
    constexpr double kReferenceFrameTime = 1000.0 / 30.0; // ms
    return frameTime > 0.0 ? static_cast<float>(std::max(kReferenceFrameTime / frameTime, 1.0)) : 1.0f;
}
} // namespace nrd
