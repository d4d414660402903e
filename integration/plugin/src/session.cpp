#include "session.h"
#include "frame.h"
#include "refusal.h"

namespace nrd::plugin
{
Session::Session(const Device& device, Denoiser denoiser, const SlottedImages& images)
    : m_denoiser(denoiser), m_normalEncoding(images.normalEncoding)
{
    create(device, images);
}

void Session::create(const Device& device, const SlottedImages& images)
{
    IntegrationCreationDesc desc;
    desc.name = toString(m_denoiser);
    desc.native = device.native;
    desc.resourceWidth = images.common.resourceSize[0];
    desc.resourceHeight = images.common.resourceSize[1];
    desc.framesInFlight = device.framesInFlight;
    desc.maxDenoiseCallsPerFrame = 1;
    desc.createDefaultPipelines = true; // here, not on the render thread
    const DenoiserDesc denoiser = {kIdentifier, m_denoiser};
    InstanceCreationDesc instance;
    instance.denoisers = &denoiser;
    instance.denoisersNum = 1;
    instance.normalEncoding = m_normalEncoding;
    check(device.create(m_integration, desc, instance));
}

void Session::check(Result result) const
{
    if (result != Result::SUCCESS) throw Refusal(result, m_integration.GetLastMessage());
}

CommonSettings Session::settingsFor(const SlottedImages& images, const NrdPluginFrame& frame) const
{
    CommonSettings result = toCommonSettings(frame, images.common.resourceSize);
    result.isHistoryConfidenceAvailable = images.common.isHistoryConfidenceAvailable;
    result.isDisocclusionThresholdMixAvailable = images.common.isDisocclusionThresholdMixAvailable;
    result.isSpecularMotionAvailable = images.common.isSpecularMotionAvailable;
    result.enableValidation = images.common.enableValidation;
    if (m_last && m_last->frameIndex + 1 == frame.frameIndex)
        continueFrom(*m_last, result);
    else if (result.accumulationMode == AccumulationMode::CONTINUE)
        result.accumulationMode = AccumulationMode::RESTART; // motion vectors lead to a frame the history is not of
    return result;
}

void Session::execute(VkCommandBuffer commandBuffer, const SlottedImages& images, const NrdPluginFrame& frame,
                      const DenoiserSettings& settings)
{
    const std::lock_guard lock(m_mutex);
    if (m_last && m_last->frameIndex == frame.frameIndex)
        throw Refusal(Result::INVALID_ARGUMENT,
                      sentence("%s is executed twice in frame %u", toString(m_denoiser), frame.frameIndex));
    // Opened once for each frame that is recorded, whatever was refused: its ring must not run ahead of the GPU.
    if (!m_isFrameOpen) check(m_integration.NewFrame());
    m_isFrameOpen = true;
    const uint16_t(&size)[2] = images.common.resourceSize;
    check(m_integration.Resize(size[0], size[1])); // nothing if it is as it was
    const CommonSettings common = settingsFor(images, frame);
    check(m_integration.SetCommonSettings(common));
    const auto set = [this](const auto& s) { check(m_integration.SetDenoiserSettings(kIdentifier, s)); };
    std::visit(set, withLight(settings, frame));
    DenoiseOptions options;
    options.restoreInitialStates = true;
    NrdUserPool pool = images.pool;
    check(m_integration.Denoise(commandBuffer, &kIdentifier, 1, pool, options));
    m_isFrameOpen = false;
    m_last = common;
}
} // namespace nrd::plugin
