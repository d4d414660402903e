// A main and a render thread over recording devices: no driver, so that thread checkers see every access.
#include "integration_access.h"
#include "plugin_frames.h"
#include "recording_plugin.h"
#include "threaded_engine.h"
#include <algorithm>
#include <atomic>

using namespace test;

namespace
{
constexpr uint32_t kDenoiserNum = static_cast<uint32_t>(nrd::Denoiser::MAX_NUM);
constexpr uint32_t kFrameNum = 24;

// NrdIntegration by itself, with the same images.
class DirectIntegration
{
public:
    explicit DirectIntegration(uint32_t index) : m_denoiser(static_cast<nrd::Denoiser>(index))
    {
        const nrd::DenoiserDesc denoiserDesc = {0, m_denoiser};
        REQUIRE(nrd::IntegrationAccess::Create(m_integration, recorded.spy, integrationDesc(m_denoiser),
                                               instanceDesc(denoiserDesc)) == nrd::Result::SUCCESS);
        m_pool = userPool(m_denoiser, RecordingPlugin::images(index));
    }

    void denoiseFrame(const DirectFrame& frame)
    {
        for (uint32_t slot = 0; slot < nrd::NrdUserPool::kSlotsNum; slot++)
        {
            nrd::NrdUserImage& image = m_pool[static_cast<nrd::ResourceType>(slot)];
            image.width = frame.common.resourceSize[0];
            image.height = frame.common.resourceSize[1];
            image.generation = image.width; // the handles stay the same
        }
        const nrd::Result result =
            denoise(m_integration, m_denoiser, frame, RecordingPlugin::deviceDesc().getCommandBuffer(nullptr), m_pool);
        INFO(m_integration.GetLastMessage());
        REQUIRE(result == nrd::Result::SUCCESS);
    }

    RecordedDevice recorded;

private:
    nrd::Denoiser m_denoiser;
    nrd::NrdUserPool m_pool;
    nrd::NrdIntegration m_integration; // goes before the device
};

// Empty, or the first line in which they differ.
std::string difference(const std::vector<std::string>& found, const std::vector<std::string>& expected)
{
    for (size_t i = 0; i < std::max(found.size(), expected.size()); i++)
    {
        const std::string a = i < found.size() ? found[i] : "nothing",
                          b = i < expected.size() ? expected[i] : "nothing";
        if (a != b) return std::to_string(i) + ": " + a + "\nexpected: " + b;
    }
    return {};
}

struct RefusalCounter
{
    RefusalCounter() { requireSuccess(NrdPluginSetMessageCallback(count, this)); }
    ~RefusalCounter() { (void)NrdPluginSetMessageCallback(nullptr, nullptr); }
    static void count(void* userArg, NrdPluginResult, const char*) { ++static_cast<RefusalCounter*>(userArg)->num; }
    std::atomic<uint32_t> num = 0;
};

void setFrame(uint32_t frame)
{
    const NrdPluginFrame description = pluginFrame(frame);
    (void)NrdPluginSetFrame(&description); // a refusal is counted
}
} // namespace

TEST_CASE("events of a render thread three frames behind record what NrdIntegration records", "[unit]")
{
    RecordingPlugin plugin;
    for (uint32_t denoiser = 0; denoiser < kDenoiserNum; denoiser++) requireSuccess(plugin.initialize(denoiser));
    NrdPluginEventCallback callback = nullptr;
    requireSuccess(NrdPluginGetEventCallback(&callback));
    const RefusalCounter refusals;
    ThreadedEngine engine;
    engine.run(kFrameNum, setFrame,
               [&](uint32_t frame)
               {
                   for (uint32_t denoiser = 0; denoiser < kDenoiserNum; denoiser++)
                       callback(NrdPluginGetEventId(denoiser, kFirstFrame + frame));
               });
    CHECK(refusals.num == 0);
    CHECK(engine.greatestLag() == 3);

    for (uint32_t denoiser = 0; denoiser < kDenoiserNum; denoiser++)
    {
        INFO("denoiser " << denoiser);
        DirectIntegration expected(denoiser);
        for (uint32_t frame = 0; frame < kFrameNum; frame++) expected.denoiseFrame(directFrame(frame));
        const RecordedDevice& found = plugin.devices[1 + denoiser];
        CHECK(difference(found.calls(), expected.recorded.calls()) == "");
        CHECK(found.uploads() == expected.recorded.uploads()); // constants: matrices, light, time, history
    }
}

TEST_CASE("a denoiser initialised for another size goes on as NrdIntegration does after Resize()", "[unit]")
{
    constexpr uint32_t kLargeFrames[] = {8, 16}; // from, to
    constexpr Size kLarge = {kWidth + 11, kHeight + 5};
    const auto sizeOf = [&](uint32_t frame)
    { return frame >= kLargeFrames[0] && frame < kLargeFrames[1] ? kLarge : Size{}; };
    RecordingPlugin plugin;
    for (uint32_t denoiser = 0; denoiser < kDenoiserNum; denoiser++) requireSuccess(plugin.initialize(denoiser));
    const RefusalCounter refusals;
    ThreadedEngine engine;
    engine.run(
        kFrameNum,
        [&](uint32_t frame)
        {
            for (uint32_t denoiser = 0; denoiser < kDenoiserNum; denoiser++)
                if (frame == kLargeFrames[0] || frame == kLargeFrames[1])
                    (void)plugin.initialize(denoiser, sizeOf(frame));
            setFrame(frame);
        },
        [&](uint32_t frame)
        {
            for (uint32_t denoiser = 0; denoiser < kDenoiserNum; denoiser++)
                (void)NrdPluginExecute(NrdPluginGetEventId(denoiser, kFirstFrame + frame));
        });
    CHECK(refusals.num == 0);
    REQUIRE(plugin.devices.size() == 1 + kDenoiserNum); // none was created again
    for (uint32_t denoiser = 0; denoiser < kDenoiserNum; denoiser++)
    {
        INFO("denoiser " << denoiser);
        DirectIntegration expected(denoiser);
        for (uint32_t frame = 0; frame < kFrameNum; frame++)
            expected.denoiseFrame(directFrame(frame, sizeOf(frame), sizeOf(frame == 0 ? 0 : frame - 1)));
        const RecordedDevice& found = plugin.devices[1 + denoiser];
        CHECK(difference(found.calls(), expected.recorded.calls()) == "");
        CHECK(found.uploads() == expected.recorded.uploads());
    }
}

TEST_CASE("images that may have the handles of others get views of their own", "[unit]")
{
    RecordingPlugin plugin;
    const auto viewNum = [&]
    {
        const auto& calls = plugin.devices[1].device->calls();
        return std::count_if(calls.begin(), calls.end(),
                             [](const rhi::RecordedCall& call) { return call.type == rhi::CallType::WrapTexture; });
    };
    std::ptrdiff_t nums[3] = {};
    for (uint32_t frame = 0; frame < 3; frame++)
    {
        if (frame != 1) requireSuccess(plugin.initialize(NRD_PLUGIN_REBLUR_DIFFUSE));
        setFrame(frame);
        requireSuccess(NrdPluginExecute(NrdPluginGetEventId(NRD_PLUGIN_REBLUR_DIFFUSE, kFirstFrame + frame)));
        nums[frame] = viewNum();
    }
    CHECK(plugin.devices.size() == 2);
    CHECK(nums[0] > 0);
    CHECK(nums[1] == nums[0]);
    CHECK(nums[2] == 2 * nums[0]);
}

TEST_CASE("images with another encoding of normals have a denoiser begin anew", "[unit]")
{
    RecordingPlugin plugin;
    requireSuccess(plugin.initialize(NRD_PLUGIN_REBLUR_DIFFUSE));
    std::vector<NrdPluginImage> images = RecordingPlugin::images(NRD_PLUGIN_REBLUR_DIFFUSE);
    images[1].format = VK_FORMAT_A2B10G10R10_UNORM_PACK32; // IN_NORMAL_ROUGHNESS
    for (uint32_t frame = 0; frame < 2; frame++)
    {
        if (frame == 1)
            requireSuccess(
                NrdPluginInitialize(NRD_PLUGIN_REBLUR_DIFFUSE, images.data(), static_cast<uint32_t>(images.size())));
        setFrame(frame);
        requireSuccess(NrdPluginExecute(NrdPluginGetEventId(NRD_PLUGIN_REBLUR_DIFFUSE, kFirstFrame + frame)));
    }
    CHECK(plugin.devices.size() == 3);
}

TEST_CASE("denoisers come and go on the main thread while the render thread is behind", "[unit]")
{
    constexpr uint32_t kLongFrameNum = 60;
    constexpr uint16_t kLarge = 2 * kWidth;
    RecordingPlugin plugin;
    const RefusalCounter refusals;
    // Relax is there in the frames [10; 30) and, anew, from 40 on.
    const auto isThere = [](uint32_t frame) { return (frame >= 10 && frame < 30) || frame >= 40; };
    requireSuccess(plugin.initialize(NRD_PLUGIN_REBLUR_DIFFUSE));
    ThreadedEngine engine;
    engine.run(
        kLongFrameNum,
        [&](uint32_t frame)
        {
            if (frame == 10 || frame == 40) (void)plugin.initialize(NRD_PLUGIN_RELAX_SPECULAR);
            if (frame == 30) (void)NrdPluginRelease(NRD_PLUGIN_RELAX_SPECULAR);
            if (frame % 8 == 7) (void)plugin.initialize(NRD_PLUGIN_REBLUR_DIFFUSE, {frame % 16 == 7 ? kLarge : kWidth});
            setFrame(frame);
        },
        [&](uint32_t frame)
        {
            (void)NrdPluginExecute(NrdPluginGetEventId(NRD_PLUGIN_REBLUR_DIFFUSE, kFirstFrame + frame));
            if (isThere(frame))
                (void)NrdPluginExecute(NrdPluginGetEventId(NRD_PLUGIN_RELAX_SPECULAR, kFirstFrame + frame));
        });
    CHECK(refusals.num == 0);
    // The probe, and what was released long ago, has given everything back; another size creates nothing anew.
    REQUIRE(plugin.devices.size() == 1 + 1 + 2);
    uint32_t aliveNum = 0;
    for (const RecordedDevice& device : plugin.devices) aliveNum += device.device->objectCount() != 0;
    CHECK(aliveNum == 2); // Reblur, Relax
    requireSuccess(NrdPluginReleaseAll());
    for (const RecordedDevice& device : plugin.devices) CHECK(device.device->objectCount() == 0);
}

TEST_CASE("a denoiser that missed a frame begins anew, and so does one after a cut", "[unit]")
{
    const bool isCut = GENERATE(false, true); // in frame 4, or frame 3 is missed
    RecordingPlugin plugin;
    requireSuccess(plugin.initialize(NRD_PLUGIN_REBLUR_DIFFUSE));
    DirectIntegration expected(NRD_PLUGIN_REBLUR_DIFFUSE);
    for (uint32_t frame = 0; frame < 8; frame++)
    {
        NrdPluginFrame description = pluginFrame(frame);
        description.isHistoryReset = isCut && frame == 4;
        requireSuccess(NrdPluginSetFrame(&description));
        if (!isCut && frame == 3) continue;
        requireSuccess(NrdPluginExecute(NrdPluginGetEventId(NRD_PLUGIN_REBLUR_DIFFUSE, kFirstFrame + frame)));

        DirectFrame direct = directFrame(frame);
        nrd::CommonSettings& common = direct.common;
        if (frame == 4 && isCut) common.accumulationMode = nrd::AccumulationMode::CLEAR_AND_RESTART;
        if (frame == 4 && !isCut)
        {
            common.accumulationMode = nrd::AccumulationMode::RESTART;
            std::copy_n(common.worldToViewMatrix, 16, common.worldToViewMatrixPrev);
            std::copy_n(common.cameraJitter, 2, common.cameraJitterPrev);
        }
        expected.denoiseFrame(direct);
        CHECK(plugin.devices[1].uploads() == expected.recorded.uploads());
    }
    CHECK(difference(plugin.devices[1].calls(), expected.recorded.calls()) == "");
}
