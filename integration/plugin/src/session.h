// One initialised denoiser and its history: what an event executes, on the images that were its own when the frame was
// set. Outlives its release until no frame that was set before can need it.
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
    Session(const Device& device, Denoiser denoiser, const SlottedImages& images);

    /// Whether it can go on with other images, of another size too: the encoding of normals is fixed.
    bool suits(const SlottedImages& images) const { return images.normalEncoding == m_normalEncoding; }
    /// Once per frame; one thread at a time comes in. Images of another size than last time's take the history along.
    void execute(VkCommandBuffer commandBuffer, const SlottedImages& images, const NrdPluginFrame& frame,
                 const DenoiserSettings& settings);

private:
    void create(const Device& device, const SlottedImages& images);
    void check(Result result) const;
    CommonSettings settingsFor(const SlottedImages& images, const NrdPluginFrame& frame) const;

    std::mutex m_mutex;
    Denoiser m_denoiser;
    NormalEncoding m_normalEncoding;
    NrdIntegration m_integration;
    bool m_isFrameOpen = false;           // NewFrame() was called, but nothing recorded since
    std::optional<CommonSettings> m_last; // of the last frame that was recorded
};
} // namespace nrd::plugin
