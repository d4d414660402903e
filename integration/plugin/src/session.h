// One initialised denoiser with the engine's images: what an event executes. Outlives its release until no frame that
// was set before can need it.
#pragma once
#include "image_slots.h"
#include "settings.h"
#include <functional>
#include <mutex>
#include <optional>

namespace nrd::plugin
{
/// As NrdIntegration::Create(); over another device in tests.
using Creator = std::function<Result(NrdIntegration&, const IntegrationCreationDesc&, const InstanceCreationDesc&)>;

struct Device
{
    NativeDevice native;
    uint32_t framesInFlight = 0;
    NrdPluginCommandBufferProvider getCommandBuffer = nullptr;
    void* userArg = nullptr;
    Creator create;
};

class Session
{
public:
    Session(const Device& device, Denoiser denoiser, Images images);

    /// Once per frame; one thread at a time comes in.
    void execute(VkCommandBuffer commandBuffer, const NrdPluginFrame& frame, const DenoiserSettings& settings);

private:
    void create(const Device& device);
    void check(Result result) const;
    CommonSettings settingsFor(const NrdPluginFrame& frame) const;

    std::mutex m_mutex;
    Denoiser m_denoiser;
    SlottedImages m_images;
    NrdIntegration m_integration;
    bool m_isFrameOpen = false;           // NewFrame() was called, but nothing recorded since
    std::optional<CommonSettings> m_last; // of the last frame that was recorded
};
} // namespace nrd::plugin
