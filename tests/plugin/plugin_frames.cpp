#include "plugin_frames.h"
#include <string>

namespace test
{
namespace
{
void setView(float (&matrix)[16], uint32_t frame)
{
    for (int i = 0; i < 4; i++) matrix[i * 5] = 1.0f;
    matrix[12] = -kStep * static_cast<float>(frame);
}

void setProjection(float (&matrix)[16])
{
    matrix[0] = matrix[5] = matrix[11] = 1.0f;
    matrix[14] = 0.1f;
}

void setJitter(float (&jitter)[2], uint32_t frame)
{
    jitter[0] = frame % 2 == 0 ? 0.25f : -0.25f;
    jitter[1] = frame % 3 == 0 ? 0.125f : -0.125f;
}

void setLight(float (&direction)[3], uint32_t frame)
{
    direction[0] = frame % 2 == 0 ? 0.6f : -0.6f;
    direction[1] = 0.8f;
}
} // namespace

NrdPluginFrame pluginFrame(uint32_t frame)
{
    NrdPluginFrame result = {};
    result.structSize = sizeof(result);
    result.frameIndex = kFirstFrame + frame;
    setProjection(result.viewToClipMatrix);
    setView(result.worldToViewMatrix, frame);
    setJitter(result.cameraJitter, frame);
    setLight(result.lightDirection, frame);
    result.deltaTime = 0.016f + 0.001f * static_cast<float>(frame);
    return result;
}

DirectFrame directFrame(uint32_t frame, Size size, Size before)
{
    const uint32_t previous = frame == 0 ? 0 : frame - 1;
    DirectFrame result;
    nrd::CommonSettings& common = result.common;
    setProjection(common.viewToClipMatrix);
    setProjection(common.viewToClipMatrixPrev);
    setView(common.worldToViewMatrix, frame);
    setView(common.worldToViewMatrixPrev, previous);
    setJitter(common.cameraJitter, frame);
    setJitter(common.cameraJitterPrev, previous);
    for (uint16_t* now : {common.resourceSize, common.rectSize}) now[0] = size.width, now[1] = size.height;
    for (uint16_t* prev : {common.resourceSizePrev, common.rectSizePrev})
        prev[0] = before.width, prev[1] = before.height;
    common.timeDeltaBetweenFrames = (0.016f + 0.001f * static_cast<float>(frame)) * 1000.0f;
    common.frameIndex = kFirstFrame + frame;
    if (frame == 0) common.accumulationMode = nrd::AccumulationMode::RESTART;
    setLight(result.sigma.lightDirection, frame);
    return result;
}

nrd::InstanceCreationDesc instanceDesc(const nrd::DenoiserDesc& denoiser)
{
    nrd::InstanceCreationDesc result;
    result.denoisers = &denoiser;
    result.denoisersNum = 1;
    if (denoiser.denoiser != nrd::Denoiser::REFERENCE)             // which knows no normals
        result.normalEncoding = nrd::NormalEncoding::RGBA16_SNORM; // of float images
    return result;
}

nrd::IntegrationCreationDesc integrationDesc(nrd::Denoiser denoiser)
{
    nrd::IntegrationCreationDesc result;
    result.name = toString(denoiser);
    result.resourceWidth = kWidth;
    result.resourceHeight = kHeight;
    result.maxDenoiseCallsPerFrame = 1;
    result.createDefaultPipelines = true;
    return result;
}

nrd::NrdUserPool userPool(nrd::Denoiser denoiser, const std::vector<NrdPluginImage>& images)
{
    nrd::NrdUserPool result;
    for (uint32_t i = 0; i < images.size(); i++)
    {
        NrdPluginImageInfo info = {};
        info.structSize = sizeof(info);
        if (NrdPluginGetImageInfo(static_cast<uint32_t>(denoiser), i, &info) != NRD_PLUGIN_SUCCESS) continue;
        for (uint32_t slot = 0; slot < nrd::NrdUserPool::kSlotsNum; slot++)
        {
            const auto type = static_cast<nrd::ResourceType>(slot);
            if (std::string(toString(type)) != info.name || images[i].image == VK_NULL_HANDLE) continue;
            nrd::NrdUserImage& image = result[type];
            image.image = images[i].image;
            image.format = images[i].format;
            image.width = images[i].width;
            image.height = images[i].height;
            image.state = {images[i].layout, VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT,
                           VK_PIPELINE_STAGE_ALL_COMMANDS_BIT};
        }
    }
    return result;
}

nrd::Result denoise(nrd::NrdIntegration& integration, nrd::Denoiser denoiser, const DirectFrame& frame,
                    VkCommandBuffer commandBuffer, nrd::NrdUserPool& pool)
{
    const bool isSigma =
        denoiser == nrd::Denoiser::SIGMA_SHADOW || denoiser == nrd::Denoiser::SIGMA_SHADOW_TRANSLUCENCY;
    const nrd::Identifier identifier = 0;
    nrd::DenoiseOptions options;
    options.restoreInitialStates = true;
    const uint16_t(&size)[2] = frame.common.resourceSize;
    nrd::Result result = integration.NewFrame();
    if (result == nrd::Result::SUCCESS) result = integration.Resize(size[0], size[1]);
    if (result == nrd::Result::SUCCESS) result = integration.SetCommonSettings(frame.common);
    if (result == nrd::Result::SUCCESS && isSigma) result = integration.SetDenoiserSettings(identifier, frame.sigma);
    if (result == nrd::Result::SUCCESS) result = integration.Denoise(commandBuffer, &identifier, 1, pool, options);
    return result;
}
} // namespace test
