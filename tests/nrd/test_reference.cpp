#include "fixture.h"
#include "reference_constants.h"

using namespace test;

namespace
{
float weight(Instance& instance, CommonSettings& common, Identifier identifier = 0)
{
    const std::vector<DispatchDesc> dispatches = requestFrame(instance, common, {identifier});
    return constantsOf<nrd::shared::ReferenceConstants>(dispatches.back()).weight;
}

float oneOver(uint32_t num) { return 1.0f / static_cast<float>(num); }

struct Mean
{
    Mean()
    {
        for (uint32_t frame = 1; frame <= 3; frame++) REQUIRE(weight(*instance, common) == Approx(oneOver(frame)));
    }

    InstancePtr instance = makeInstance({Denoiser::REFERENCE, Denoiser::REFERENCE});
    CommonSettings common = makeCommon();
};
} // namespace

TEST_CASE("REFERENCE accumulates in place and copies", "[unit]")
{
    const InstancePtr instance = makeInstance({Denoiser::REFERENCE});
    CHECK(GetInstanceDesc(*instance).permanentPoolSize == 1);
    CHECK(GetInstanceDesc(*instance).transientPoolSize == 0);
    CommonSettings common = makeCommon();
    requestFrame(*instance, common);
    const std::vector<DispatchDesc> dispatches = requestFrame(*instance, common);
    REQUIRE(passNames(dispatches) == std::vector<std::string>{"Accumulate", "Copy"});
    const ResourceDesc* accumulate = dispatches[0].resources;
    CHECK(accumulate[0].type == ResourceType::IN_SIGNAL);
    CHECK(accumulate[1].type == ResourceType::PERMANENT_POOL);
    CHECK(accumulate[2].type == ResourceType::PERMANENT_POOL);
    CHECK(accumulate[1].state == ResourceState::SAMPLED_AND_STORAGE);
    CHECK(dispatches[1].resources[1].type == ResourceType::OUT_SIGNAL);
}

TEST_CASE("REFERENCE never clears its output, which may be its input", "[unit]")
{
    const InstancePtr instance = makeInstance({Denoiser::REFERENCE});
    CommonSettings common = makeCommon();
    const std::vector<DispatchDesc> dispatches = requestFrame(*instance, common);
    CHECK(dispatches.size() == 3);
    CHECK(dispatches[0].resources[0].type == ResourceType::PERMANENT_POOL);
}

TEST_CASE("each REFERENCE counts its own frames up to its own maximum", "[unit]")
{
    const InstancePtr instance = makeInstance({Denoiser::REFERENCE, Denoiser::REFERENCE});
    CommonSettings common = makeCommon();
    ReferenceSettings settings;
    settings.maxAccumulatedFrameNum = 2;
    REQUIRE(SetDenoiserSettings(*instance, 1, settings) == Result::SUCCESS);
    for (uint32_t frame = 1; frame <= 5; frame++)
    {
        CHECK(weight(*instance, common, 0) == Approx(oneOver(frame)));
        CHECK(weight(*instance, common, 1) == Approx(oneOver(std::min(frame, 3u))));
    }
}

TEST_CASE("the mean restarts with the camera, the size, and on demand, but not with the jitter", "[unit]")
{
    Mean mean;
    SECTION("nothing changes") { CHECK(weight(*mean.instance, mean.common) == Approx(0.25f)); }
    SECTION("jitter")
    {
        mean.common.cameraJitter[0] = 0.3f;
        CHECK(weight(*mean.instance, mean.common) == Approx(0.25f));
    }
    SECTION("camera")
    {
        mean.common.worldToViewMatrix[12] = 0.5f;
        CHECK(weight(*mean.instance, mean.common) == 1.0f);
        CHECK(weight(*mean.instance, mean.common) == 0.5f);
    }
    SECTION("projection")
    {
        mean.common.viewToClipMatrix[0] = 1.5f;
        CHECK(weight(*mean.instance, mean.common) == 1.0f);
    }
    SECTION("rect")
    {
        mean.common.rectSize[1] = 59;
        CHECK(weight(*mean.instance, mean.common) == 1.0f);
        CHECK(weight(*mean.instance, mean.common) == 0.5f);
    }
    SECTION("restart")
    {
        mean.common.accumulationMode = AccumulationMode::RESTART;
        CHECK(weight(*mean.instance, mean.common) == 1.0f);
        CHECK(weight(*mean.instance, mean.common) == 1.0f);
    }
}

TEST_CASE("the mean goes on while the split screen hides it", "[unit]")
{
    Mean mean;
    mean.common.splitScreen = 1.0f;
    CHECK(weight(*mean.instance, mean.common) == Approx(0.25f));
    mean.common.splitScreen = 0.0f;
    CHECK(weight(*mean.instance, mean.common) == Approx(0.2f));
}
