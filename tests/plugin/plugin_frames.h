// The frames that the tests play: as an engine tells them to the plug-in, and what that has to mean to NrdIntegration.
#pragma once
#include <nrd/integration.h>
#include <nrd/plugin.h>
#include <vector>

namespace test
{
constexpr uint16_t kWidth = 40; // pixels
constexpr uint16_t kHeight = 24;
constexpr float kDepth = 5.0f;      // of the wall in front of the camera
constexpr float kStep = 0.05f;      // units the camera moves to the right with each frame
constexpr uint32_t kFirstFrame = 7; // frame indices of an engine that runs already

struct Size // pixels
{
    uint16_t width = kWidth;
    uint16_t height = kHeight;
};

NrdPluginFrame pluginFrame(uint32_t frame);

struct DirectFrame
{
    nrd::CommonSettings common;
    nrd::SigmaSettings sigma;
};
/// Written out, previous frame included; images had the size `before` in that one.
DirectFrame directFrame(uint32_t frame, Size size = {}, Size before = {});

nrd::InstanceCreationDesc instanceDesc(const nrd::DenoiserDesc& denoiser);
nrd::IntegrationCreationDesc integrationDesc(nrd::Denoiser denoiser);

/// The array of NrdPluginInitialize() as NrdIntegration takes it.
nrd::NrdUserPool userPool(nrd::Denoiser denoiser, const std::vector<NrdPluginImage>& images);

/// NewFrame() to Denoise(), with a Resize() to the size that the frame has.
nrd::Result denoise(nrd::NrdIntegration& integration, nrd::Denoiser denoiser, const DirectFrame& frame,
                    VkCommandBuffer commandBuffer, nrd::NrdUserPool& pool);
} // namespace test
