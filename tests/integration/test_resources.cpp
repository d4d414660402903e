// Pools, pipelines, cached views and failures, over the recording device.
#include "allocations.h"
#include "recording_fixture.h"
#include <map>

using nrd::Denoiser;
using nrd::ResourceType;
using nrd::Result;
using rhi::CallType;
using test::RecordingFixture;
using test::require;

TEST_CASE("memory is reported by pool as allocated", "[unit]")
{
    RecordingFixture f({{3, Denoiser::REBLUR_DIFFUSE_SPECULAR}});
    f.requireCreated();
    const nrd::MemoryStatistics memory = f.integration.GetMemoryStatistics();
    std::map<std::string, uint64_t> report;
    for (const rhi::MemoryReportLine& line : f.device->memoryReport()) report[line.tag] = line.byteSize;
    CHECK(memory.permanent == report["NRD permanent"]);
    CHECK(memory.transient == report["NRD transient"]);
    CHECK(memory.total == memory.permanent + memory.transient + report["NRD constants"]);
    CHECK(memory.permanent > 0);
    CHECK(memory.transient > 0);
    CHECK(f.count(CallType::CreateMemory) == 2); // one block for each pool
}

TEST_CASE("pool textures are named, and no two share bytes", "[unit]")
{
    RecordingFixture f({{3, Denoiser::REBLUR_DIFFUSE_SPECULAR}});
    f.desc.name = "Left eye";
    f.requireCreated();
    const nrd::InstanceDesc& instance = nrd::GetInstanceDesc(*f.integration.GetInstance());
    const auto textures = f.calls(CallType::CreatePlacedTexture);
    REQUIRE(textures.size() == instance.permanentPoolSize + instance.transientPoolSize);
    CHECK(textures[0].name == "Left eye P(0)");
    CHECK(textures.back().name == "Left eye T(" + std::to_string(instance.transientPoolSize - 1) + ")");
    std::map<std::string, uint64_t> ends;
    for (const rhi::RecordedCall& texture : textures)
    {
        CHECK(texture.offset >= ends[texture.other]);
        ends[texture.other] = texture.offset + texture.size;
    }
}

TEST_CASE("pipelines are made at their first use, or all default ones in Create", "[unit]")
{
    RecordingFixture f({{3, Denoiser::REBLUR_DIFFUSE_SPECULAR}, {7, Denoiser::REFERENCE}});
    f.fillReblurSlots();
    f.desc.createDefaultPipelines = GENERATE(false, true);
    f.requireCreated();
    const uint32_t created = f.integration.GetStatistics().pipelines;
    CHECK(created == f.count(CallType::CreatePipeline));
    CHECK((created > 0) == f.desc.createDefaultPipelines);
    for (int frame = 0; frame < 3; frame++)
    {
        f.beginFrame();
        require(f.denoise({3, 7}), f.integration);
    }
    const uint32_t used = f.integration.GetStatistics().pipelines;
    CHECK(used == f.count(CallType::CreatePipeline));
    CHECK(used > 0);
    if (f.desc.createDefaultPipelines) CHECK(used == created); // nothing was left for the frames
    CHECK(used < nrd::GetInstanceDesc(*f.integration.GetInstance()).pipelinesNum);
}

TEST_CASE("a pipeline that fails to build is named, and the history begins anew afterwards", "[unit]")
{
    RecordingFixture f;
    f.requireCreated();
    f.beginFrame();
    f.device->failCreation(2, rhi::ErrorCode::InvalidShader); // after the wrapped command buffer
    CHECK(f.denoise() == Result::FAILURE);
    CHECK(std::string(f.integration.GetLastMessage()).find("Clear") != std::string::npos);
    CHECK(f.count(CallType::Dispatch) == 0);
    require(f.denoise(), f.integration);
    // The clears of the first request come again.
    CHECK(f.calls(CallType::BindPipeline)[0].name.find("Clear") != std::string::npos);
    CHECK(f.barriersOf("NRD P(0)")[0].before == rhi::states::kUndefined);
}

TEST_CASE("a failing allocation at any point leaves the object usable or destroyable", "[unit]")
{
    uint32_t failures = 0;
    for (uint32_t n = 1; n < 1000; n++)
    {
        INFO("creation " << n);
        RecordingFixture f({{3, Denoiser::REBLUR_DIFFUSE_SPECULAR}, {7, Denoiser::REFERENCE}});
        f.fillReblurSlots();
        f.desc.isGpuTimingEnabled = true;
        f.device->failCreation(n);
        bool hasFailed = f.create() != Result::SUCCESS;
        if (hasFailed)
        {
            CHECK(f.device->objectCount() == 0);
            CHECK(f.integration.GetLastMessage() != std::string());
            f.requireCreated(); // the failure fires once
        }
        for (int frame = 0; frame < 3; frame++)
        {
            f.beginFrame();
            const nrd::NrdImageState before = f.pool[ResourceType::IN_VIEWZ].state;
            if (f.denoise({3, 7}) != Result::SUCCESS)
            {
                hasFailed = true;
                CHECK(f.pool[ResourceType::IN_VIEWZ].state == before);
                require(f.denoise({3, 7}), f.integration);
            }
            if (frame != 1) continue;
            if (f.integration.Resize(32, 32) != Result::SUCCESS)
            {
                hasFailed = true;
                CHECK(f.integration.GetLastMessage() != std::string());
                require(f.integration.Resize(32, 32), f.integration);
            }
            f.width = f.height = 32;
            f.fillReblurSlots();
            f.pool[ResourceType::IN_SIGNAL] = f.image(0x100);
            f.pool[ResourceType::OUT_SIGNAL] = f.image(0x200);
        }
        f.integration.Destroy();
        CHECK(f.device->objectCount() == 0);
        failures += hasFailed;
        if (!hasFailed) break; // n is beyond the last creation
    }
    CHECK(failures > 50);
    CHECK(failures < 999);
}

TEST_CASE("an exhausted heap at any point ends in a result, and the object goes on", "[unit]")
{
    uint32_t failures = 0;
    for (size_t n = 1; n < 5000; n++)
    {
        INFO("allocation " << n);
        RecordingFixture f({{3, Denoiser::REBLUR_DIFFUSE_SPECULAR}, {7, Denoiser::REFERENCE}});
        f.fillReblurSlots();
        const nrd::Identifier identifiers[] = {3, 7};
        Result results[4] = {};
        bool hasFailed = false;
        {
            const test::AllocationWatch watch(n);
            results[0] = nrd::IntegrationAccess::Create(f.integration, f.spy, f.desc, f.instanceDesc);
            results[1] = f.integration.NewFrame();
            results[2] = f.integration.SetCommonSettings(test::stillCamera(f.width, f.height, 0));
            results[3] = f.integration.Denoise(test::fakeCommandBuffer(), identifiers, 2, f.pool);
            hasFailed = watch.count() >= n;
        }
        if (!hasFailed) break;
        failures++;
        CHECK((results[0] != Result::SUCCESS || results[3] != Result::SUCCESS));
        if (!f.integration.IsCreated()) f.requireCreated();
        f.frameIndex = 1;
        f.beginFrame();
        require(f.denoise({3, 7}), f.integration);
        f.integration.Destroy();
        CHECK(f.device->objectCount() == 0);
    }
    CHECK(failures > 100);
    CHECK(failures < 4999);
}

TEST_CASE("resizing every frame grows neither memory nor the number of objects", "[unit]")
{
    RecordingFixture f;
    f.requireCreated();
    uint32_t objects = 0;
    uint64_t memory = 0;
    for (uint32_t frame = 0; frame < 100; frame++)
    {
        f.width = static_cast<uint16_t>(frame % 2 ? 64 : 80);
        require(f.integration.Resize(f.width, f.height), f.integration);
        f.pool[ResourceType::IN_SIGNAL] = f.image(0x100);
        f.pool[ResourceType::OUT_SIGNAL] = f.image(0x200);
        f.beginFrame();
        require(f.denoise(), f.integration);
        if (frame == 50)
        {
            objects = f.device->objectCount();
            memory = f.integration.GetMemoryStatistics().total;
        }
        if (frame > 50 && frame % 2 == 0)
        {
            CHECK(f.device->objectCount() == objects);
            CHECK(f.integration.GetMemoryStatistics().total == memory);
        }
        CHECK(f.integration.GetStatistics().retiredObjects <= 3 * (f.desc.framesInFlight + 1));
    }
    CHECK(f.count(CallType::WaitIdle) == 0);
}

TEST_CASE("views are made once for an image that comes back each frame", "[unit]")
{
    RecordingFixture f;
    f.requireCreated();
    for (int frame = 0; frame < 40; frame++)
    {
        f.pool[ResourceType::IN_SIGNAL].image = test::fakeImage(0x100 + static_cast<uintptr_t>(frame % 3));
        f.beginFrame();
        require(f.denoise(), f.integration);
    }
    CHECK(f.integration.GetStatistics().cachedUserImages == 4); // three inputs in turn and one output
    CHECK(f.count(CallType::WrapTexture) == 4);
    CHECK(f.count(CallType::WrapCommandBuffer) == 1);
}

TEST_CASE("an image that is no longer used loses its views", "[unit]")
{
    RecordingFixture f;
    f.requireCreated();
    for (uintptr_t frame = 0; frame < 100; frame++)
    {
        f.pool[ResourceType::IN_SIGNAL].image = test::fakeImage(0x1000 + frame);
        f.beginFrame();
        require(f.denoise(), f.integration);
        CHECK(f.integration.GetStatistics().cachedUserImages < 20);
    }
}

TEST_CASE("a re-created image with the handle of the old one gets new views", "[unit]")
{
    RecordingFixture f;
    f.requireCreated();
    f.beginFrame();
    require(f.denoise(), f.integration);
    f.device->clearCalls();
    f.pool[ResourceType::IN_SIGNAL].generation = 1;
    f.beginFrame();
    require(f.denoise(), f.integration);
    CHECK(f.count(CallType::WrapTexture) == 1);
    CHECK(f.integration.GetStatistics().cachedUserImages == 2);
    f.device->clearCalls();
    require(f.integration.Forget(f.pool[ResourceType::IN_SIGNAL].image), f.integration);
    CHECK(f.integration.GetStatistics().cachedUserImages == 1);
    CHECK(f.count(CallType::Destroy) == 0); // the GPU may still use them
    for (uint32_t frame = 0; frame < f.desc.framesInFlight; frame++) f.beginFrame();
    CHECK(f.count(CallType::Destroy) > 0);
    require(f.denoise(), f.integration);
    CHECK(f.integration.GetStatistics().cachedUserImages == 2);
}

TEST_CASE("states are left as told, or restored when asked", "[unit]")
{
    RecordingFixture f;
    f.requireCreated();
    const nrd::NrdImageState rendered = {VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT,
                                         VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT};
    nrd::NrdUserImage& in = f.pool[ResourceType::IN_SIGNAL];
    nrd::NrdUserImage& out = f.pool[ResourceType::OUT_SIGNAL];
    in.state = rendered;
    f.beginFrame();
    require(f.denoise(), f.integration);
    CHECK(in.state == nrd::NrdImageState{VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_ACCESS_SHADER_READ_BIT,
                                         VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT});
    CHECK(out.state == nrd::NrdImageState{VK_IMAGE_LAYOUT_GENERAL,
                                          VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT,
                                          VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT});
    in.state = rendered;
    out.state = {};
    nrd::DenoiseOptions options;
    options.restoreInitialStates = true;
    f.beginFrame();
    require(f.denoise({7}, options), f.integration);
    CHECK(in.state == rendered);
    CHECK(out.state.layout == VK_IMAGE_LAYOUT_GENERAL); // there is no way back to UNDEFINED
    CHECK(f.barriersOf("IN_SIGNAL").back().after.native.layout == VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
}
