// The shared library on a device, as an engine with two threads uses it: its pictures are NrdIntegration's, bit by bit.
#include "../integration/gpu_fixture.h"
#include "plugin_frames.h"
#include "threaded_engine.h"
#include <cmath>
#include <cstring>
#include <map>
#include <random>

using namespace test;

namespace
{
constexpr uint32_t kFrameNum = 8;
constexpr uint32_t kFramesInFlight = 2;
const nrd::NrdImageState kAnyUse = {VK_IMAGE_LAYOUT_GENERAL, VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT,
                                    VK_PIPELINE_STAGE_ALL_COMMANDS_BIT};

using Texels = std::vector<float>; // four per pixel

// A wall seen by a camera that moves to the right, under noise that differs by frame.
Texels texelsOf(const std::string& slot, uint32_t frame, Size size)
{
    std::mt19937 random(static_cast<uint32_t>(std::hash<std::string>{}(slot)) + frame);
    Texels result(size_t(size.width) * size.height * 4, 0.0f);
    for (size_t i = 0; i < result.size(); i += 4)
    {
        float* const texel = result.data() + i;
        const float value = static_cast<float>(random() % 1024) / 1024.0f;
        if (slot == "IN_VIEWZ")
            texel[0] = kDepth;
        else if (slot == "IN_NORMAL_ROUGHNESS")
            texel[2] = -1.0f, texel[3] = 0.5f;
        else if (slot == "IN_MV")
            texel[0] = 0.5f * kStep / kDepth; // 45 degrees to each side
        else if (slot == "IN_PENUMBRA")
            texel[0] = value < 0.5f ? 0.0f : value < 0.75f ? 0.1f : 65504.0f;
        else
            texel[0] = texel[1] = value, texel[2] = 1.0f - value, texel[3] = 0.5f;
    }
    return result;
}

// The sizes of a run of frames: one, then another.
struct Sizes
{
    Size first;
    Size second;
    uint32_t changeFrame = kFrameNum; // first of the second size

    Size of(uint32_t frame) const { return frame < changeFrame ? first : second; }
    bool isFirst(uint32_t frame) const { return frame == 0 || frame == changeFrame; }
};

// One denoiser's images in the order of the array.
struct DenoiserImages
{
    DenoiserImages(Gpu& gpu, uint32_t index, Size imageSize) : denoiser(index), size(imageSize)
    {
        uint32_t imageNum = 0;
        REQUIRE(NrdPluginGetImageNum(index, &imageNum) == NRD_PLUGIN_SUCCESS);
        list.resize(imageNum);
        for (uint32_t i = 0; i < imageNum; i++)
        {
            NrdPluginImageInfo info = {};
            info.structSize = sizeof(info);
            REQUIRE(NrdPluginGetImageInfo(index, i, &info) == NRD_PLUGIN_SUCCESS);
            if (!info.isRequired) continue;
            EngineImage& image = images.emplace_back(gpu, rhi::Format::RGBA32_SFLOAT, size.width, size.height);
            names.push_back(info.name);
            list[i] = {image.entry.image, image.entry.format, size.width, size.height, kAnyUse.layout};
        }
    }

    bool isOutput(size_t i) const { return names[i].rfind("OUT_", 0) == 0; }
    // Inputs of the frame, outputs in the first; everything in the state in which events find it.
    void upload(rhi::CommandBuffer& commands, uint32_t frame, bool isFirst)
    {
        for (size_t i = 0; i < images.size(); i++)
        {
            if (!isOutput(i) || isFirst) images[i].upload(commands, texelsOf(names[i], frame, size).data());
            images[i].transition(commands, kAnyUse);
        }
    }
    void download(rhi::CommandBuffer& commands)
    {
        for (size_t i = 0; i < images.size(); i++)
            if (isOutput(i)) images[i].download(commands);
    }
    Texels outputs() const
    {
        Texels result;
        for (size_t i = 0; i < images.size(); i++)
        {
            if (!isOutput(i)) continue;
            const Texels texels = images[i].texels<float>();
            result.insert(result.end(), texels.begin(), texels.end());
        }
        return result;
    }

    uint32_t denoiser;
    Size size;
    std::vector<NrdPluginImage> list;
    std::vector<std::string> names; // of those that are there
    std::deque<EngineImage> images;
};

using Pictures = std::vector<Texels>; // one per frame

struct PluginEngine
{
    PluginEngine(Gpu& engineGpu, const std::vector<uint32_t>& denoisers, const Sizes& frameSizes)
        : gpu(engineGpu), sizes(frameSizes), frames(engineGpu, 1)
    {
        const nrd::NativeDevice native = gpu.native();
        NrdPluginDevice device = {};
        device.structSize = sizeof(device);
        device.queueFamilyIndex = native.queueFamilyIndex;
        device.instance = native.instance;
        device.physicalDevice = native.physicalDevice;
        device.device = native.device;
        device.getInstanceProcAddr = native.getInstanceProcAddr;
        device.getCommandBuffer = [](void* self) { return static_cast<PluginEngine*>(self)->current; };
        device.userArg = this;
        device.framesInFlight = kFramesInFlight;
        device.isSynchronization2Enabled = native.isSynchronization2Enabled;
        device.isDebugUtilsEnabled = native.isDebugUtilsEnabled;
        require(NrdPluginSetDevice(&device));
        for (const uint32_t denoiser : denoisers)
        {
            images.emplace_back(gpu, denoiser, sizes.first);
            imagesOfSecondSize.emplace_back(gpu, denoiser, sizes.second);
        }
        initialize(images);
        require(NrdPluginGetEventCallback(&callback));
    }
    ~PluginEngine()
    {
        frames.wait();
        (void)NrdPluginReleaseAll();
    }

    static void require(NrdPluginResult result)
    {
        if (result != NRD_PLUGIN_SUCCESS) throw std::runtime_error(NrdPluginGetLastMessage());
    }
    static void initialize(const std::deque<DenoiserImages>& denoisers)
    {
        for (const DenoiserImages& one : denoisers)
            require(NrdPluginInitialize(one.denoiser, one.list.data(), static_cast<uint32_t>(one.list.size())));
    }
    void setFrame(uint32_t frame) const
    {
        if (frame == sizes.changeFrame) initialize(imagesOfSecondSize);
        const NrdPluginFrame description = pluginFrame(frame);
        require(NrdPluginSetFrame(&description));
    }
    // On the render thread.
    void render(uint32_t frame)
    {
        std::deque<DenoiserImages>& own = frame < sizes.changeFrame ? images : imagesOfSecondSize;
        rhi::CommandBuffer& commands = frames.begin();
        for (DenoiserImages& one : own) one.upload(commands, frame, sizes.isFirst(frame));
        current = rhi::vulkanCommandBuffer(commands);
        for (DenoiserImages& one : own) callback(NrdPluginGetEventId(one.denoiser, kFirstFrame + frame));
        for (DenoiserImages& one : own) one.download(commands);
        frames.end();
        frames.wait(); // one upload buffer per image
        for (const DenoiserImages& one : own) pictures[one.denoiser].push_back(one.outputs());
    }

    Gpu& gpu;
    Sizes sizes;
    FrameRing frames;
    std::deque<DenoiserImages> images, imagesOfSecondSize;
    NrdPluginEventCallback callback = nullptr;
    VkCommandBuffer current = VK_NULL_HANDLE;
    std::map<uint32_t, Pictures> pictures; // by denoiser
};

Pictures denoiseDirectly(Gpu& gpu, uint32_t index, const Sizes& sizes)
{
    const auto denoiser = static_cast<nrd::Denoiser>(index);
    const nrd::DenoiserDesc denoiserDesc = {0, denoiser};
    nrd::IntegrationCreationDesc desc = integrationDesc(denoiser);
    desc.native = gpu.native();
    desc.framesInFlight = kFramesInFlight;
    nrd::NrdIntegration integration;
    require(integration.Create(desc, instanceDesc(denoiserDesc)), integration);
    std::deque<DenoiserImages> images;
    nrd::NrdUserPool pool;
    FrameRing frames(gpu, 1);
    Pictures result;
    for (uint32_t frame = 0; frame < kFrameNum; frame++)
    {
        if (sizes.isFirst(frame)) pool = userPool(denoiser, images.emplace_back(gpu, index, sizes.of(frame)).list);
        const DirectFrame direct = directFrame(frame, sizes.of(frame), sizes.of(frame == 0 ? 0 : frame - 1));
        rhi::CommandBuffer& commands = frames.begin();
        images.back().upload(commands, frame, sizes.isFirst(frame));
        require(denoise(integration, denoiser, direct, rhi::vulkanCommandBuffer(commands), pool), integration);
        images.back().download(commands);
        frames.end();
        frames.wait();
        result.push_back(images.back().outputs());
    }
    return result;
}
} // namespace

TEST_CASE("a plug-in driven by a thread three frames behind gives NrdIntegration's pictures", "[gpu]")
{
    // Of one size, or of another from frame 5 on.
    const Sizes sizes = GENERATE(Sizes{}, Sizes{{}, {kWidth + 13, kHeight - 7}, 5});
    const std::vector<uint32_t> denoisers = {NRD_PLUGIN_REBLUR_DIFFUSE, NRD_PLUGIN_RELAX_SPECULAR,
                                             NRD_PLUGIN_SIGMA_SHADOW, NRD_PLUGIN_REFERENCE};
    Gpu gpu;
    std::map<uint32_t, Pictures> pictures;
    {
        PluginEngine plugin(gpu, denoisers, sizes);
        ThreadedEngine engine;
        engine.run(
            kFrameNum, [&](uint32_t frame) { plugin.setFrame(frame); }, [&](uint32_t frame) { plugin.render(frame); });
        CHECK(engine.greatestLag() == 3);
        pictures = plugin.pictures;
    }
    for (const uint32_t denoiser : denoisers)
    {
        INFO("denoiser " << denoiser);
        const Pictures expected = denoiseDirectly(gpu, denoiser, sizes);
        REQUIRE(pictures[denoiser].size() == kFrameNum);
        for (uint32_t frame = 0; frame < kFrameNum; frame++)
        {
            INFO("frame " << frame);
            const Texels& found = pictures[denoiser][frame];
            REQUIRE(found.size() == expected[frame].size());
            CHECK(std::memcmp(found.data(), expected[frame].data(), found.size() * sizeof(float)) == 0);
        }
        CHECK(expected.front() != expected.back()); // something happens
    }
    gpu.finish();
}
