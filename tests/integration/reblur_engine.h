// REBLUR_DIFFUSE_SPECULAR on a device over a wall that faces the camera.
#pragma once
#include "gpu_fixture.h"

namespace test
{
inline constexpr uint16_t kWidth = 50;
inline constexpr uint16_t kHeight = 34;
inline constexpr nrd::Identifier kReblur = 1;

// The images of REBLUR_DIFFUSE_SPECULAR with a wall that faces the camera, evenly lit.
struct ReblurImages
{
    explicit ReblurImages(Gpu& gpu)
    {
        add(gpu, nrd::ResourceType::IN_MV, rhi::Format::RGBA16_SFLOAT);
        add(gpu, nrd::ResourceType::IN_NORMAL_ROUGHNESS, rhi::Format::A2B10G10R10_UNORM_PACK32);
        add(gpu, nrd::ResourceType::IN_VIEWZ, rhi::Format::R32_SFLOAT);
        add(gpu, nrd::ResourceType::IN_DIFF_RADIANCE_HITDIST, rhi::Format::RGBA32_SFLOAT);
        add(gpu, nrd::ResourceType::IN_SPEC_RADIANCE_HITDIST, rhi::Format::RGBA32_SFLOAT);
        add(gpu, nrd::ResourceType::OUT_DIFF_RADIANCE_HITDIST, rhi::Format::RGBA32_SFLOAT);
        add(gpu, nrd::ResourceType::OUT_SPEC_RADIANCE_HITDIST, rhi::Format::RGBA32_SFLOAT);
    }

    void upload(rhi::CommandBuffer& commands)
    {
        constexpr size_t kPixels = size_t(kWidth) * kHeight;
        const std::vector<uint64_t> motion(kPixels, 0);
        const std::vector<uint32_t> guide(kPixels, 512u | 512u << 10 | 256u << 20); // normal -z, roughness 0.5
        const std::vector<float> viewZ(kPixels, 5.0f);
        std::vector<float> radiance(kPixels * 4, 0.0f); // Y, Co, Cg, normalised hit distance
        for (size_t i = 0; i < kPixels; i++) radiance[i * 4] = radiance[i * 4 + 3] = 0.5f;
        const void* const bytes[] = {motion.data(), guide.data(), viewZ.data(), radiance.data(), radiance.data()};
        for (size_t i = 0; i < std::size(bytes); i++) images[i].upload(commands, bytes[i]);
    }

    void denoise(nrd::NrdIntegration& integration, rhi::CommandBuffer& commands,
                 const nrd::DenoiseOptions& options = {}, nrd::Identifier identifier = kReblur)
    {
        nrd::NrdUserPool pool;
        for (size_t i = 0; i < images.size(); i++) pool[slots[i]] = images[i].entry;
        require(integration.Denoise(rhi::vulkanCommandBuffer(commands), &identifier, 1, pool, options), integration);
        for (size_t i = 0; i < images.size(); i++) images[i].entry.state = pool[slots[i]].state;
    }

    std::vector<nrd::ResourceType> slots;
    std::deque<EngineImage> images;

private:
    void add(Gpu& gpu, nrd::ResourceType slot, rhi::Format format)
    {
        slots.push_back(slot);
        images.emplace_back(gpu, format, kWidth, kHeight);
    }
};

struct ReblurEngine
{
    explicit ReblurEngine(nrd::LayoutPolicy policy = nrd::LayoutPolicy::OPTIMAL, bool isSync2 = true,
                          bool isValidated = true)
        : gpu(isValidated)
    {
        desc.native = gpu.native();
        desc.native.isSynchronization2Enabled &= isSync2;
        desc.layoutPolicy = policy;
        desc.resourceWidth = kWidth;
        desc.resourceHeight = kHeight;
        desc.framesInFlight = 2;
        nrd::InstanceCreationDesc instanceDesc;
        instanceDesc.denoisers = &denoiser;
        instanceDesc.denoisersNum = 1;
        require(integration.Create(desc, instanceDesc), integration);
    }
    ~ReblurEngine() { frames.wait(); }

    rhi::CommandBuffer& beginFrame()
    {
        rhi::CommandBuffer& commands = frames.begin();
        require(integration.NewFrame(), integration);
        require(integration.SetCommonSettings(stillCamera(kWidth, kHeight, frameIndex++)), integration);
        return commands;
    }

    Gpu gpu;
    FrameRing frames{gpu, 2};
    ReblurImages images{gpu};
    nrd::DenoiserDesc denoiser = {kReblur, nrd::Denoiser::REBLUR_DIFFUSE_SPECULAR};
    nrd::IntegrationCreationDesc desc;
    nrd::NrdIntegration integration;
    uint32_t frameIndex = 0;
};
} // namespace test
