// An integration over a device that records every call: no GPU, and any number serves as a native handle.
#pragma once
#include "common.h"
#include "integration_access.h"
#include "spy_device.h"
#include <rhi/recording.h>
#include <vector>

namespace test
{
class RecordingFixture
{
public:
    static constexpr uint16_t kWidth = 64;
    static constexpr uint16_t kHeight = 48;

    explicit RecordingFixture(std::vector<nrd::DenoiserDesc> denoisers = {{7, nrd::Denoiser::REFERENCE}});

    nrd::Result create();
    void requireCreated() { require(create(), integration); }
    /// NewFrame() and SetCommonSettings() with the next frame index.
    void beginFrame();
    nrd::Result denoise(std::vector<nrd::Identifier> identifiers = {7}, const nrd::DenoiseOptions& options = {});
    /// A full-size RGBA16_SFLOAT image with a fake handle, in the state of a new one.
    nrd::NrdUserImage image(uintptr_t handle, VkFormat format = VK_FORMAT_R16G16B16A16_SFLOAT) const;
    void fillReblurSlots(); // every slot that REBLUR_DIFFUSE_SPECULAR needs

    std::vector<rhi::RecordedCall> calls(rhi::CallType type) const; // since the last clearCalls()
    std::vector<rhi::RecordedBarrier> barriersOf(const std::string& texture) const;
    uint32_t count(rhi::CallType type) const { return static_cast<uint32_t>(calls(type).size()); }

    std::unique_ptr<rhi::RecordingDevice> device = rhi::makeRecordingDevice();
    SpyDevice spy{*device};
    nrd::IntegrationCreationDesc desc;
    nrd::InstanceCreationDesc instanceDesc;
    std::vector<nrd::DenoiserDesc> denoisers;
    nrd::NrdUserPool pool;
    nrd::CommonSettings settings; // of the last beginFrame()
    uint32_t frameIndex = 0;      // of the next one
    uint16_t width = kWidth;      // of the resource and of image()
    uint16_t height = kHeight;
    uint16_t lastWidth = 0; // of the last beginFrame(), 0: as now
    uint16_t lastHeight = 0;
    nrd::NrdIntegration integration; // goes before the device
};

VkCommandBuffer fakeCommandBuffer();
VkImage fakeImage(uintptr_t number);
} // namespace test
