// DumpInputs() over a room whose inputs are known: the capture says what the application meant, and a replay of it
// shows the application's picture.
#include "gpu_fixture.h"
#include "replay_gpu.h"
#include "room.h"
#include <cmath>
#include <fstream>
#include <glm/gtc/packing.hpp>
#include <sstream>

namespace fs = std::filesystem;
using nrd::ResourceType;
using sample::Channel;
using test::require;

namespace
{
constexpr uint32_t kWidth = 96, kHeight = 64;
constexpr uint32_t kFramesInFlight = 2;
constexpr nrd::Identifier kDenoiser = 0;
constexpr nrd::HitDistanceParameters kHitDistance = {6.0f, 0.1f, 20.0f}; // the room's

fs::path emptyFolder(const char* name)
{
    const fs::path folder = fs::path(NRD_OUTPUT) / name;
    fs::remove_all(folder);
    return folder;
}

std::vector<uint64_t> toHalves(const test::Texels& texels)
{
    std::vector<uint64_t> result;
    for (size_t i = 0; i < texels.size(); i += 4)
        result.push_back(glm::packHalf4x16({texels[i], texels[i + 1], texels[i + 2], texels[i + 3]}));
    return result;
}

std::vector<uint32_t> toGuides(const test::Texels& texels)
{
    std::vector<uint32_t> result;
    for (size_t i = 0; i < texels.size(); i += 4)
    {
        uint32_t texel = 2u << 30; // material 2
        for (uint32_t c = 0; c < 3; c++)
            texel |= static_cast<uint32_t>(std::lround(texels[i + c] * 1023.0f)) << (10 * c);
        result.push_back(texel);
    }
    return result;
}

// An application with images in the formats that the replay tool has too.
class Engine
{
public:
    explicit Engine(nrd::LayoutPolicy policy = nrd::LayoutPolicy::OPTIMAL)
    {
        add(ResourceType::IN_VIEWZ, rhi::Format::RGBA32_SFLOAT);
        add(ResourceType::IN_MV, rhi::Format::RGBA32_SFLOAT);
        add(ResourceType::IN_NORMAL_ROUGHNESS, rhi::Format::A2B10G10R10_UNORM_PACK32);
        for (const ResourceType slot :
             {ResourceType::IN_DIFF_RADIANCE_HITDIST, ResourceType::IN_SPEC_RADIANCE_HITDIST,
              ResourceType::OUT_DIFF_RADIANCE_HITDIST, ResourceType::OUT_SPEC_RADIANCE_HITDIST})
            add(slot, rhi::Format::RGBA16_SFLOAT);
        nrd::IntegrationCreationDesc desc;
        desc.native = gpu.native();
        desc.resourceWidth = kWidth;
        desc.resourceHeight = kHeight;
        desc.framesInFlight = kFramesInFlight;
        desc.layoutPolicy = policy;
        const nrd::DenoiserDesc denoiser = {kDenoiser, nrd::Denoiser::REBLUR_DIFFUSE_SPECULAR};
        nrd::InstanceCreationDesc instance;
        instance.denoisers = &denoiser;
        instance.denoisersNum = 1;
        instance.messageSink = {[](void* text, nrd::Result, const char* sentence)
                                { *static_cast<std::string*>(text) = sentence; },
                                &message};
        require(integration.Create(desc, instance), integration);
        set({});
    }
    ~Engine() { ring.wait(); }

    void set(nrd::ReblurSettings settings)
    {
        settings.hitDistanceParameters = kHitDistance;
        require(integration.SetDenoiserSettings(kDenoiser, settings), integration);
    }

    void runFrame(const test::FrameInputs& frame, const nrd::DenoiseOptions& options = {})
    {
        ring.wait(); // the upload buffers are one
        rhi::CommandBuffer& commands = ring.begin();
        require(integration.NewFrame(), integration);
        require(integration.SetCommonSettings(frame.common), integration);
        upload(commands, frame);
        nrd::NrdUserPool pool;
        for (auto& [slot, image] : images) pool[slot] = image.entry;
        require(integration.Denoise(rhi::vulkanCommandBuffer(commands), &kDenoiser, 1, pool, options), integration);
        for (auto& [slot, image] : images)
        {
            if (options.restoreInitialStates && image.entry.state.layout != VK_IMAGE_LAYOUT_UNDEFINED)
                CHECK(image.entry.state == pool[slot].state);
            image.entry.state = pool[slot].state;
        }
        images.at(ResourceType::OUT_DIFF_RADIANCE_HITDIST).download(commands);
        images.at(ResourceType::OUT_SPEC_RADIANCE_HITDIST).download(commands);
        ring.end();
    }

    // The device is done with the frame.
    std::vector<glm::vec4> output(ResourceType slot)
    {
        ring.wait();
        std::vector<glm::vec4> result;
        for (const uint64_t texel : images.at(slot).texels<uint64_t>())
        {
            const glm::vec4 v = glm::unpackHalf4x16(texel);
            const float t = v.x - v.z;
            result.emplace_back(t + v.y, v.x + v.z, t - v.y, v.w);
        }
        return result;
    }

    test::Gpu gpu;
    test::FrameRing ring{gpu, kFramesInFlight};
    std::map<ResourceType, test::EngineImage> images;
    std::string message; // that the sink got last
    nrd::NrdIntegration integration;

private:
    void add(ResourceType slot, rhi::Format format)
    {
        images.emplace(std::piecewise_construct, std::forward_as_tuple(slot),
                       std::forward_as_tuple(gpu, format, kWidth, kHeight));
    }

    void upload(rhi::CommandBuffer& commands, const test::FrameInputs& frame)
    {
        images.at(ResourceType::IN_VIEWZ).upload(commands, frame.viewZ.data());
        images.at(ResourceType::IN_MV).upload(commands, frame.motion.data());
        images.at(ResourceType::IN_NORMAL_ROUGHNESS).upload(commands, toGuides(frame.normalRoughness).data());
        images.at(ResourceType::IN_DIFF_RADIANCE_HITDIST).upload(commands, toHalves(frame.diffuse).data());
        images.at(ResourceType::IN_SPEC_RADIANCE_HITDIST).upload(commands, toHalves(frame.specular).data());
    }
};

std::vector<test::FrameInputs> roomOnScreen(size_t count)
{
    std::vector<test::FrameInputs> frames = test::makeRoom(count, kWidth, kHeight);
    for (test::FrameInputs& frame : frames) // depths become those of pixel centres, from where motion is counted
        for (float* jitter : {frame.common.cameraJitter, frame.common.cameraJitterPrev}) jitter[0] = jitter[1] = 0.0f;
    test::toScreenMotion(frames);
    return frames;
}

// Largest difference of a channel from component c of what was packed, but for rays that hit nothing in range.
double largestError(const sample::Planes& planes, Channel channel, const test::Texels& expected, size_t c)
{
    double error = 0.0;
    for (size_t i = 0; i < planes.pixelCount(); i++)
        if (planes[channel][i] != sample::kHitDistMiss)
            error = std::fmax(error, std::fabs(double(planes[channel][i]) - double(expected[i * 4 + c])));
    return error;
}

void checkFrame(const sample::Planes& planes, const test::FrameInputs& frame)
{
    CHECK(largestError(planes, Channel::ViewZ, frame.viewZ, 0) == 0.0);
    for (int c = 0; c < 3; c++)
    {
        CHECK(largestError(planes, sample::next(Channel::NormalX, c), frame.guides, size_t(c)) < 0.004); // 10 bits
        CHECK(largestError(planes, sample::next(Channel::DiffuseR, c), frame.diffuseSignal, size_t(c)) < 0.002);
        CHECK(largestError(planes, sample::next(Channel::SpecularR, c), frame.specularSignal, size_t(c)) < 0.002);
        for (const float motion : planes[sample::next(Channel::MotionX, c)]) REQUIRE(std::fabs(motion) < 1e-4f);
    }
    CHECK(largestError(planes, Channel::Roughness, frame.guides, 3) < 0.002);
    CHECK(largestError(planes, Channel::DiffuseHitDist, frame.diffuseSignal, 3) < 0.01);
    CHECK(largestError(planes, Channel::SpecularHitDist, frame.specularSignal, 3) < 0.05); // ranges to 60
    for (const float material : planes[Channel::MaterialId]) REQUIRE(material == 2.0f);
}

double meanError(const std::vector<glm::vec4>& own, const sample::Picture& replayed)
{
    double error = 0.0, sum = 0.0;
    for (size_t i = 0; i < own.size(); i++)
        for (size_t c = 0; c < 3; c++)
        {
            error += std::fabs(double(own[i][int(c)]) - double(replayed.planes.at(c)[i]));
            sum += std::fabs(double(own[i][int(c)]));
        }
    return error / sum;
}

std::string textOf(const fs::path& file)
{
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}
} // namespace

TEST_CASE("a replay of what was dumped shows the application's picture", "[gpu]")
{
    const auto policy = GENERATE(nrd::LayoutPolicy::OPTIMAL, nrd::LayoutPolicy::GENERAL);
    constexpr uint32_t kFrames = 5;
    const fs::path folder = emptyFolder("room");
    const std::vector<test::FrameInputs> frames = roomOnScreen(kFrames);
    std::vector<glm::vec4> diffuse, specular;
    {
        Engine engine(policy);
        require(engine.integration.DumpInputs(folder.string().c_str(), kFrames), engine.integration);
        nrd::DenoiseOptions options;
        for (const test::FrameInputs& frame : frames)
        {
            options.restoreInitialStates = frame.common.frameIndex == 2; // copies may not show in them
            engine.runFrame(frame, options);
            const bool isSecondWritten = fs::exists(folder / "frame_0001.exr");
            CHECK(isSecondWritten == (frame.common.frameIndex >= 1 + kFramesInFlight)); // and nothing waits before
        }
        CHECK(engine.integration.IsDumping());
        diffuse = engine.output(ResourceType::OUT_DIFF_RADIANCE_HITDIST);
        specular = engine.output(ResourceType::OUT_SPEC_RADIANCE_HITDIST);
        engine.gpu.finish();
        engine.integration.Destroy(); // writes the rest
    }
    const sample::Capture capture = sample::Capture::open(folder);
    REQUIRE(capture.info().frames.size() == kFrames);
    sample::ReplayGpu replay({capture, *sample::findDenoiser("REBLUR_DIFFUSE_SPECULAR"), {}, {}, true});
    sample::ReplayedFrame last;
    for (uint32_t i = 0; i < kFrames; i++)
    {
        const sample::Planes planes = capture.readFrame(i);
        checkFrame(planes, frames[i]);
        last = replay.denoise(planes, i + 1 == kFrames);
    }
    CHECK(meanError(diffuse, last.signals[sample::Signal::Diffuse]) < 0.002);
    CHECK(meanError(specular, last.signals[sample::Signal::Specular]) < 0.002);
    CHECK(meanError(diffuse, last.signals[sample::Signal::Specular]) > 0.01); // the measure tells pictures apart
    CHECK(replay.validationMessageCount() == 0);
}

TEST_CASE("a dump ends after its frames, and costs nothing before and after", "[gpu]")
{
    const fs::path folder = emptyFolder("short");
    const std::vector<test::FrameInputs> frames = roomOnScreen(6);
    Engine engine;
    engine.runFrame(frames[0]);
    const uint64_t memory = engine.integration.GetMemoryStatistics().total;
    require(engine.integration.DumpInputs(folder.string().c_str(), 2), engine.integration);
    engine.runFrame(frames[1]);
    CHECK(engine.integration.GetMemoryStatistics().total > memory);
    for (size_t i = 2; i < 6; i++) engine.runFrame(frames[i]);
    CHECK_FALSE(engine.integration.IsDumping());
    CHECK(sample::Capture::open(folder).info().frames.size() == 2);
    CHECK(sample::Capture::open(folder).info().frames[0].isCut);
    require(engine.integration.DumpInputs(emptyFolder("next").string().c_str(), 1), engine.integration);
    engine.ring.wait();
    engine.gpu.finish();
}

TEST_CASE("what a capture cannot hold is noted in it", "[gpu]")
{
    const fs::path folder = emptyFolder("notes");
    std::vector<test::FrameInputs> frames = roomOnScreen(3);
    frames[0].viewZ[4 * 5] = std::nanf("");
    frames[1].diffuse[0] = std::nanf(""); // signals may hold it
    {
        Engine engine;
        require(engine.integration.DumpInputs(folder.string().c_str(), 9), engine.integration);
        engine.runFrame(frames[0]);
        engine.runFrame(frames[1]);
        nrd::ReblurSettings settings;
        settings.checkerboardMode = nrd::CheckerboardMode::BLACK;
        engine.set(settings);
        engine.runFrame(frames[2]);
        engine.gpu.finish();
        engine.integration.Destroy();
    }
    const sample::Capture capture = sample::Capture::open(folder);
    CHECK(capture.info().frames.size() == 2);
    CHECK(std::fabs(capture.readFrame(0)[Channel::ViewZ][5]) > 1000.0f); // as sky
    CHECK(std::isnan(capture.readFrame(1)[Channel::DiffuseR][0]));
    const std::string json = textOf(folder / "capture.json");
    CHECK_THAT(json, containing("frame 0: viewZ is not finite in 1 pixels, first (5; 0); written as"));
    CHECK_THAT(json, containing("checkerboardMode was on, whose signals a dump cannot unpack"));
}

TEST_CASE("a dump that cannot be is refused, and one that cannot be written harms no frame", "[gpu]")
{
    Engine engine;
    nrd::NrdIntegration& integration = engine.integration;
    test::requireRefusal(integration.DumpInputs("", 1), integration, "DumpInputs(): folder is empty");
    test::requireRefusal(integration.DumpInputs("/proc/nrd", 0), integration,
                         "DumpInputs(): frames is 0, must be in [1; 10000]");
    CHECK(integration.DumpInputs("/proc/nrd", 1) == nrd::Result::FAILURE);
    CHECK(integration.GetLastMessage() == std::string("DumpInputs(): the folder /proc/nrd cannot be created"));
    const fs::path folder = emptyFolder("gone");
    require(integration.DumpInputs(folder.string().c_str(), 3), integration);
    test::requireRefusal(integration.DumpInputs(folder.string().c_str(), 3), integration,
                         "DumpInputs(): the frames of an earlier call are not written yet");
    fs::remove_all(folder);
    for (const test::FrameInputs& frame : roomOnScreen(4)) engine.runFrame(frame);
    CHECK(engine.message == "DumpInputs(): " + (folder / "frame_0000.exr").string() + " cannot be written");
    CHECK_FALSE(integration.IsDumping());
    engine.gpu.finish();
}
