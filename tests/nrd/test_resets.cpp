#include "denoiser_constants.h"
#include "fixture.h"
#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

using namespace test;
using nrd::shared::DenoiserConstants;

namespace
{
size_t clearNum(const std::vector<DispatchDesc>& dispatches)
{
    const std::vector<std::string> names = passNames(dispatches);
    return static_cast<size_t>(std::count(names.begin(), names.end(), "Clear"));
}

using Target = std::pair<ResourceType, uint16_t>;

std::set<Target> written(const std::vector<DispatchDesc>& dispatches, bool isClear)
{
    std::set<Target> targets;
    const std::vector<std::string> names = passNames(dispatches);
    for (size_t i = 0; i < dispatches.size(); i++)
    {
        if ((names[i] == "Clear") != isClear) continue;
        for (uint32_t k = 0; k < dispatches[i].resourcesNum; k++)
        {
            const ResourceDesc& r = dispatches[i].resources[k];
            if (r.descriptorType == DescriptorType::STORAGE_TEXTURE) targets.insert({r.type, r.indexInPool});
        }
    }
    return targets;
}
} // namespace

TEST_CASE("the first request of each denoiser clears everything it writes, once", "[unit]")
{
    const InstancePtr instance = makeInstance({kReblurBoth, kReblurBoth});
    CommonSettings common = makeCommon();
    ReblurSettings allPasses; // every pass runs
    allPasses.prePassMode = PrePassMode::SIMPLE;
    for (Identifier i : {0u, 1u}) REQUIRE(SetDenoiserSettings(*instance, i, allPasses) == Result::SUCCESS);
    const std::vector<DispatchDesc> first = requestFrame(*instance, common, {0});
    const std::set<Target> cleared = written(first, true);
    std::set<Target> all = written(first, false);
    CHECK(cleared.size() == clearNum(first)); // each once
    const std::vector<DispatchDesc> second = requestFrame(*instance, common, {0});
    CHECK(clearNum(second) == 0);
    // Two requests write both textures of each pair.
    const std::set<Target> other = written(second, false);
    all.insert(other.begin(), other.end());
    CHECK(cleared == all);
    CHECK(cleared.count({ResourceType::OUT_DIFF_RADIANCE_HITDIST, 0}) == 1);

    for (int i = 0; i < 8; i++) requestFrame(*instance, common, {0});
    const std::vector<DispatchDesc> late = requestFrame(*instance, common, {0, 1});
    CHECK(clearNum(late) == cleared.size());
    for (const DispatchDesc& dispatch : late)
    {
        if (std::string(dispatch.name).find("Clear") != std::string::npos) CHECK(dispatch.identifier == 1);
    }
}

TEST_CASE("clears cover the resource, not the rect, and use the texture's component type", "[unit]")
{
    const InstancePtr instance = makeInstance({kReblurBoth});
    const InstanceDesc& desc = GetInstanceDesc(*instance);
    CommonSettings common = makeCommon();
    common.rectSize[0] = common.rectSize[1] = 8;
    size_t integerNum = 0;
    for (const DispatchDesc& dispatch : requestFrame(*instance, common))
    {
        if (std::string(dispatch.name).find("Clear") == std::string::npos) continue;
        REQUIRE(dispatch.resourcesNum == 1);
        CHECK(dispatch.constantBufferData == nullptr);
        CHECK(dispatch.constantBufferDataSize == 0);
        const ResourceDesc& r = dispatch.resources[0];
        CHECK(r.state == ResourceState::STORAGE);
        TextureDesc texture = {Format::RGBA16_SFLOAT, 1};
        if (r.type == ResourceType::TRANSIENT_POOL) texture = desc.transientPool[r.indexInPool];
        if (r.type == ResourceType::PERMANENT_POOL) texture = desc.permanentPool[r.indexInPool];
        const auto groups = [&](uint32_t size)
        { return uint32_t(std::ceil(std::ceil(double(size) / texture.downsampleFactor) / 16.0)); };
        CHECK(dispatch.gridWidth == groups(100));
        CHECK(dispatch.gridHeight == groups(60));
        const Format integers[] = {Format::R8_UINT, Format::R16_UINT, Format::R32_UINT};
        const bool isInteger =
            std::find(std::begin(integers), std::end(integers), texture.format) != std::end(integers);
        integerNum += isInteger ? 1 : 0;
        CHECK(std::string(desc.pipelines[dispatch.pipelineIndex].shaderIdentifier) ==
              (isInteger ? "ClearUint" : "ClearFloat"));
    }
    CHECK(integerNum == 3); // lengths, two of votes
}

TEST_CASE("a reset drops history lengths and previous sizes, for the denoiser that is new alone", "[unit]")
{
    const InstancePtr instance = makeInstance({kReblurBoth, kReblurBoth});
    CommonSettings common = makeCommon();
    CHECK(reblurConstants(requestFrame(*instance, common, {0})).isHistoryReset == 1);
    CHECK(reblurConstants(requestFrame(*instance, common, {0})).isHistoryReset == 0);

    common.rectSizePrev[0] = 50;
    common.resourceSizePrev[0] = 80;
    common.cameraJitter[0] = 0.25f;
    common.cameraJitterPrev[0] = -0.25f;
    const DenoiserConstants late = reblurConstants(requestFrame(*instance, common, {1}));
    CHECK(late.isHistoryReset == 1);
    CHECK(late.rectSizePrev.x == 100.0f);
    CHECK(late.resourceSizeInvPrev.x == 1.0f / 100.0f);
    CHECK(late.disocclusionThreshold == Approx(0.01f + 1.0f / 60.0f)); // no jitter between equal frames
    CHECK(late.maxAccumulatedFrameNum.y == 0.0f);
    CHECK(late.maxFastAccumulatedFrameNum.y == 0.0f);
    CHECK(late.stabilizationStrength == 0.0f);

    const DenoiserConstants old = reblurConstants(requestFrame(*instance, common, {0}));
    CHECK(old.isHistoryReset == 0);
    CHECK(old.rectSizePrev.x == 50.0f);
    CHECK(old.resourceSizeInvPrev.x == 1.0f / 80.0f);
    CHECK(old.disocclusionThreshold == Approx(0.01f + 1.5f / 60.0f));
    CHECK(old.maxAccumulatedFrameNum.y == 40.0f);
    CHECK(old.stabilizationStrength == Approx(63.0f / 64.0f));
}

TEST_CASE("restart resets without clearing, clear and restart does both", "[unit]")
{
    const InstancePtr instance = makeInstance({kReblurBoth});
    CommonSettings common = makeCommon();
    const size_t firstClearNum = clearNum(requestFrame(*instance, common));
    CHECK(firstClearNum > 0);

    common.accumulationMode = AccumulationMode::RESTART;
    std::vector<DispatchDesc> dispatches = requestFrame(*instance, common);
    CHECK(clearNum(dispatches) == 0);
    CHECK(reblurConstants(dispatches).isHistoryReset == 1);

    common.accumulationMode = AccumulationMode::CLEAR_AND_RESTART;
    dispatches = requestFrame(*instance, common);
    CHECK(clearNum(dispatches) == firstClearNum);
    CHECK(reblurConstants(dispatches).isHistoryReset == 1);

    common.accumulationMode = AccumulationMode::CONTINUE;
    dispatches = requestFrame(*instance, common);
    CHECK(clearNum(dispatches) == 0);
    CHECK(reblurConstants(dispatches).isHistoryReset == 0);
}

TEST_CASE("after frames that only showed the input the history is too old and starts anew", "[unit]")
{
    const InstancePtr instance = makeInstance({kReblurBoth});
    CommonSettings common = makeCommon();
    requestFrame(*instance, common);
    common.splitScreen = 1.0f;
    requestFrame(*instance, common);
    common.splitScreen = 0.5f;
    std::vector<DispatchDesc> dispatches = requestFrame(*instance, common);
    CHECK(clearNum(dispatches) == 0);
    CHECK(reblurConstants(dispatches).isHistoryReset == 1);
    CHECK(reblurConstants(dispatches).splitScreenPrev == 0.5f);
    common.splitScreen = 0.25f;
    dispatches = requestFrame(*instance, common);
    CHECK(reblurConstants(dispatches).isHistoryReset == 0);
    CHECK(reblurConstants(dispatches).splitScreen == 0.25f);
    CHECK(reblurConstants(dispatches).splitScreenPrev == 0.5f);
}

TEST_CASE("stabilisation switched on again does not use what it left behind long ago", "[unit]")
{
    const InstancePtr instance = makeInstance({kReblurBoth});
    CommonSettings common = makeCommon();
    ReblurSettings settings;
    requestFrame(*instance, common);
    CHECK(reblurConstants(requestFrame(*instance, common)).stabilizationStrength > 0.0f);
    settings.maxStabilizedFrameNum = 0;
    REQUIRE(SetDenoiserSettings(*instance, 0, settings) == Result::SUCCESS);
    requestFrame(*instance, common);
    settings.maxStabilizedFrameNum = 63;
    REQUIRE(SetDenoiserSettings(*instance, 0, settings) == Result::SUCCESS);
    CHECK(reblurConstants(requestFrame(*instance, common)).stabilizationStrength == 0.0f);
    CHECK(reblurConstants(requestFrame(*instance, common)).stabilizationStrength > 0.0f);
}
