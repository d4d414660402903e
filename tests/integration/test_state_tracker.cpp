#include "catch.h"
#include "convert.h"
#include "hazard_model.h"
#include "state_tracker.h"
#include <algorithm>
#include <random>

using nrd::LayoutPolicy;
using nrd::NrdImageState;
using nrd::ResourceState;
using test::ImageModel;

namespace
{
constexpr VkPipelineStageFlags kCompute = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT;
constexpr VkPipelineStageFlags kFragment = VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT;
constexpr VkPipelineStageFlags kOutput = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
constexpr VkPipelineStageFlags kTransfer = VK_PIPELINE_STAGE_TRANSFER_BIT;

// States an engine may leave an image in.
const NrdImageState kEngineStates[] = {
    {},
    {VK_IMAGE_LAYOUT_UNDEFINED, VK_ACCESS_SHADER_READ_BIT, kFragment},
    {VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_ACCESS_SHADER_READ_BIT, kCompute},
    {VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_ACCESS_SHADER_READ_BIT, kFragment},
    {VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_ACCESS_SHADER_READ_BIT, kFragment | kCompute},
    {VK_IMAGE_LAYOUT_GENERAL, VK_ACCESS_SHADER_READ_BIT, kCompute},
    {VK_IMAGE_LAYOUT_GENERAL, VK_ACCESS_SHADER_WRITE_BIT, kCompute},
    {VK_IMAGE_LAYOUT_GENERAL, VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT, kCompute},
    {VK_IMAGE_LAYOUT_GENERAL, VK_ACCESS_SHADER_READ_BIT, kFragment},
    {VK_IMAGE_LAYOUT_GENERAL, VK_ACCESS_SHADER_WRITE_BIT, kFragment},
    {VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT, kOutput},
    {VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_ACCESS_TRANSFER_WRITE_BIT, kTransfer},
};

constexpr ResourceState kUses[] = {ResourceState::SAMPLED, ResourceState::STORAGE, ResourceState::SAMPLED_AND_STORAGE};

// A queue of random dispatches over a few images, with an engine that takes them back now and then.
class Simulation
{
public:
    Simulation(uint32_t seed, LayoutPolicy policy) : m_random(seed), m_policy(policy), m_tracker(kImageCount)
    {
        for (uint32_t i = 0; i < kImageCount; i++) handOver(i, pick(kEngineStates));
    }

    void step()
    {
        const uint32_t useCount = 1 + random(5);
        std::vector<uint32_t> used;
        for (uint32_t i = 0; i < useCount; i++) used.push_back(random(kImageCount));
        for (const uint32_t image : used) m_tracker.use(image, nrd::toRhi(pick(kUses), m_policy));
        m_transitions.clear();
        const std::vector<ImageModel> before = m_models;
        m_tracker.endStep(m_transitions);
        applyBatch();
        for (const nrd::Transition& transition : m_transitions) checkNeeded(before, transition);
        for (uint32_t image = 0; image < kImageCount; image++)
            if (std::find(used.begin(), used.end(), image) != used.end()) checkUse(image);
        if (random(8) == 0) engineTakesBack(random(kImageCount));
    }

    uint32_t barrierCount = 0;

private:
    static constexpr uint32_t kImageCount = 4;

    template <class T, size_t N> const T& pick(const T (&values)[N]) { return values[random(N)]; }
    uint32_t random(size_t count) { return static_cast<uint32_t>(m_random() % count); } // [0; count)

    void handOver(uint32_t image, const NrdImageState& state)
    {
        if (m_models.size() <= image) m_models.emplace_back(state);
        m_models[image] = ImageModel(state);
        m_tracker.setState(image, nrd::toRhi(state));
    }

    void applyBatch()
    {
        std::vector<bool> isTouched(kImageCount, false);
        for (const nrd::Transition& transition : m_transitions)
        {
            REQUIRE_FALSE(isTouched[transition.texture]); // one barrier per image and batch
            isTouched[transition.texture] = true;
            REQUIRE(m_models[transition.texture].barrier(nrd::toImageState(transition.before),
                                                         nrd::toImageState(transition.after)) == "");
            barrierCount++;
        }
    }

    void checkUse(uint32_t image) { REQUIRE(m_models[image].use(nrd::toImageState(m_tracker.needed(image))) == ""); }

    // Without the barrier the use would have been a hazard; an engine's own state may be met with one too many.
    void checkNeeded(const std::vector<ImageModel>& before, const nrd::Transition& transition)
    {
        if (transition.before.layout == rhi::Layout::Native) return;
        ImageModel model = before[transition.texture];
        REQUIRE(model.use(nrd::toImageState(transition.after)) != "");
    }

    // From the state that the tracker claims, by a barrier of the engine, to a use of the engine.
    void engineTakesBack(uint32_t image)
    {
        const NrdImageState claimed = nrd::toImageState(m_tracker.state(image));
        const NrdImageState& wanted = kEngineStates[2 + random(std::size(kEngineStates) - 2)];
        REQUIRE(m_models[image].barrier(claimed, wanted) == "");
        REQUIRE(m_models[image].use(wanted) == "");
        handOver(image, wanted);
    }

    std::mt19937 m_random;
    LayoutPolicy m_policy;
    nrd::StateTracker m_tracker;
    std::vector<ImageModel> m_models;
    std::vector<nrd::Transition> m_transitions;
};
} // namespace

TEST_CASE("random sequences of dispatches have exactly the barriers that the hazard model asks for", "[unit]")
{
    const LayoutPolicy policy = GENERATE(LayoutPolicy::OPTIMAL, LayoutPolicy::GENERAL);
    uint32_t barrierCount = 0;
    for (uint32_t seed = 0; seed < 300; seed++)
    {
        INFO("seed " << seed);
        Simulation simulation(seed, policy);
        for (int step = 0; step < 100; step++) simulation.step();
        barrierCount += simulation.barrierCount;
    }
    CHECK(barrierCount > 300 * 100);
}

TEST_CASE("the hazard model finds a missing barrier of each kind", "[unit]")
{
    const NrdImageState read = {VK_IMAGE_LAYOUT_GENERAL, VK_ACCESS_SHADER_READ_BIT, kCompute};
    const NrdImageState write = {VK_IMAGE_LAYOUT_GENERAL, VK_ACCESS_SHADER_WRITE_BIT, kCompute};
    const NrdImageState fragment = {VK_IMAGE_LAYOUT_GENERAL, VK_ACCESS_SHADER_READ_BIT, kFragment};
    CHECK(ImageModel(write).use(read) == "not ordered after the last write");
    CHECK(ImageModel(write).use(write) == "not ordered after the last write");
    CHECK(ImageModel(read).use(write) == "written while it may still be read");
    CHECK(ImageModel(fragment).use(read) == "not ordered after the last write");
    CHECK(ImageModel({}).use(read) == "used in another layout than it is in");
    ImageModel model(write);
    CHECK(model.barrier(read, fragment) == ""); // the wrong source access: the write is never made available
    CHECK(model.use(fragment) == "the last write is not available");
}

TEST_CASE("reads of an image that stays sampled need no barrier", "[unit]")
{
    nrd::StateTracker tracker(1);
    tracker.setState(0, rhi::states::kSampled);
    std::vector<nrd::Transition> transitions;
    for (int i = 0; i < 3; i++)
    {
        tracker.use(0, rhi::states::kSampled);
        tracker.endStep(transitions);
    }
    CHECK(transitions.empty());
}

TEST_CASE("an image left sampled by the fragment stage waits for it before compute writes", "[unit]")
{
    nrd::StateTracker tracker(1);
    const NrdImageState left = {VK_IMAGE_LAYOUT_GENERAL, VK_ACCESS_SHADER_READ_BIT, kFragment};
    tracker.setState(0, nrd::toRhi(left));
    std::vector<nrd::Transition> transitions;
    tracker.use(0, rhi::states::kStorageWrite);
    tracker.endStep(transitions);
    REQUIRE(transitions.size() == 1);
    CHECK(nrd::toImageState(transitions[0].before) == left);
    CHECK(transitions[0].after == rhi::states::kStorageWrite);
}

TEST_CASE("a texture read and written by one dispatch is in one state for both", "[unit]")
{
    nrd::StateTracker tracker(1);
    std::vector<nrd::Transition> transitions;
    tracker.use(0, rhi::states::kSampled);
    tracker.use(0, rhi::states::kStorageWrite);
    tracker.endStep(transitions);
    REQUIRE(transitions.size() == 1);
    CHECK(transitions[0].after.layout == rhi::Layout::General);
    CHECK(transitions[0].after.access == (rhi::Access::SampledRead | rhi::Access::StorageWrite));
}

TEST_CASE("every state that compute passes leave survives the way to Vulkan and back", "[unit]")
{
    for (const NrdImageState& state : kEngineStates)
    {
        INFO("layout " << state.layout << ", access " << state.access << ", stages " << state.stages);
        CHECK(nrd::toImageState(nrd::toRhi(state)) == state);
    }
}
