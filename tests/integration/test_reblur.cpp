// REBLUR through the integration: many passes and textures, so many barriers. What it computes is tested elsewhere.
#include "allocations.h"
#include "reblur_engine.h"
#include "recording_fixture.h"
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <rhi/validation.h>

using nrd::Denoiser;
using nrd::ResourceType;
using test::EngineImage;
using test::kHeight;
using test::kReblur;
using test::kWidth;
using test::ReblurEngine;
using test::RecordingFixture;
using test::require;

TEST_CASE("REBLUR runs without a word from validation under both layout policies and both kinds of barriers", "[gpu]")
{
    const auto policy = GENERATE(nrd::LayoutPolicy::OPTIMAL, nrd::LayoutPolicy::GENERAL);
    const bool isSync2 = GENERATE(true, false);
    ReblurEngine engine(policy, isSync2);
    nrd::ReblurSettings settings;
    settings.maxStabilizedFrameNum = GENERATE(0u, 63u);
    require(engine.integration.SetDenoiserSettings(kReblur, settings), engine.integration);
    for (uint32_t frame = 0; frame < 4; frame++)
    {
        rhi::CommandBuffer& commands = engine.beginFrame();
        if (frame == 0) engine.images.upload(commands);
        nrd::DenoiseOptions options;
        options.restoreInitialStates = frame == 2;
        engine.images.denoise(engine.integration, commands, options);
        if (frame == 3)
            for (EngineImage& image : engine.images.images) image.download(commands);
        engine.frames.end();
    }
    engine.frames.wait();
    for (const size_t output : {5u, 6u})
        for (const float value : engine.images.images[output].texels<float>()) REQUIRE(std::isfinite(value));
    engine.gpu.finish();
}

TEST_CASE("the decorator finds no misuse of the RHI in frames, resizes and failures", "[unit]")
{
    std::vector<std::string> sentences;
    RecordingFixture f({{3, Denoiser::REBLUR_DIFFUSE_SPECULAR}, {7, Denoiser::REFERENCE}});
    f.fillReblurSlots();
    f.desc.isGpuTimingEnabled = true;
    f.desc.layoutPolicy = GENERATE(nrd::LayoutPolicy::OPTIMAL, nrd::LayoutPolicy::GENERAL);
    const std::unique_ptr<rhi::Device> validating =
        rhi::makeValidatingDevice(*f.device, [&](const std::string& text) { sentences.push_back(text); });
    nrd::NrdIntegration integration;
    require(nrd::IntegrationAccess::Create(integration, *validating, f.desc, f.instanceDesc), integration);
    const nrd::Identifier identifiers[] = {3, 7};
    for (uint32_t frame = 0; frame < 12; frame++)
    {
        if (frame == 6)
        {
            f.width = f.height = 40;
            require(integration.Resize(f.width, f.height), integration);
            f.fillReblurSlots();
            f.pool[ResourceType::IN_SIGNAL] = f.image(0x100);
            f.pool[ResourceType::OUT_SIGNAL] = f.image(0x200);
        }
        require(integration.NewFrame(), integration);
        require(integration.SetCommonSettings(test::stillCamera(f.width, f.height, frame)), integration);
        if (frame == 7)
        {
            f.pool[ResourceType::OUT_SIGNAL].generation = 9; // wrapped anew, which fails
            f.device->failCreation(1);
            CHECK(integration.Denoise(test::fakeCommandBuffer(), identifiers, 2, f.pool) == nrd::Result::FAILURE);
        }
        nrd::DenoiseOptions options;
        options.restoreInitialStates = frame % 3 == 2;
        require(integration.Denoise(test::fakeCommandBuffer(), identifiers, 2, f.pool, options), integration);
    }
    integration.Destroy();
    for (const std::string& text : sentences) FAIL_CHECK(text);
}

TEST_CASE("a frame takes nothing from the heap once things have settled", "[gpu]")
{
    ReblurEngine engine(nrd::LayoutPolicy::OPTIMAL, true, false); // layers allocate as they like
    for (uint32_t frame = 0; frame < 20; frame++)
    {
        rhi::CommandBuffer& commands = engine.frames.begin();
        const nrd::CommonSettings settings = test::stillCamera(kWidth, kHeight, engine.frameIndex++);
        nrd::NrdUserPool pool;
        for (size_t i = 0; i < engine.images.slots.size(); i++)
            pool[engine.images.slots[i]] = engine.images.images[i].entry;
        bool isGood = true;
        size_t allocationCount = 0;
        {
            const test::AllocationWatch watch;
            isGood &= engine.integration.NewFrame() == nrd::Result::SUCCESS;
            isGood &= engine.integration.SetCommonSettings(settings) == nrd::Result::SUCCESS;
            isGood &= engine.integration.Denoise(rhi::vulkanCommandBuffer(commands), &kReblur, 1, pool) ==
                      nrd::Result::SUCCESS;
            allocationCount = watch.count();
        }
        for (size_t i = 0; i < engine.images.slots.size(); i++)
            engine.images.images[i].entry.state = pool[engine.images.slots[i]].state;
        engine.frames.end();
        CHECK(isGood);
        INFO("frame " << frame);
        if (frame >= 4) CHECK(allocationCount == 0);
    }
}

// Run by name: the time depends on the machine and on what else it does.
TEST_CASE("recording a frame of REBLUR is cheap", "[.cost]")
{
    ReblurEngine engine;
    constexpr int kFrames = 2000;
    std::vector<double> microseconds;
    for (int frame = 0; frame < kFrames; frame++)
    {
        rhi::CommandBuffer& commands = engine.frames.begin();
        const auto start = std::chrono::steady_clock::now();
        require(engine.integration.NewFrame(), engine.integration);
        require(engine.integration.SetCommonSettings(test::stillCamera(kWidth, kHeight, engine.frameIndex++)),
                engine.integration);
        engine.images.denoise(engine.integration, commands);
        const std::chrono::duration<double, std::micro> time = std::chrono::steady_clock::now() - start;
        microseconds.push_back(time.count());
        engine.frames.end();
    }
    std::sort(microseconds.begin(), microseconds.end());
    WARN("median " << microseconds[kFrames / 2] << " us, fastest " << microseconds.front() << " us per frame");
    CHECK(microseconds[kFrames / 2] < 200.0);
}
