// Command buffers that are recorded once and submitted frame after frame.
#include "reblur_engine.h"
#include "recording_fixture.h"
#include <numeric>

using test::EngineImage;
using test::kHeight;
using test::kReblur;
using test::kWidth;
using test::require;

namespace
{
constexpr nrd::NrdImageState kResting = {VK_IMAGE_LAYOUT_GENERAL,
                                         VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT,
                                         VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT};

struct Outcome
{
    std::vector<std::vector<float>> pictures; // of some frames, in order
    uint32_t recordingCount = 0;
};

// Frames over noise that stands still, with settings that change from frame to frame.
class Run
{
public:
    explicit Run(bool isRepeated, nrd::LayoutPolicy policy) : m_isRepeated(isRepeated), m_engine(policy)
    {
        const nrd::InstanceDesc& instance = nrd::GetInstanceDesc(*m_engine.integration.GetInstance());
        m_buffers.resize(std::lcm(m_engine.desc.framesInFlight, instance.denoisers[0].historyPeriod));
        for (std::unique_ptr<rhi::CommandBuffer>& buffer : m_buffers)
            buffer = m_engine.gpu.device().createCommandBuffer("recorded once");
        for (int i = 0; i < 2; i++) m_fences.push_back(m_engine.gpu.device().createFence("frame"));
        m_noise.resize(size_t(kWidth) * kHeight * 4);
        for (size_t i = 0; i < m_noise.size(); i++) // Y, Co, Cg, normalised hit distance
            m_noise[i] = i % 4 == 0 ? static_cast<float>(i * 7919 % 101) * 0.02f : i % 4 == 3 ? 0.5f : 0.0f;
        submit(
            [&](rhi::CommandBuffer& commands)
            {
                m_engine.images.upload(commands);
                for (const size_t signal : {3u, 4u}) m_engine.images.images[signal].upload(commands, m_noise.data());
                for (EngineImage& image : m_engine.images.images) image.transition(commands, kResting);
            });
    }
    ~Run() { m_engine.gpu.device().waitIdle(); }

    Outcome frames(uint32_t count)
    {
        for (uint32_t frame = 0; frame < count; frame++)
        {
            runFrame(frame);
            if (frame % 10 == 9) keepPictures();
        }
        m_engine.gpu.finish();
        return m_outcome;
    }

private:
    template <class Record> void submit(Record&& record)
    {
        const std::unique_ptr<rhi::CommandBuffer> commands = m_engine.gpu.device().createCommandBuffer("once");
        commands->begin();
        record(*commands);
        commands->end();
        rhi::CommandBuffer* const submitted = commands.get();
        m_engine.gpu.device().submit({&submitted, 1}, nullptr);
        m_engine.gpu.device().waitIdle();
    }

    void keepPictures()
    {
        for (const size_t output : {5u, 6u})
        {
            EngineImage& image = m_engine.images.images[output];
            submit(
                [&](rhi::CommandBuffer& commands)
                {
                    image.download(commands);
                    image.transition(commands, kResting);
                });
            m_outcome.pictures.push_back(image.texels<float>());
        }
    }

    void setSettings(uint32_t frame)
    {
        nrd::CommonSettings common = test::stillCamera(kWidth, kHeight, frame);
        common.cameraJitter[0] = common.cameraJitterPrev[1] = static_cast<float>(frame % 3) * 0.1f;
        common.disocclusionThreshold = 0.01f + static_cast<float>(frame % 5) * 0.002f;
        require(m_engine.integration.SetCommonSettings(common), m_engine.integration);
        nrd::ReblurSettings reblur;
        reblur.maxAccumulatedFrameNum = 10 + frame % 30;
        reblur.maxBlurRadius = 10.0f + static_cast<float>(frame % 7);
        reblur.lobeAngleFraction = 0.1f + static_cast<float>(frame % 4) * 0.1f;
        require(m_engine.integration.SetDenoiserSettings(kReblur, reblur), m_engine.integration);
    }

    void runFrame(uint32_t frame)
    {
        rhi::Fence& fence = *m_fences[frame % m_fences.size()];
        if (frame >= m_fences.size())
        {
            fence.wait();
            fence.reset();
        }
        require(m_engine.integration.NewFrame(), m_engine.integration);
        setSettings(frame);
        nrd::NrdUserPool pool;
        for (size_t i = 0; i < m_engine.images.images.size(); i++)
            pool[m_engine.images.slots[i]] = m_engine.images.images[i].entry;
        nrd::DenoiseOptions options;
        options.restoreInitialStates = true;
        options.recording = 1 + frame % static_cast<uint32_t>(m_buffers.size());
        rhi::CommandBuffer* const commands = m_buffers[options.recording - 1].get();
        bool isRecordingNeeded = true;
        if (m_isRepeated)
            require(m_engine.integration.Repeat(&kReblur, 1, pool, options, isRecordingNeeded), m_engine.integration);
        if (isRecordingNeeded) record(*commands, pool, options);
        for (const nrd::ResourceType slot : m_engine.images.slots) REQUIRE(pool[slot].state == kResting);
        m_engine.gpu.device().submit({&commands, 1}, &fence);
    }

    void record(rhi::CommandBuffer& commands, nrd::NrdUserPool& pool, const nrd::DenoiseOptions& options)
    {
        commands.begin();
        require(m_engine.integration.Denoise(rhi::vulkanCommandBuffer(commands), &kReblur, 1, pool, options),
                m_engine.integration);
        commands.end();
        m_outcome.recordingCount++;
    }

    bool m_isRepeated;
    test::ReblurEngine m_engine;
    std::vector<std::unique_ptr<rhi::CommandBuffer>> m_buffers;
    std::vector<std::unique_ptr<rhi::Fence>> m_fences;
    std::vector<float> m_noise;
    Outcome m_outcome;
};
} // namespace

TEST_CASE("command buffers recorded once give the pictures of those recorded for every frame", "[gpu]")
{
    const auto policy = GENERATE(nrd::LayoutPolicy::OPTIMAL, nrd::LayoutPolicy::GENERAL);
    const uint32_t frameCount = policy == nrd::LayoutPolicy::OPTIMAL ? 100 : 30;
    const Outcome recorded = Run(false, policy).frames(frameCount);
    const Outcome repeated = Run(true, policy).frames(frameCount);
    CHECK(recorded.recordingCount == frameCount);
    CHECK(repeated.recordingCount <= 6); // one for each buffer, and those of the first frames, which clear the history
    REQUIRE(recorded.pictures.size() == 2 * frameCount / 10);
    for (size_t i = 0; i < recorded.pictures.size(); i++) CHECK(repeated.pictures[i] == recorded.pictures[i]);
    CHECK(recorded.pictures[4] != recorded.pictures[2]); // settings show
}

TEST_CASE("what changes the commands asks for recording, and what changes constants does not", "[unit]")
{
    test::RecordingFixture f({{3, nrd::Denoiser::REBLUR_DIFFUSE_SPECULAR}});
    f.fillReblurSlots();
    f.desc.framesInFlight = 1;
    f.requireCreated();
    const nrd::Identifier identifier = 3;
    const uint32_t period = nrd::GetInstanceDesc(*f.integration.GetInstance()).denoisers[0].historyPeriod;
    // True: recorded; only then the calls of Vulkan's commands are there.
    const auto runFrame = [&](auto&& change)
    {
        f.beginFrame();
        change();
        nrd::DenoiseOptions options;
        options.recording = 1 + f.frameIndex % period;
        f.device->clearCalls();
        bool isRecordingNeeded = false;
        require(f.integration.Repeat(&identifier, 1, f.pool, options, isRecordingNeeded), f.integration);
        CHECK(f.count(rhi::CallType::Dispatch) == 0);
        if (isRecordingNeeded) require(f.denoise({3}, options), f.integration);
        return isRecordingNeeded;
    };
    const auto settle = [&]
    {
        for (uint32_t i = 0; i < 6; i++) (void)runFrame([] {});
        CHECK_FALSE(runFrame([] {}));
    };
    const auto setReblur = [&](const nrd::ReblurSettings& settings)
    { require(f.integration.SetDenoiserSettings(3, settings), f.integration); };
    nrd::ReblurSettings reblur;
    settle();
    reblur.maxBlurRadius = 7.0f;
    CHECK_FALSE(runFrame([&] { setReblur(reblur); }));
    reblur.maxStabilizedFrameNum = 0; // no such pass
    CHECK(runFrame([&] { setReblur(reblur); }));
    settle();
    CHECK(runFrame([&] { f.pool[nrd::ResourceType::IN_MV].generation = 5; }));
    settle();
    CHECK(runFrame(
        [&]
        {
            f.settings.accumulationMode = nrd::AccumulationMode::CLEAR_AND_RESTART;
            require(f.integration.SetCommonSettings(f.settings), f.integration);
        }));
    settle();
    f.width = f.height = 40;
    require(f.integration.Resize(f.width, f.height), f.integration);
    f.fillReblurSlots();
    CHECK(runFrame([] {}));
    settle();
}

TEST_CASE("a frame that was asked for and then recorded goes on with its history", "[unit]")
{
    test::RecordingFixture f; // REFERENCE
    f.requireCreated();
    const nrd::Identifier identifier = 7;
    nrd::DenoiseOptions options;
    bool isRecordingNeeded = false;
    f.beginFrame();
    test::requireRefusal(f.integration.Repeat(&identifier, 1, f.pool, options, isRecordingNeeded), f.integration,
                         "options.recording is 0, must be the number that Denoise() was given");
    options.recording = 4;
    for (uint32_t frame = 0; frame < 4; frame++)
    {
        if (frame > 0) f.beginFrame();
        const nrd::NrdUserPool before = f.pool;
        require(f.integration.Repeat(&identifier, 1, f.pool, options, isRecordingNeeded), f.integration);
        CHECK(isRecordingNeeded); // the ring's slot is another one
        CHECK(f.pool[nrd::ResourceType::OUT_SIGNAL].state == before[nrd::ResourceType::OUT_SIGNAL].state);
        f.device->clearCalls();
        require(f.denoise({7}, options), f.integration);
        CHECK(f.count(rhi::CallType::Dispatch) == (frame == 0 ? 3u : 2u)); // with the first frame's clear only
        test::requireRefusal(f.integration.Repeat(&identifier, 1, f.pool, options, isRecordingNeeded), f.integration,
                             "identifier 7 (REFERENCE) is denoised twice in one frame, which would spoil its history");
    }
}
