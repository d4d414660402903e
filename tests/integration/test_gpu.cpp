// The whole way on a device, with REFERENCE: its output is a mean that can be computed by hand.
#include "gpu_fixture.h"
#include <cmath>

using nrd::Denoiser;
using nrd::ResourceType;
using test::EngineImage;
using test::FrameRing;
using test::Gpu;
using test::require;

namespace
{
constexpr uint16_t kWidth = 37; // not a multiple of a group
constexpr uint16_t kHeight = 21;
constexpr nrd::Identifier kReference = 5;

using Texels = std::vector<float>; // four per pixel

// Another value for each texel, channel and frame.
Texels signalOf(uint32_t frame, size_t count = size_t(kWidth) * kHeight * 4)
{
    Texels result(count);
    for (size_t i = 0; i < count; i++)
        result[i] = static_cast<float>((i * 7 + frame * 13 + frame * frame * (i % 5)) % 101) * 0.25f;
    return result;
}

double largestError(const Texels& found, const std::vector<double>& expected)
{
    REQUIRE(found.size() == expected.size());
    double error = 0.0;
    for (size_t i = 0; i < found.size(); i++) error = std::fmax(error, std::fabs(found[i] - expected[i]));
    return error;
}

// The mean of the signals of the frames [0; frameCount).
std::vector<double> meanOf(uint32_t frameCount)
{
    std::vector<double> sum(size_t(kWidth) * kHeight * 4, 0.0);
    for (uint32_t frame = 0; frame < frameCount; frame++)
    {
        const Texels signal = signalOf(frame);
        for (size_t i = 0; i < sum.size(); i++) sum[i] += double(signal[i]) / frameCount;
    }
    return sum;
}

// 32-bit means of values below 26 over some frames: a few roundings of 2^-24 each.
constexpr double kRounding = 2e-5;

struct Engine
{
    explicit Engine(uint32_t framesInFlight = 2,
                    std::vector<nrd::DenoiserDesc> list = {{kReference, Denoiser::REFERENCE}})
        : frames(gpu, framesInFlight), denoisers(std::move(list))
    {
        desc.native = gpu.native();
        desc.resourceWidth = kWidth;
        desc.resourceHeight = kHeight;
        desc.framesInFlight = framesInFlight;
        instanceDesc.denoisers = denoisers.data();
        instanceDesc.denoisersNum = static_cast<uint32_t>(denoisers.size());
    }
    ~Engine() { frames.wait(); }

    void create() { require(integration.Create(desc, instanceDesc), integration); }
    rhi::CommandBuffer& beginFrame()
    {
        rhi::CommandBuffer& commands = frames.begin();
        require(integration.NewFrame(), integration);
        require(integration.SetCommonSettings(test::stillCamera(width, height, frameIndex++)), integration);
        return commands;
    }
    void denoise(rhi::CommandBuffer& commands, EngineImage& in, EngineImage& out,
                 const nrd::DenoiseOptions& options = {}, nrd::Identifier identifier = kReference)
    {
        nrd::NrdUserPool pool;
        pool[ResourceType::IN_SIGNAL] = in.entry;
        pool[ResourceType::OUT_SIGNAL] = out.entry;
        require(integration.Denoise(rhi::vulkanCommandBuffer(commands), &identifier, 1, pool, options), integration);
        in.entry.state = pool[ResourceType::IN_SIGNAL].state;
        out.entry.state = pool[ResourceType::OUT_SIGNAL].state;
    }
    EngineImage image() { return EngineImage(gpu, rhi::Format::RGBA32_SFLOAT, width, height); }

    Gpu gpu;
    FrameRing frames;
    std::vector<nrd::DenoiserDesc> denoisers;
    nrd::IntegrationCreationDesc desc;
    nrd::InstanceCreationDesc instanceDesc;
    nrd::NrdIntegration integration;
    uint16_t width = kWidth;
    uint16_t height = kHeight;
    uint32_t frameIndex = 0;
};
} // namespace

TEST_CASE("REFERENCE returns the mean of a known signal, so history survives frames", "[gpu]")
{
    const auto policy = GENERATE(nrd::LayoutPolicy::OPTIMAL, nrd::LayoutPolicy::GENERAL);
    const bool isSync2 = GENERATE(true, false);
    Engine engine;
    engine.desc.layoutPolicy = policy;
    engine.desc.native.isSynchronization2Enabled &= isSync2;
    engine.create();
    EngineImage in = engine.image();
    EngineImage out = engine.image();
    constexpr uint32_t kFrames = 9;
    for (uint32_t frame = 0; frame < kFrames; frame++)
    {
        rhi::CommandBuffer& commands = engine.beginFrame();
        engine.frames.wait(); // the upload buffer is one
        in.upload(commands, signalOf(frame).data());
        engine.denoise(commands, in, out);
        out.download(commands);
        engine.frames.end();
        engine.frames.wait();
        CHECK(largestError(out.texels<float>(), meanOf(frame + 1)) < kRounding);
    }
    engine.gpu.finish();
}

TEST_CASE("frames recorded before any of them runs have constants and descriptors of their own", "[gpu]")
{
    const uint32_t framesInFlight = GENERATE(1u, 2u, 3u, 4u);
    Engine engine(framesInFlight);
    engine.create();
    std::deque<EngineImage> in;
    std::deque<EngineImage> out;
    for (uint32_t i = 0; i < framesInFlight; i++)
    {
        in.push_back(engine.image());
        out.push_back(engine.image());
    }
    for (uint32_t round = 0; round < 3; round++)
    {
        for (uint32_t i = 0; i < framesInFlight; i++)
        {
            rhi::CommandBuffer& commands = engine.beginFrame();
            in[i].upload(commands, signalOf(round * framesInFlight + i).data());
            engine.denoise(commands, in[i], out[i]);
            out[i].download(commands);
            engine.frames.end(true); // held back
        }
        engine.frames.release();
        engine.frames.wait();
        for (uint32_t i = 0; i < framesInFlight; i++)
            CHECK(largestError(out[i].texels<float>(), meanOf(round * framesInFlight + i + 1)) < kRounding);
    }
    engine.gpu.finish();
}

TEST_CASE("one image may be signal and result", "[gpu]")
{
    Engine engine;
    engine.create();
    EngineImage image = engine.image();
    for (uint32_t frame = 0; frame < 4; frame++)
    {
        rhi::CommandBuffer& commands = engine.beginFrame();
        engine.frames.wait();
        image.upload(commands, signalOf(frame).data());
        nrd::NrdUserPool pool;
        pool[ResourceType::IN_SIGNAL] = pool[ResourceType::OUT_SIGNAL] = image.entry;
        require(engine.integration.Denoise(rhi::vulkanCommandBuffer(commands), &kReference, 1, pool),
                engine.integration);
        CHECK(pool[ResourceType::IN_SIGNAL].state == pool[ResourceType::OUT_SIGNAL].state);
        image.entry.state = pool[ResourceType::OUT_SIGNAL].state;
        image.download(commands);
        engine.frames.end();
        engine.frames.wait();
        CHECK(largestError(image.texels<float>(), meanOf(frame + 1)) < kRounding);
    }
    engine.gpu.finish();
}

TEST_CASE("restored images are in the states they came in, whatever those were", "[gpu]")
{
    const nrd::NrdImageState states[] = {
        {VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_ACCESS_TRANSFER_WRITE_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT},
        {VK_IMAGE_LAYOUT_GENERAL, VK_ACCESS_SHADER_WRITE_BIT, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT},
        {VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_ACCESS_SHADER_READ_BIT, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT},
        {VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_ACCESS_TRANSFER_READ_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT}};
    Engine engine;
    engine.desc.native.isSynchronization2Enabled &= GENERATE(true, false);
    engine.create();
    EngineImage in = engine.image();
    EngineImage out = engine.image();
    nrd::DenoiseOptions options;
    options.restoreInitialStates = true;
    for (uint32_t frame = 0; frame < std::size(states); frame++)
    {
        rhi::CommandBuffer& commands = engine.beginFrame();
        engine.frames.wait();
        in.upload(commands, signalOf(frame).data());
        in.transition(commands, states[frame]);
        out.transition(commands, states[(frame + 1) % std::size(states)]);
        const nrd::NrdImageState left = out.entry.state;
        engine.denoise(commands, in, out, options);
        CHECK(in.entry.state == states[frame]);
        CHECK(out.entry.state == left);
        out.download(commands);
        engine.frames.end();
        engine.frames.wait();
        CHECK(largestError(out.texels<float>(), meanOf(frame + 1)) < kRounding);
    }
    engine.gpu.finish();
}

TEST_CASE("two calls in a frame leave each other's history alone", "[gpu]")
{
    Engine engine(2, {{kReference, Denoiser::REFERENCE}, {6, Denoiser::REFERENCE}});
    engine.create();
    nrd::ReferenceSettings latest;
    latest.maxAccumulatedFrameNum = 0; // the mean of one frame
    require(engine.integration.SetDenoiserSettings(6, latest), engine.integration);
    EngineImage in = engine.image();
    EngineImage mean = engine.image();
    EngineImage copy = engine.image();
    for (uint32_t frame = 0; frame < 5; frame++)
    {
        rhi::CommandBuffer& commands = engine.beginFrame();
        engine.frames.wait();
        in.upload(commands, signalOf(frame).data());
        engine.denoise(commands, in, mean);
        engine.denoise(commands, in, copy, {}, 6);
        mean.download(commands);
        copy.download(commands);
        engine.frames.end();
        engine.frames.wait();
        CHECK(largestError(mean.texels<float>(), meanOf(frame + 1)) < kRounding);
        CHECK(copy.texels<float>() == signalOf(frame));
    }
    engine.gpu.finish();
}

TEST_CASE("resizing each of 100 frames neither grows nor waits", "[gpu]")
{
    Engine engine(3);
    engine.create();
    std::deque<EngineImage> images; // the engine defers its own destruction as well
    uint64_t memory = 0;
    uint32_t cached = 0;
    for (uint32_t frame = 0; frame < 100; frame++)
    {
        engine.width = static_cast<uint16_t>(kWidth + frame % 4);
        engine.height = static_cast<uint16_t>(kHeight + frame % 3);
        rhi::CommandBuffer& commands = engine.frames.begin();
        if (images.size() >= 2 * 4) images.erase(images.begin(), images.begin() + 2); // used four frames ago
        require(engine.integration.Resize(engine.width, engine.height), engine.integration);
        require(engine.integration.NewFrame(), engine.integration);
        require(engine.integration.SetCommonSettings(test::stillCamera(engine.width, engine.height, frame)),
                engine.integration);
        images.push_back(engine.image());
        EngineImage& in = images.back();
        images.push_back(engine.image());
        EngineImage& out = images.back();
        const Texels signal = signalOf(frame, size_t(engine.width) * engine.height * 4);
        in.upload(commands, signal.data());
        engine.denoise(commands, in, out);
        out.download(commands);
        engine.frames.end();
        if (frame % 10 == 9)
        {
            engine.frames.wait();
            CHECK(out.texels<float>() == signal); // history is lost: the mean of one frame
        }
        if (frame == 48)
        {
            memory = engine.integration.GetMemoryStatistics().total;
            cached = engine.integration.GetStatistics().cachedUserImages;
        }
    }
    CHECK(engine.integration.GetMemoryStatistics().total <= memory * 5 / 4); // of sizes that differ by a tenth
    CHECK(engine.integration.GetStatistics().cachedUserImages <= cached);
    engine.gpu.finish();
}

TEST_CASE("an image re-created under the same handle is not mistaken for the old one", "[gpu]")
{
    Engine engine(1);
    engine.create();
    EngineImage out = engine.image();
    for (uint32_t frame = 0; frame < 6; frame++)
    {
        rhi::CommandBuffer& commands = engine.beginFrame();
        EngineImage in = engine.image(); // drivers like to give the same handle again
        in.upload(commands, signalOf(frame).data());
        engine.denoise(commands, in, out);
        out.download(commands);
        engine.frames.end();
        engine.frames.wait();
        CHECK(largestError(out.texels<float>(), meanOf(frame + 1)) < kRounding);
        if (frame % 2) require(engine.integration.Forget(in.entry.image), engine.integration);
    }
    engine.gpu.finish();
}

TEST_CASE("an image without storage usage is refused with its name, and validation has nothing to say", "[gpu]")
{
    Engine engine;
    engine.create();
    EngineImage in(engine.gpu, rhi::Format::RGBA32_SFLOAT, kWidth, kHeight, rhi::TextureUsage::Sampled);
    EngineImage out(engine.gpu, rhi::Format::RGBA32_SFLOAT, kWidth, kHeight, rhi::TextureUsage::Sampled);
    rhi::CommandBuffer& commands = engine.beginFrame();
    nrd::NrdUserPool pool;
    pool[ResourceType::IN_SIGNAL] = in.entry;
    pool[ResourceType::OUT_SIGNAL] = out.entry;
    test::requireRefusal(engine.integration.Denoise(rhi::vulkanCommandBuffer(commands), &kReference, 1, pool),
                         engine.integration,
                         "OUT_SIGNAL: the image was created without VK_IMAGE_USAGE_STORAGE_BIT, which this slot needs");
    engine.frames.end();
    engine.gpu.finish();
}

TEST_CASE("passes are timed on the device", "[gpu]")
{
    Engine engine(2);
    engine.desc.isGpuTimingEnabled = true;
    engine.create();
    if (engine.gpu.device().limits().timestampValidBits == 0) return;
    EngineImage in = engine.image();
    EngineImage out = engine.image();
    for (uint32_t frame = 0; frame < 5; frame++)
    {
        rhi::CommandBuffer& commands = engine.beginFrame();
        if (frame == 0) in.upload(commands, signalOf(0).data());
        engine.denoise(commands, in, out);
        engine.frames.end();
    }
    const nrd::Timings timings = engine.integration.GetTimings();
    CHECK(timings.frame == 3);
    REQUIRE(timings.passesNum == 2);
    CHECK(timings.passes[1].name == std::string("REFERENCE - Copy"));
    CHECK(timings.totalMilliseconds > 0.0f);
    CHECK(timings.totalMilliseconds < 1000.0f);
    engine.gpu.finish();
}

TEST_CASE("the memory report agrees with what a device must give for the pools", "[gpu]")
{
    Engine engine;
    engine.create();
    const nrd::MemoryStatistics memory = engine.integration.GetMemoryStatistics();
    CHECK(memory.permanent >= uint64_t(kWidth) * kHeight * 16); // the mean
    CHECK(memory.permanent < uint64_t(kWidth) * kHeight * 16 + (1u << 20));
    CHECK(memory.total >= memory.permanent + memory.transient);
    engine.gpu.finish();
}

TEST_CASE("the features asked for before there is a device are those it was made with", "[gpu]")
{
    const nrd::RequiredDeviceFeatures features = nrd::GetRequiredDeviceFeatures();
    CHECK(features.apiVersion >= VK_API_VERSION_1_1);
    CHECK(features.features.shaderStorageImageWriteWithoutFormat == VK_TRUE);
    CHECK(features.features.shaderStorageImageReadWithoutFormat == VK_FALSE);
    Engine engine;
    VkPhysicalDeviceFeatures enabled = features.features;
    engine.desc.native.enabledFeatures = &enabled;
    engine.create();
    engine.integration.Destroy();
    enabled.shaderStorageImageWriteWithoutFormat = VK_FALSE;
    CHECK(engine.integration.Create(engine.desc, engine.instanceDesc) == nrd::Result::UNSUPPORTED);
    CHECK(std::string(engine.integration.GetLastMessage()).find("shaderStorageImageWriteWithoutFormat") !=
          std::string::npos);
}
