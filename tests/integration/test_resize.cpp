// Another resource size: what lives on, what goes when, and that the picture does not begin anew.
#include "gpu_fixture.h"
#include "recording_fixture.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

using nrd::Denoiser;
using nrd::ResourceType;
using rhi::CallType;
using test::EngineImage;
using test::RecordingFixture;
using test::require;

namespace
{
constexpr nrd::Identifier kIdentifier = 5;

struct Size
{
    uint16_t width, height;
};

void resize(RecordingFixture& f, Size size)
{
    require(f.integration.Resize(size.width, size.height), f.integration);
    f.width = size.width;
    f.height = size.height;
    f.fillReblurSlots();
    f.pool[ResourceType::IN_SIGNAL] = f.image(0x100);
    f.pool[ResourceType::OUT_SIGNAL] = f.image(0x200);
}

bool isDestroyed(const RecordingFixture& f, const std::string& name)
{
    const std::vector<rhi::RecordedCall> calls = f.calls(CallType::Destroy);
    return std::any_of(calls.begin(), calls.end(), [&](const rhi::RecordedCall& call) { return call.name == name; });
}

uint32_t movesOf(const RecordingFixture& f)
{
    uint32_t result = 0;
    for (const rhi::RecordedCall& call : f.calls(CallType::BindPipeline))
        result += call.name.find("MoveHistory") != std::string::npos;
    return result;
}

// A wall that faces the camera with noise on it, brighter on one side, at one size.
struct Wall
{
    Wall(test::Gpu& gpu, Size imageSize, bool isRelax) : size(imageSize)
    {
        add(gpu, ResourceType::IN_MV, rhi::Format::RGBA16_SFLOAT);
        add(gpu, ResourceType::IN_NORMAL_ROUGHNESS, rhi::Format::A2B10G10R10_UNORM_PACK32);
        add(gpu, ResourceType::IN_VIEWZ, rhi::Format::R32_SFLOAT);
        add(gpu, ResourceType::IN_DIFF_RADIANCE_HITDIST, rhi::Format::RGBA32_SFLOAT);
        add(gpu, ResourceType::OUT_DIFF_RADIANCE_HITDIST, rhi::Format::RGBA32_SFLOAT);
        m_hitDistance = isRelax ? 10.0f : 0.5f;
    }

    float truthAt(size_t pixel) const { return pixel % size.width < size.width / 2u ? 0.25f : 1.0f; }

    void upload(rhi::CommandBuffer& commands, uint32_t seed)
    {
        const size_t pixels = size_t(size.width) * size.height;
        const std::vector<uint64_t> motion(pixels, 0);
        const std::vector<uint32_t> guide(pixels, 512u | 512u << 10 | 256u << 20); // normal -z
        const std::vector<float> viewZ(pixels, 5.0f);
        std::vector<float> radiance(pixels * 4, 0.0f); // Y, Co, Cg, hit distance; grey is the same in red, green, blue
        for (size_t i = 0; i < pixels; i++)
        {
            const uint32_t hash = (static_cast<uint32_t>(i) * 2654435761u + seed * 40503u) * 2246822519u;
            radiance[i * 4] = truthAt(i) * 2.0f * static_cast<float>(hash >> 8) / 16777216.0f;
            radiance[i * 4 + 3] = m_hitDistance;
            if (m_hitDistance > 1.0f) radiance[i * 4 + 1] = radiance[i * 4 + 2] = radiance[i * 4];
        }
        const void* const bytes[] = {motion.data(), guide.data(), viewZ.data(), radiance.data()};
        for (size_t i = 0; i < std::size(bytes); i++) images[i]->upload(commands, bytes[i]);
    }

    void denoise(nrd::NrdIntegration& integration, rhi::CommandBuffer& commands)
    {
        nrd::NrdUserPool pool;
        for (size_t i = 0; i < images.size(); i++) pool[slots[i]] = images[i]->entry;
        require(integration.Denoise(rhi::vulkanCommandBuffer(commands), &kIdentifier, 1, pool), integration);
        for (size_t i = 0; i < images.size(); i++) images[i]->entry.state = pool[slots[i]].state;
        images.back()->download(commands);
    }

    // Root mean square of the picture against the truth, away from the step in it.
    double error() const
    {
        const std::vector<float> texels = images.back()->texels<float>();
        double sum = 0.0;
        size_t count = 0;
        for (size_t i = 0; i < texels.size() / 4; i++)
        {
            const size_t x = i % size.width;
            if (x + 6u > size.width / 2u && x < size.width / 2u + 6u) continue;
            const double difference = texels[i * 4] - truthAt(i);
            sum += difference * difference;
            count++;
        }
        return std::sqrt(sum / static_cast<double>(count));
    }
    // What REBLUR writes there on request.
    std::vector<float> historyLengths() const
    {
        std::vector<float> result;
        const std::vector<float> texels = images.back()->texels<float>();
        for (size_t i = 3; i < texels.size(); i += 4) result.push_back(texels[i]);
        return result;
    }

    Size size;
    std::vector<ResourceType> slots;
    std::vector<std::unique_ptr<EngineImage>> images; // the output comes last

private:
    void add(test::Gpu& gpu, ResourceType slot, rhi::Format format)
    {
        slots.push_back(slot);
        images.push_back(std::make_unique<EngineImage>(gpu, format, size.width, size.height));
    }
    float m_hitDistance = 0.0f;
};

// Frames of a still camera, with a change of size between two of them.
class Engine
{
public:
    Engine(Denoiser denoiser, Size from, uint32_t framesInFlight, nrd::LayoutPolicy policy = {})
        : m_frames(m_gpu, framesInFlight), m_isRelax(denoiser == Denoiser::RELAX_DIFFUSE), m_last(from)
    {
        const nrd::DenoiserDesc denoiserDesc = {kIdentifier, denoiser};
        nrd::InstanceCreationDesc instanceDesc;
        instanceDesc.denoisers = &denoiserDesc;
        instanceDesc.denoisersNum = 1;
        nrd::IntegrationCreationDesc desc;
        desc.native = m_gpu.native();
        desc.layoutPolicy = policy;
        desc.resourceWidth = from.width;
        desc.resourceHeight = from.height;
        desc.framesInFlight = framesInFlight;
        require(integration.Create(desc, instanceDesc), integration);
        if (!m_isRelax)
        {
            nrd::ReblurSettings settings;
            settings.returnHistoryLengthInsteadOfOcclusion = true;
            require(integration.SetDenoiserSettings(kIdentifier, settings), integration);
        }
        m_walls.push_back(std::make_unique<Wall>(m_gpu, from, m_isRelax));
    }
    ~Engine() { m_frames.wait(); }

    void resize(Size to)
    {
        require(integration.Resize(to.width, to.height), integration);
        m_walls.push_back(std::make_unique<Wall>(m_gpu, to, m_isRelax)); // the old images go with the engine
    }

    void runFrames(uint32_t count, bool isContinued = true)
    {
        for (uint32_t i = 0; i < count; i++)
        {
            rhi::CommandBuffer& commands = m_frames.begin();
            require(integration.NewFrame(), integration);
            const Size size = wall().size;
            nrd::CommonSettings settings = test::stillCamera(size.width, size.height, m_frameIndex);
            const uint16_t last[] = {m_last.width, m_last.height};
            for (uint16_t* previous : {settings.resourceSizePrev, settings.rectSizePrev})
                if (isContinued) std::copy_n(last, 2, previous);
            require(integration.SetCommonSettings(settings), integration);
            wall().upload(commands, m_frameIndex++);
            wall().denoise(integration, commands);
            m_frames.end();
            m_last = size;
        }
    }

    Wall& wall() { return *m_walls.back(); }
    void finish()
    {
        m_frames.wait();
        m_gpu.finish();
    }

private:
    test::Gpu m_gpu;
    test::FrameRing m_frames;
    std::vector<std::unique_ptr<Wall>> m_walls;
    bool m_isRelax;
    uint32_t m_frameIndex = 0;
    Size m_last;

public:
    nrd::NrdIntegration integration;
};
} // namespace

TEST_CASE("the first picture after a resize has the history of those before", "[gpu]")
{
    const Denoiser denoiser = GENERATE(Denoiser::REBLUR_DIFFUSE, Denoiser::RELAX_DIFFUSE);
    const Size to = GENERATE(Size{96, 70}, Size{50, 34}, Size{49, 80});
    constexpr Size kFrom = {72, 48};
    INFO(nrd::toString(denoiser) << " from 72 x 48 to " << to.width << " x " << to.height);
    const auto errorAfter = [&](bool isContinued)
    {
        Engine engine(denoiser, kFrom, 2);
        engine.runFrames(16);
        engine.finish();
        const double before = engine.wall().error();
        engine.resize(to);
        engine.runFrames(1, isContinued);
        engine.finish();
        return std::array{before, engine.wall().error()};
    };
    const auto [before, continued] = errorAfter(true);
    const double restarted = errorAfter(false)[1];
    INFO("error " << before << " before, " << continued << " with history, " << restarted << " without");
    CHECK(continued < 0.7 * restarted);
    CHECK(continued < 1.25 * before);
}

TEST_CASE("a history keeps its length across sizes, also of several resizes in a row", "[gpu]")
{
    Engine engine(Denoiser::REBLUR_DIFFUSE, {72, 48}, 3,
                  GENERATE(nrd::LayoutPolicy::OPTIMAL, nrd::LayoutPolicy::GENERAL));
    engine.runFrames(10);
    engine.resize({33, 20});
    engine.resize({90, 64}); // no frame came in between
    engine.runFrames(1);
    engine.finish();
    // Between texels, and at the edge of the screen, a frame or two may be lost.
    for (const float length : engine.wall().historyLengths()) REQUIRE(length > 0.8f * 10);
    for (const Size size : {Size{40, 64}, Size{41, 30}, Size{90, 64}})
    {
        engine.resize(size);
        engine.runFrames(1);
    }
    engine.finish();
    std::vector<float> lengths = engine.wall().historyLengths();
    std::sort(lengths.begin(), lengths.end());
    CHECK(lengths[0] > 0.6f * 13);
    CHECK(lengths[lengths.size() / 2] > 0.9f * 13);
}

TEST_CASE("what a resize replaces lives until its history has moved and the GPU is done with it", "[unit]")
{
    RecordingFixture f({{3, Denoiser::REBLUR_DIFFUSE_SPECULAR}});
    f.desc.framesInFlight = GENERATE(1u, 3u);
    f.fillReblurSlots();
    f.requireCreated();
    f.beginFrame();
    require(f.denoise({3}), f.integration);
    resize(f, {32, 32});
    for (uint32_t frame = 1; frame < f.desc.framesInFlight; frame++) require(f.integration.NewFrame(), f.integration);
    CHECK_FALSE(isDestroyed(f, "NRD T(0)"));
    require(f.integration.NewFrame(), f.integration);
    CHECK(isDestroyed(f, "NRD T(0)")); // scratch has nothing to keep
    for (uint32_t frame = 0; frame < 5; frame++) require(f.integration.NewFrame(), f.integration);
    CHECK_FALSE(isDestroyed(f, "NRD P(0)")); // nobody has denoised yet
    f.beginFrame();
    require(f.denoise({3}), f.integration);
    for (uint32_t frame = 0; frame < f.desc.framesInFlight; frame++)
    {
        CHECK_FALSE(isDestroyed(f, "NRD P(0)"));
        f.beginFrame();
    }
    CHECK(isDestroyed(f, "NRD P(0)"));
}

TEST_CASE("history moves once, with the first dispatches that are recorded", "[unit]")
{
    RecordingFixture f({{3, Denoiser::REBLUR_DIFFUSE_SPECULAR}, {4, Denoiser::SIGMA_SHADOW}});
    f.desc.framesInFlight = 2;
    f.fillReblurSlots();
    f.requireCreated();
    f.beginFrame();
    require(f.denoise({3}), f.integration);
    resize(f, {32, 32});
    f.beginFrame();
    f.device->clearCalls();
    f.device->failCreation(GENERATE(1u, 2u, 3u, 9u)); // of the move, and of the frame after it
    CHECK(f.denoise({3}) == nrd::Result::FAILURE);
    CHECK(f.count(CallType::Dispatch) == 0);
    CHECK(f.count(CallType::Barriers) == 0);
    require(f.denoise({3}), f.integration);
    const uint32_t moves = movesOf(f);
    CHECK(moves > 5);
    for (const rhi::RecordedBarrier& barrier : f.barriersOf("NRD P(0)")) // of the old one, of the new one
        CHECK((barrier.after == rhi::states::kSampled || barrier.after.layout == rhi::Layout::General));
    for (uint32_t frame = 0; frame < f.desc.framesInFlight; frame++)
    {
        CHECK_FALSE(isDestroyed(f, "NRD P(0)"));
        f.beginFrame();
        require(f.denoise({3}), f.integration);
    }
    CHECK(isDestroyed(f, "NRD P(0)"));
    CHECK(movesOf(f) == moves);
    CHECK(f.count(CallType::WaitIdle) == 0);
}

TEST_CASE("settings survive a resize, and history does not where they name another previous size", "[unit]")
{
    RecordingFixture f;
    f.requireCreated();
    nrd::ReferenceSettings settings;
    settings.maxAccumulatedFrameNum = 1;
    require(f.integration.SetDenoiserSettings(7, settings), f.integration);
    const nrd::Instance* const instance = f.integration.GetInstance();
    f.beginFrame();
    require(f.denoise(), f.integration);
    require(f.integration.Resize(64, 48), f.integration); // the same size: nothing happens
    CHECK(f.integration.GetStatistics().retiredObjects == 0);
    resize(f, {32, 32});
    CHECK(f.integration.GetInstance() == instance);
    CHECK(f.denoise() == nrd::Result::INVALID_ARGUMENT); // the settings were for another size
    f.lastWidth = f.lastHeight = 0;
    f.beginFrame();
    f.device->clearCalls();
    require(f.denoise(), f.integration);
    CHECK(movesOf(f) == 0);
    CHECK(f.barriersOf("NRD P(0)")[0].before == rhi::states::kUndefined);
}

TEST_CASE("a previous rectangle that cannot be is refused after a resize with the application's numbers", "[unit]")
{
    RecordingFixture f;
    f.requireCreated();
    f.beginFrame();
    require(f.denoise(), f.integration);
    resize(f, {32, 32});
    require(f.integration.NewFrame(), f.integration);
    nrd::CommonSettings settings = test::stillCamera(32, 32, f.frameIndex++);
    settings.resourceSizePrev[0] = RecordingFixture::kWidth;
    settings.resourceSizePrev[1] = settings.rectSizePrev[1] = RecordingFixture::kHeight;
    settings.rectSizePrev[0] = RecordingFixture::kWidth + 1;
    CHECK(f.integration.SetCommonSettings(settings) == nrd::Result::INVALID_ARGUMENT);
    CHECK(std::string(f.integration.GetLastMessage()).find("rectSizePrev[0] is 65") != std::string::npos);
    settings.rectSizePrev[0] = RecordingFixture::kWidth;
    require(f.integration.SetCommonSettings(settings), f.integration); // and the history is still there
    f.device->clearCalls();
    require(f.denoise(), f.integration);
    CHECK(movesOf(f) == 1);
}

TEST_CASE("a command buffer that moved history is recorded anew, and others are then repeated", "[unit]")
{
    RecordingFixture f({{3, Denoiser::REBLUR_DIFFUSE_SPECULAR}});
    f.desc.framesInFlight = 1;
    f.fillReblurSlots();
    f.requireCreated();
    const nrd::Identifier identifier = 3;
    uint32_t frame = 0;
    const auto isRecorded = [&]
    {
        nrd::DenoiseOptions options;
        options.recording = 1 + frame++ % 2; // the history's period
        f.fillReblurSlots();
        bool isNeeded = false;
        f.beginFrame();
        require(f.integration.Repeat(&identifier, 1, f.pool, options, isNeeded), f.integration);
        if (isNeeded) require(f.denoise({3}, options), f.integration);
        return isNeeded;
    };
    const auto settle = [&]
    {
        for (int i = 0; i < 6; i++) isRecorded();
    };
    settle();
    CHECK_FALSE(isRecorded());
    resize(f, {32, 32});
    CHECK(isRecorded()); // with the move
    CHECK(isRecorded());
    CHECK(isRecorded()); // in place of the one with the move
    CHECK_FALSE(isRecorded());
    CHECK_FALSE(isRecorded());
}
