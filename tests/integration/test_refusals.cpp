// Every misuse ends in one sentence that names it, and records nothing.
#include "recording_fixture.h"

using nrd::Denoiser;
using nrd::ResourceType;
using nrd::Result;
using rhi::CallType;
using test::RecordingFixture;
using test::require;
using test::requireRefusal;

namespace
{
struct SinkLog
{
    std::vector<std::string> texts;
    static void report(void* self, Result, const char* text) { static_cast<SinkLog*>(self)->texts.push_back(text); }
};

// Refused: nothing was recorded, and the same call works once the cause is gone.
void requireNothingRecorded(const RecordingFixture& f)
{
    CHECK(f.count(CallType::Dispatch) == 0);
    CHECK(f.count(CallType::Barriers) == 0);
    CHECK(f.count(CallType::BeginLabel) == 0);
}
} // namespace

TEST_CASE("nothing works before Create, and everything says so", "[unit]")
{
    nrd::NrdIntegration integration;
    nrd::NrdUserPool pool;
    const std::string sentence = "Create() must succeed before any other call";
    requireRefusal(integration.NewFrame(), integration, sentence);
    requireRefusal(integration.SetCommonSettings({}), integration, sentence);
    requireRefusal(integration.SetDenoiserSettings(0, nrd::ReblurSettings{}), integration, sentence);
    requireRefusal(integration.SetDenoiserSettings(0, nrd::RelaxSettings{}), integration, sentence);
    requireRefusal(integration.SetDenoiserSettings(0, nrd::SigmaSettings{}), integration, sentence);
    requireRefusal(integration.SetDenoiserSettings(0, nrd::ReferenceSettings{}), integration, sentence);
    requireRefusal(integration.Resize(1, 1), integration, sentence);
    requireRefusal(integration.Forget(VK_NULL_HANDLE), integration, sentence);
    requireRefusal(integration.Denoise(VK_NULL_HANDLE, nullptr, 0, pool), integration, sentence);
    CHECK_FALSE(integration.IsCreated());
    CHECK(integration.GetInstance() == nullptr);
    CHECK(integration.GetMemoryStatistics().total == 0);
    CHECK(integration.GetStatistics().pipelines == 0);
    CHECK(integration.GetTimings().passesNum == 0);
    integration.Destroy();
    integration.Destroy();
}

TEST_CASE("Create refuses each field that is out of range by name", "[unit]")
{
    RecordingFixture f;
    SinkLog log;
    f.instanceDesc.messageSink = {SinkLog::report, &log};
    const auto refuse = [&](const std::string& sentence)
    {
        requireRefusal(f.create(), f.integration, sentence);
        CHECK(log.texts == std::vector<std::string>{sentence});
        CHECK(f.device->objectCount() == 0);
        CHECK_FALSE(f.integration.IsCreated());
        f.desc.resourceWidth = RecordingFixture::kWidth;
        f.desc.resourceHeight = RecordingFixture::kHeight;
        f.desc.framesInFlight = 3;
        f.desc.maxDenoiseCallsPerFrame = 4;
        f.desc.layoutPolicy = nrd::LayoutPolicy::OPTIMAL;
        log.texts.clear();
    };
    f.desc.resourceWidth = 0;
    refuse("resourceWidth is 0, must be at least 1");
    f.desc.resourceHeight = 0;
    refuse("resourceHeight is 0, must be at least 1");
    f.desc.framesInFlight = 0;
    refuse("framesInFlight is 0, must be in [1; 16]");
    f.desc.framesInFlight = 17;
    refuse("framesInFlight is 17, must be in [1; 16]");
    f.desc.maxDenoiseCallsPerFrame = 0;
    refuse("maxDenoiseCallsPerFrame is 0, must be in [1; 1024]");
    f.desc.layoutPolicy = nrd::LayoutPolicy::MAX_NUM;
    refuse("layoutPolicy is 2, which is no LayoutPolicy");
    f.requireCreated(); // all fields are good again
    CHECK(log.texts.empty());
    requireRefusal(f.create(), f.integration, "Create() was called before: Destroy() must come in between");
}

TEST_CASE("Create passes on what the descriptor library refuses", "[unit]")
{
    RecordingFixture f({{7, Denoiser::REFERENCE}, {7, Denoiser::REFERENCE}});
    CHECK(f.create() == Result::NON_UNIQUE_IDENTIFIER);
    CHECK(std::string(f.integration.GetLastMessage()).find("7") != std::string::npos);
    RecordingFixture g({{1, Denoiser::MAX_NUM}});
    CHECK(g.create() == Result::UNSUPPORTED);
    CHECK(g.integration.GetLastMessage() != std::string());
}

TEST_CASE("Create from native handles names the handle that is missing", "[unit]")
{
    RecordingFixture f;
    const auto create = [&] { return f.integration.Create(f.desc, f.instanceDesc); };
    requireRefusal(create(), f.integration, "native.instance is null");
    f.desc.native.instance = reinterpret_cast<VkInstance>(uintptr_t(1));
    requireRefusal(create(), f.integration, "native.physicalDevice is null");
    f.desc.native.physicalDevice = reinterpret_cast<VkPhysicalDevice>(uintptr_t(1));
    requireRefusal(create(), f.integration, "native.device is null");
    f.desc.native.device = reinterpret_cast<VkDevice>(uintptr_t(1));
    requireRefusal(create(), f.integration, "native.getInstanceProcAddr is null");
}

TEST_CASE("a frame index that stands still is refused, within a frame it may be set again", "[unit]")
{
    RecordingFixture f;
    f.requireCreated();
    requireRefusal(f.integration.SetCommonSettings(f.settings), f.integration,
                   "NewFrame() must be called before SetCommonSettings()");
    f.beginFrame();
    f.beginFrame();
    require(f.integration.SetCommonSettings(f.settings), f.integration);
    require(f.integration.NewFrame(), f.integration);
    requireRefusal(f.integration.SetCommonSettings(f.settings), f.integration,
                   "frameIndex is 1 as in the previous frame, it must grow by 1 with each frame");
    requireRefusal(f.denoise(), f.integration,
                   "SetCommonSettings() must be called between NewFrame() or Resize() and Denoise()");
    f.settings.frameIndex = 2;
    require(f.integration.SetCommonSettings(f.settings), f.integration);
    require(f.denoise(), f.integration);
}

TEST_CASE("a resource size other than the one of creation is refused", "[unit]")
{
    RecordingFixture f;
    f.requireCreated();
    require(f.integration.NewFrame(), f.integration);
    requireRefusal(f.integration.SetCommonSettings(test::stillCamera(32, 48, 0)), f.integration,
                   "resourceSize is 32 x 48, but the integration was created or resized for 64 x 48");
    requireRefusal(f.integration.Resize(0, 48), f.integration, "resourceWidth is 0, must be at least 1");
    requireRefusal(f.integration.Resize(64, 0), f.integration, "resourceHeight is 0, must be at least 1");
}

TEST_CASE("what the library says of settings is passed on, and the old ones stay", "[unit]")
{
    RecordingFixture f;
    f.requireCreated();
    f.beginFrame();
    nrd::CommonSettings settings = f.settings;
    settings.viewZScale = 0.0f;
    CHECK(f.integration.SetCommonSettings(settings) == Result::INVALID_ARGUMENT);
    CHECK(std::string(f.integration.GetLastMessage()).find("viewZScale") != std::string::npos);
    require(f.denoise(), f.integration); // with the settings before
    CHECK(f.integration.SetDenoiserSettings(7, nrd::ReblurSettings{}) == Result::INVALID_ARGUMENT);
    CHECK(f.integration.SetDenoiserSettings(7, nrd::RelaxSettings{}) == Result::INVALID_ARGUMENT);
    CHECK(f.integration.SetDenoiserSettings(7, nrd::SigmaSettings{}) == Result::INVALID_ARGUMENT);
    CHECK(f.integration.SetDenoiserSettings(8, nrd::ReferenceSettings{}) == Result::INVALID_ARGUMENT);
}

TEST_CASE("requests that make no sense are refused and record nothing", "[unit]")
{
    RecordingFixture f;
    f.requireCreated();
    requireRefusal(f.denoise(), f.integration, "NewFrame() must be called before Denoise()");
    f.beginFrame();
    f.device->clearCalls();
    requireRefusal(f.denoise({9}), f.integration, "identifier 9 names no denoiser of this instance");
    const std::string twice = "identifier 7 (REFERENCE) is denoised twice in one frame, which would spoil its history";
    requireRefusal(f.denoise({7, 7}), f.integration, twice);
    requireRefusal(f.integration.Denoise(VK_NULL_HANDLE, nullptr, 0, f.pool), f.integration, "commandBuffer is null");
    requireRefusal(f.integration.Denoise(test::fakeCommandBuffer(), nullptr, 1, f.pool), f.integration,
                   "identifiers is null, but identifiersNum is 1");
    require(f.denoise({}), f.integration); // nothing to do is no error
    requireNothingRecorded(f);
    require(f.denoise({7}), f.integration);
    f.device->clearCalls();
    requireRefusal(f.denoise({7}), f.integration, twice);
    requireNothingRecorded(f);
}

TEST_CASE("without history a denoiser runs for one light after another, with history a second time is refused",
          "[unit]")
{
    for (const Denoiser denoiser : {Denoiser::SIGMA_SHADOW, Denoiser::SIGMA_SHADOW_TRANSLUCENCY})
    {
        RecordingFixture f({{3, denoiser}, {4, denoiser, 1, false}});
        f.fillReblurSlots();
        f.pool[ResourceType::IN_PENUMBRA] = f.image(0x401, VK_FORMAT_R16_SFLOAT);
        f.pool[ResourceType::IN_TRANSLUCENCY] = f.image(0x402, VK_FORMAT_R8G8B8A8_UNORM);
        f.pool[ResourceType::OUT_SHADOW_TRANSLUCENCY] = f.image(0x403, VK_FORMAT_R8G8B8A8_UNORM);
        f.requireCreated();
        f.beginFrame();
        for (int light = 0; light < 4; light++) require(f.denoise({4}), f.integration);
        require(f.denoise({3}), f.integration);
        f.device->clearCalls();
        requireRefusal(f.denoise({3}), f.integration,
                       std::string("identifier 3 (") + toString(denoiser) +
                           ") is denoised twice in one frame, which would spoil its history");
        requireNothingRecorded(f);
        f.beginFrame();
        require(f.denoise({3}), f.integration);
    }
}

TEST_CASE("an empty slot that is needed is named, and history goes on afterwards", "[unit]")
{
    RecordingFixture f({{3, Denoiser::REBLUR_DIFFUSE_SPECULAR}});
    f.fillReblurSlots();
    f.requireCreated();
    f.beginFrame();
    for (const ResourceType slot : {ResourceType::IN_MV, ResourceType::IN_NORMAL_ROUGHNESS, ResourceType::IN_VIEWZ,
                                    ResourceType::IN_DIFF_RADIANCE_HITDIST, ResourceType::IN_SPEC_RADIANCE_HITDIST,
                                    ResourceType::OUT_DIFF_RADIANCE_HITDIST, ResourceType::OUT_SPEC_RADIANCE_HITDIST})
    {
        const nrd::NrdUserImage image = f.pool[slot];
        f.pool[slot] = {};
        f.device->clearCalls();
        requireRefusal(f.denoise({3}), f.integration,
                       std::string(toString(slot)) + ": the slot is empty, but REBLUR_DIFFUSE_SPECULAR needs it");
        requireNothingRecorded(f);
        f.pool[slot] = image;
    }
    require(f.denoise({3}), f.integration);
}

TEST_CASE("images that cannot serve are refused through Denoise as well", "[unit]")
{
    RecordingFixture f({{3, Denoiser::REBLUR_DIFFUSE_SPECULAR}});
    f.fillReblurSlots();
    f.requireCreated();
    f.beginFrame();
    f.device->clearCalls();
    f.pool[ResourceType::OUT_DIFF_RADIANCE_HITDIST].usage = VK_IMAGE_USAGE_SAMPLED_BIT;
    requireRefusal(f.denoise({3}), f.integration,
                   "OUT_DIFF_RADIANCE_HITDIST: the image was created without VK_IMAGE_USAGE_STORAGE_BIT, which this "
                   "slot needs");
    f.fillReblurSlots();
    f.pool[ResourceType::IN_NORMAL_ROUGHNESS].format = VK_FORMAT_R8G8B8A8_UNORM;
    requireRefusal(f.denoise({3}), f.integration,
                   "IN_NORMAL_ROUGHNESS: the format is RGBA8_UNORM, but the instance's normal encoding asks for "
                   "A2B10G10R10_UNORM_PACK32 (or A2R10G10B10)");
    f.fillReblurSlots();
    f.pool[ResourceType::IN_SPEC_RADIANCE_HITDIST] = f.pool[ResourceType::IN_DIFF_RADIANCE_HITDIST];
    f.pool[ResourceType::IN_SPEC_RADIANCE_HITDIST].state.layout = VK_IMAGE_LAYOUT_GENERAL;
    requireRefusal(f.denoise({3}), f.integration,
                   "IN_DIFF_RADIANCE_HITDIST and IN_SPEC_RADIANCE_HITDIST: one image in two states (layout, access or "
                   "stages differ)");
    requireNothingRecorded(f);
}

TEST_CASE("more calls than announced are refused instead of overwriting constants in flight", "[unit]")
{
    RecordingFixture f({{1, Denoiser::REFERENCE}, {2, Denoiser::REFERENCE}});
    f.desc.maxDenoiseCallsPerFrame = 1;
    f.requireCreated();
    f.beginFrame();
    require(f.denoise({1}), f.integration);
    requireRefusal(f.denoise({2}), f.integration,
                   "Denoise() is called more often in this frame than maxDenoiseCallsPerFrame = 1 allows");
    f.beginFrame();
    require(f.denoise({1, 2}), f.integration);
}

TEST_CASE("a device without a storage format says which slot asked for it", "[unit]")
{
    RecordingFixture f;
    rhi::RecordingDeviceDesc weak;
    weak.unsupportedFormats = {rhi::Format::RGBA16_SFLOAT};
    const std::unique_ptr<rhi::RecordingDevice> device = rhi::makeRecordingDevice(weak);
    nrd::NrdIntegration integration;
    require(nrd::IntegrationAccess::Create(integration, *device, f.desc, f.instanceDesc), integration);
    require(integration.NewFrame(), integration);
    require(integration.SetCommonSettings(test::stillCamera(f.width, f.height, 0)), integration);
    const nrd::Identifier identifier = 7;
    CHECK(integration.Denoise(test::fakeCommandBuffer(), &identifier, 1, f.pool) != Result::SUCCESS);
    CHECK(std::string(integration.GetLastMessage()).find("_SIGNAL") != std::string::npos);
}

TEST_CASE("the validation overlay needs its output while it is enabled", "[unit]")
{
    RecordingFixture f({{3, Denoiser::REBLUR_DIFFUSE_SPECULAR}});
    f.fillReblurSlots();
    f.requireCreated();
    const auto beginFrame = [&](bool isEnabled)
    {
        require(f.integration.NewFrame(), f.integration);
        f.settings = test::stillCamera(f.width, f.height, f.frameIndex++);
        f.settings.enableValidation = isEnabled;
        require(f.integration.SetCommonSettings(f.settings), f.integration);
    };
    beginFrame(false);
    require(f.denoise({3}), f.integration);
    beginFrame(true);
    f.device->clearCalls();
    requireRefusal(f.denoise({3}), f.integration,
                   "OUT_VALIDATION: the slot is empty, but REBLUR_DIFFUSE_SPECULAR needs it");
    requireNothingRecorded(f);
    f.pool[ResourceType::OUT_VALIDATION] = f.image(0x700, VK_FORMAT_R8_UNORM);
    requireRefusal(f.denoise({3}), f.integration,
                   "OUT_VALIDATION: the format is R8_UNORM, which keeps less than RGBA8_UNORM, the least that serves");
    f.pool[ResourceType::OUT_VALIDATION] = f.image(0x701, VK_FORMAT_R8G8B8A8_UNORM);
    require(f.denoise({3}), f.integration);
}
