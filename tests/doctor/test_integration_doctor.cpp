// RecordDiagnosis() and Diagnose() on an application's images: the same findings as on the host, states, refusals.
#include "gpu_fixture.h"
#include "room.h"
#include <cstring>

namespace
{
using nrd::ResourceType;

constexpr uint32_t kWidth = 160, kHeight = 96;
constexpr uint32_t kFramesInFlight = 2;

// One frame's images; a ring of them, since frames overlap.
struct Images
{
    explicit Images(test::Gpu& gpu)
        : viewZ(gpu, rhi::Format::RGBA32_SFLOAT, kWidth, kHeight, rhi::TextureUsage::Sampled),
          motion(gpu, rhi::Format::RGBA32_SFLOAT, kWidth, kHeight, rhi::TextureUsage::Sampled),
          normalRoughness(gpu, rhi::Format::A2B10G10R10_UNORM_PACK32, kWidth, kHeight, rhi::TextureUsage::Sampled),
          diffuse(gpu, rhi::Format::RGBA32_SFLOAT, kWidth, kHeight, rhi::TextureUsage::Sampled),
          specular(gpu, rhi::Format::RGBA32_SFLOAT, kWidth, kHeight, rhi::TextureUsage::Sampled),
          specularDirection(gpu, rhi::Format::RGBA32_SFLOAT, kWidth, kHeight, rhi::TextureUsage::Sampled)
    {
    }

    void upload(rhi::CommandBuffer& commands, const test::FrameInputs& frame)
    {
        std::vector<uint32_t> packed;
        for (size_t i = 0; i < frame.normalRoughness.size(); i += 4)
        {
            uint32_t texel = 0;
            for (uint32_t c = 0; c < 3; c++)
                texel |= static_cast<uint32_t>(std::lround(frame.normalRoughness[i + c] * 1023.0f)) << (10 * c);
            packed.push_back(texel);
        }
        normalRoughness.upload(commands, packed.data());
        viewZ.upload(commands, frame.viewZ.data());
        motion.upload(commands, frame.motion.data());
        diffuse.upload(commands, frame.diffuse.data());
        specular.upload(commands, frame.specular.data());
        specularDirection.upload(commands, frame.specularDirection.data());
    }

    nrd::NrdUserPool pool() const
    {
        nrd::NrdUserPool result;
        result[ResourceType::IN_VIEWZ] = viewZ.entry;
        result[ResourceType::IN_MV] = motion.entry;
        result[ResourceType::IN_NORMAL_ROUGHNESS] = normalRoughness.entry;
        result[ResourceType::IN_DIFF_RADIANCE_HITDIST] = diffuse.entry;
        result[ResourceType::IN_SPEC_RADIANCE_HITDIST] = specular.entry;
        return result;
    }

    void takeStates(const nrd::NrdUserPool& pool, const nrd::NrdDiagnosisImages& extra)
    {
        viewZ.entry = pool[ResourceType::IN_VIEWZ];
        motion.entry = pool[ResourceType::IN_MV];
        normalRoughness.entry = pool[ResourceType::IN_NORMAL_ROUGHNESS];
        diffuse.entry = pool[ResourceType::IN_DIFF_RADIANCE_HITDIST];
        specular.entry = pool[ResourceType::IN_SPEC_RADIANCE_HITDIST];
        specularDirection.entry = extra.specularDirection;
    }

    test::EngineImage viewZ, motion, normalRoughness, diffuse, specular, specularDirection;
};

struct Engine
{
    explicit Engine(nrd::LayoutPolicy policy) : ring(gpu, kFramesInFlight)
    {
        for (uint32_t i = 0; i < kFramesInFlight; i++) images.push_back(std::make_unique<Images>(gpu));
        nrd::IntegrationCreationDesc desc;
        desc.native = gpu.native();
        desc.resourceWidth = kWidth;
        desc.resourceHeight = kHeight;
        desc.framesInFlight = kFramesInFlight;
        desc.layoutPolicy = policy;
        const nrd::DenoiserDesc denoiser = {0, nrd::Denoiser::REBLUR_DIFFUSE_SPECULAR};
        nrd::InstanceCreationDesc instance;
        instance.denoisers = &denoiser;
        instance.denoisersNum = 1;
        test::require(integration.Create(desc, instance), integration);
        nrd::ReblurSettings settings;
        settings.hitDistanceParameters.A = 6.0f; // as the room's
        test::require(integration.SetDenoiserSettings(0, settings), integration);
    }
    ~Engine() { ring.wait(); }

    void beginFrame(const nrd::CommonSettings& common)
    {
        test::require(integration.NewFrame(), integration);
        test::require(integration.SetCommonSettings(common), integration);
    }

    void runFrame(const test::FrameInputs& frame)
    {
        rhi::CommandBuffer& commands = ring.begin(); // waits for the frame before the last
        beginFrame(frame.common);
        Images& current = *images[frame.common.frameIndex % kFramesInFlight];
        current.upload(commands, frame);
        nrd::NrdUserPool pool = current.pool();
        nrd::NrdDiagnosisImages extra;
        extra.specularDirection = current.specularDirection.entry;
        test::require(integration.RecordDiagnosis(rhi::vulkanCommandBuffer(commands), pool, &extra), integration);
        current.takeStates(pool, extra);
        ring.end();
    }

    std::vector<nrd::Finding> findings(bool isGpuIdle)
    {
        const nrd::Finding* found = nullptr;
        uint32_t count = 0;
        test::require(integration.Diagnose(found, count, isGpuIdle), integration);
        return {found, found + count};
    }

    test::Gpu gpu;
    test::FrameRing ring;
    std::vector<std::unique_ptr<Images>> images;
    nrd::NrdIntegration integration;
};

std::vector<test::FrameInputs> faultyRoom()
{
    std::vector<test::FrameInputs> frames = test::makeRoom(6, kWidth, kHeight);
    test::toScreenMotion(frames);
    for (test::FrameInputs& frame : frames)
        for (float& value : frame.motion) value = -value;
    return frames;
}
} // namespace

TEST_CASE("an application's images tell the same as the host's, without waiting", "[gpu]")
{
    for (const nrd::LayoutPolicy policy : {nrd::LayoutPolicy::OPTIMAL, nrd::LayoutPolicy::GENERAL})
    {
        Engine engine(policy);
        const std::vector<test::FrameInputs> good = test::makeRoom(6, kWidth, kHeight);
        for (const test::FrameInputs& frame : good)
        {
            engine.runFrame(frame);
            CHECK(engine.findings(false).empty());
        }
        engine.ring.wait();
        CHECK(engine.findings(true).empty());
        test::require(engine.integration.EndDiagnosis(), engine.integration);

        std::vector<test::FrameInputs> bad = faultyRoom();
        for (test::FrameInputs& frame : bad)
        {
            frame.common.frameIndex += 100;
            engine.runFrame(frame);
            const size_t count = engine.findings(false).size(); // of frames that are done, two of which make a pair
            CHECK(count == (frame.common.frameIndex >= 103 ? 1 : 0));
        }
        engine.ring.wait();
        const std::vector<nrd::Finding> findings = engine.findings(true);
        REQUIRE(findings.size() == 1);
        CHECK(findings[0].rule == nrd::DoctorRule::MOTION);
        CHECK(findings[0].slot == ResourceType::IN_MV);
        CHECK_THAT(findings[0].text, containing("current - previous; multiply motionVectorScale by -1"));
        CHECK(test::diagnose(bad).entries.at(0).text == findings[0].text);
        engine.gpu.finish();
    }
}

TEST_CASE("a diagnosis out of turn is refused", "[gpu]")
{
    Engine engine(nrd::LayoutPolicy::OPTIMAL);
    nrd::NrdIntegration& integration = engine.integration;
    const test::FrameInputs room = test::makeRoom(1, kWidth, kHeight)[0];
    rhi::CommandBuffer& commands = engine.ring.begin();
    const VkCommandBuffer handle = rhi::vulkanCommandBuffer(commands);
    const nrd::Finding* findings = nullptr;
    uint32_t count = 1;
    test::requireRefusal(integration.Diagnose(findings, count), integration,
                         "RecordDiagnosis() must be called before Diagnose()");
    CHECK(count == 0);
    nrd::NrdUserPool pool = engine.images[0]->pool();
    test::requireRefusal(integration.RecordDiagnosis(handle, pool), integration,
                         "NewFrame() must be called before RecordDiagnosis()");
    engine.beginFrame(room.common);
    engine.images[0]->upload(commands, room);
    pool = engine.images[0]->pool();
    test::requireRefusal(integration.RecordDiagnosis(VK_NULL_HANDLE, pool), integration, "commandBuffer is null");
    test::require(integration.RecordDiagnosis(handle, pool), integration);
    test::requireRefusal(integration.RecordDiagnosis(handle, pool), integration,
                         "RecordDiagnosis() is called twice in one frame");
    engine.ring.end();
    engine.ring.wait();
    CHECK(engine.findings(true).empty());
    test::require(integration.Resize(64, 64), integration); // with the diagnosis still there
    engine.gpu.finish();
}

TEST_CASE("images that the doctor cannot read are refused by name", "[gpu]")
{
    Engine engine(nrd::LayoutPolicy::OPTIMAL);
    nrd::NrdIntegration& integration = engine.integration;
    rhi::CommandBuffer& commands = engine.ring.begin();
    const VkCommandBuffer handle = rhi::vulkanCommandBuffer(commands);
    engine.beginFrame(test::makeRoom(1, kWidth, kHeight)[0].common);
    const nrd::NrdUserPool pool = engine.images[0]->pool();
    const auto requireRefusal = [&](nrd::NrdUserPool changed, nrd::NrdDiagnosisImages extra, const char* sentence)
    { test::requireRefusal(integration.RecordDiagnosis(handle, changed, &extra), integration, sentence); };
    nrd::NrdUserPool broken = pool;
    broken[ResourceType::IN_VIEWZ] = {};
    requireRefusal(broken, {},
                   "IN_VIEWZ: the slot is empty or no denoiser of the instance reads it, but the doctor needs it");
    broken = pool;
    broken[ResourceType::IN_MV].width = 3;
    requireRefusal(broken, {}, "IN_MV: the image is 3 x 96, but the resource size is 160 x 96");
    nrd::NrdDiagnosisImages extra;
    extra.diffuseFactor = pool[ResourceType::IN_DIFF_RADIANCE_HITDIST];
    extra.diffuseFactor.format = VK_FORMAT_R8_UINT;
    requireRefusal(pool, extra, "diffuseFactor: VkFormat 13 is not one that can be read as floats");
    extra.diffuseFactor = pool[ResourceType::IN_DIFF_RADIANCE_HITDIST];
    extra.diffuseFactor.state.access ^= 1;
    requireRefusal(pool, extra,
                   "IN_DIFF_RADIANCE_HITDIST and diffuseFactor: one image in two states (layout, access or stages "
                   "differ)");
    engine.ring.end();
    engine.gpu.finish();
}
