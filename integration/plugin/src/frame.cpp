#include "frame.h"
#include "image_slots.h"
#include "refusal.h"
#include <algorithm>
#include <cfloat>
#include <iterator>

namespace nrd::plugin
{
namespace
{
constexpr uint32_t kMaxSize = 65535; // pixels
constexpr float kMillisecondsPerSecond = 1000.0f;

bool isZero(const float (&vector)[3]) { return vector[0] == 0.0f && vector[1] == 0.0f && vector[2] == 0.0f; }

float valueOr(float value, float otherwise) { return value == 0.0f ? otherwise : value; }
} // namespace

CommonSettings toCommonSettings(const NrdPluginFrame& frame, const uint16_t (&resourceSize)[2])
{
    CommonSettings result;
    std::copy(std::begin(frame.viewToClipMatrix), std::end(frame.viewToClipMatrix), result.viewToClipMatrix);
    std::copy(std::begin(frame.worldToViewMatrix), std::end(frame.worldToViewMatrix), result.worldToViewMatrix);
    std::copy(std::begin(frame.cameraJitter), std::end(frame.cameraJitter), result.cameraJitter);
    result.isMotionVectorInWorldSpace = frame.isMotionVectorInWorldSpace != 0;
    if (result.isMotionVectorInWorldSpace || !isZero(frame.motionVectorScale))
        std::copy(std::begin(frame.motionVectorScale), std::end(frame.motionVectorScale), result.motionVectorScale);
    for (int i = 0; i < 2; i++)
    {
        result.resourceSize[i] = resourceSize[i];
        result.rectSize[i] = frame.rectSize[i] == 0 ? resourceSize[i] : static_cast<uint16_t>(frame.rectSize[i]);
    }
    result.timeDeltaBetweenFrames = frame.deltaTime * kMillisecondsPerSecond;
    result.viewZScale = valueOr(frame.viewZScale, result.viewZScale);
    result.metersToUnits = valueOr(frame.metersToUnits, result.metersToUnits);
    result.denoisingRange = valueOr(frame.denoisingRange, result.denoisingRange);
    result.frameIndex = frame.frameIndex;
    if (frame.isHistoryReset) result.accumulationMode = AccumulationMode::CLEAR_AND_RESTART;
    const CommonSettings self = result;
    continueFrom(self, result);
    return result;
}

DenoiserSettings withLight(const DenoiserSettings& settings, const NrdPluginFrame& frame)
{
    DenoiserSettings result = settings;
    if (SigmaSettings* sigma = std::get_if<SigmaSettings>(&result))
        std::copy(std::begin(frame.lightDirection), std::end(frame.lightDirection), sigma->lightDirection);
    return result;
}

void continueFrom(const CommonSettings& last, CommonSettings& settings)
{
    std::copy(std::begin(last.viewToClipMatrix), std::end(last.viewToClipMatrix), settings.viewToClipMatrixPrev);
    std::copy(std::begin(last.worldToViewMatrix), std::end(last.worldToViewMatrix), settings.worldToViewMatrixPrev);
    std::copy(std::begin(last.cameraJitter), std::end(last.cameraJitter), settings.cameraJitterPrev);
    std::copy(std::begin(last.resourceSize), std::end(last.resourceSize), settings.resourceSizePrev);
    std::copy(std::begin(last.rectSize), std::end(last.rectSize), settings.rectSizePrev);
}

FrameChecker::FrameChecker() : m_instance(makeInstance(Denoiser::SIGMA_SHADOW)) {}

void FrameChecker::require(const NrdPluginFrame& frame)
{
    constexpr float kMaxDeltaTime = FLT_MAX / kMillisecondsPerSecond;
    if (!(frame.deltaTime >= 0.0f && frame.deltaTime <= kMaxDeltaTime)) // NaN fails too
        throw Refusal(Result::INVALID_ARGUMENT,
                      sentence("deltaTime is %g seconds, must be in [0; %g]", frame.deltaTime, kMaxDeltaTime));
    constexpr uint16_t kLargest[2] = {kMaxSize, kMaxSize};
    for (int i = 0; i < 2; i++)
        if (frame.rectSize[i] > kMaxSize)
            throw Refusal(Result::INVALID_ARGUMENT,
                          sentence("rectSize[%d] is %u, must be at most %u", i, frame.rectSize[i], kMaxSize));
    check(*m_instance, SetCommonSettings(*m_instance, toCommonSettings(frame, kLargest)));
    const SigmaSettings sigma = std::get<SigmaSettings>(withLight(SigmaSettings{}, frame));
    check(*m_instance, SetDenoiserSettings(*m_instance, kIdentifier, sigma));
}

void requireValid(Denoiser denoiser, const DenoiserSettings& settings)
{
    const UniqueInstance instance = makeInstance(denoiser);
    const auto set = [&](const auto& s) { check(*instance, SetDenoiserSettings(*instance, kIdentifier, s)); };
    std::visit(set, settings);
}
} // namespace nrd::plugin
