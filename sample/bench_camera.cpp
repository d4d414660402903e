#include "bench_camera.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace sample::bench
{
namespace
{
constexpr float kTanHalfHeight = 0.577f; // 60 degrees from top to bottom
constexpr float kHeight = 1.6f;          // metres, as the scene has it
constexpr float kTravel = 0.3f;          // metres from first to last input frame
constexpr float kTurn = 0.026f;          // radians from first to last input frame
constexpr float kNear = 0.05f;
constexpr float kFar = 1000.0f;
constexpr float kDenoisingRange = 1000.0f;

struct Pose
{
    float x;   // of the camera, metres
    float yaw; // radians
};

Pose poseOf(const Workload& workload, uint32_t inputFrame)
{
    const float along = workload.isStatic ? 0.0f : static_cast<float>(inputFrame) / (kInputFrameCount - 1) - 0.5f;
    return {kTravel * along, -kTurn * along};
}

float radicalInverse(uint32_t index, uint32_t base)
{
    float value = 0.0f, digit = 1.0f / static_cast<float>(base);
    for (; index > 0; index /= base, digit /= static_cast<float>(base))
        value += static_cast<float>(index % base) * digit;
    return value;
}

// Halton's sequence: pixels in [-0.5; 0.5).
std::array<float, 2> jitterOf(uint32_t inputFrame)
{
    return {radicalInverse(inputFrame + 1, 2) - 0.5f, radicalInverse(inputFrame + 1, 3) - 0.5f};
}

float aspectOf(Extent size) { return static_cast<float>(size.width) / static_cast<float>(size.height); }

void setProjection(float (&m)[16], Extent size)
{
    m[0] = 1.0f / (kTanHalfHeight * aspectOf(size));
    m[5] = 1.0f / kTanHalfHeight;
    m[10] = kFar / (kFar - kNear);
    m[11] = 1.0f;
    m[14] = -kNear * kFar / (kFar - kNear);
}

// Rows: right, up, forward.
void setView(float (&m)[16], const Pose& pose)
{
    const float c = std::cos(pose.yaw), s = std::sin(pose.yaw);
    m[0] = c, m[8] = -s, m[5] = 1.0f, m[2] = s, m[10] = c, m[15] = 1.0f;
    m[12] = -c * pose.x, m[13] = -kHeight, m[14] = -s * pose.x;
}
} // namespace

BenchConstants traceConstants(const Workload& workload, Extent size, uint32_t inputFrame)
{
    const Pose pose = poseOf(workload, inputFrame);
    const std::array<float, 2> jitter = jitterOf(inputFrame);
    const nrd::HitDistanceParameters hitDistance;
    BenchConstants constants = {};
    constants.camera = {pose.x, kHeight, 0.0f, pose.yaw};
    constants.view = {kTanHalfHeight * aspectOf(size), kTanHalfHeight, jitter[0], jitter[1]};
    constants.sky = {workload.skyShare, kSkyViewZ, 0.0f, 0.0f};
    constants.hitDistanceParameters = {hitDistance.A, hitDistance.B, hitDistance.C, 0.0f};
    constants.frame = {size.width, size.height, inputFrame, 0};
    return constants;
}

nrd::CommonSettings commonSettingsOf(const Workload& workload, Extent size, uint32_t index)
{
    const uint32_t now = inputFrameOf(index), before = inputFrameOf(index == 0 ? 0 : index - 1);
    nrd::CommonSettings settings;
    setProjection(settings.viewToClipMatrix, size);
    setProjection(settings.viewToClipMatrixPrev, size);
    setView(settings.worldToViewMatrix, poseOf(workload, now));
    setView(settings.worldToViewMatrixPrev, poseOf(workload, before));
    const std::array<float, 2> jitter = jitterOf(now), jitterPrev = jitterOf(before);
    for (size_t i = 0; i < 2; i++)
    {
        settings.cameraJitter[i] = jitter[i];
        settings.cameraJitterPrev[i] = jitterPrev[i];
        const uint16_t side = static_cast<uint16_t>(i == 0 ? size.width : size.height);
        settings.resourceSize[i] = settings.resourceSizePrev[i] = side;
        settings.rectSize[i] = settings.rectSizePrev[i] = side;
    }
    settings.motionVectorScale[2] = 1.0f;
    settings.isMotionVectorInWorldSpace = true;
    settings.timeDeltaBetweenFrames = 1000.0f / 60.0f;
    settings.denoisingRange = kDenoisingRange;
    settings.frameIndex = index;
    return settings;
}

ReplaySettings settingsOf(const Workload& workload, const ReplayDenoiser& denoiser, Extent size, uint32_t index)
{
    ReplaySettings settings = presetSettings(workload.preset);
    settings.common = commonSettingsOf(workload, size, index);
    constexpr float kSun[3] = {BENCH_SUN_X, BENCH_SUN_Y, BENCH_SUN_Z};
    std::copy(std::begin(kSun), std::end(kSun), settings.sigma.lightDirection);
    applySettings(settings, denoiser.family, workload.settings);
    return settings;
}
} // namespace sample::bench
