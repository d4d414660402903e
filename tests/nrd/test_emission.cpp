#include "denoiser_constants.h"
#include "fixture.h"
#include <algorithm>
#include <set>

using namespace test;

namespace
{
const std::vector<std::string> kSteadyPasses = {"Classify tiles", "Temporal accumulation", "History fix", "Blur",
                                                "Temporal stabilization"};

// An instance whose first frame, the one with the clears, is over.
struct Steady
{
    explicit Steady(const std::vector<Denoiser>& denoisers) : instance(makeInstance(denoisers))
    {
        std::vector<Identifier> all(denoisers.size());
        for (size_t i = 0; i < all.size(); i++) all[i] = static_cast<Identifier>(i);
        requestFrame(*instance, common, all);
    }

    InstancePtr instance;
    CommonSettings common = makeCommon();
};

const ResourceDesc* findUser(const DispatchDesc& dispatch, ResourceType type)
{
    const ResourceDesc* end = dispatch.resources + dispatch.resourcesNum;
    const auto isType = [type](const ResourceDesc& r) { return r.type == type; };
    const ResourceDesc* found = std::find_if(dispatch.resources, end, isType);
    return found == end ? nullptr : found;
}

uint32_t specializationOf(const PipelineDesc& pipeline, uint32_t id)
{
    for (uint32_t i = 0; i < pipeline.specializationConstantsNum; i++)
    {
        if (pipeline.specializationConstants[i].id == id) return pipeline.specializationConstants[i].value;
    }
    return ~0u;
}
} // namespace

TEST_CASE("REBLUR emits its passes in the order of the table", "[unit]")
{
    Steady steady({kReblurBoth});
    const std::vector<DispatchDesc> dispatches = requestFrame(*steady.instance, steady.common);
    CHECK(passNames(dispatches) == kSteadyPasses);
    CHECK(std::string(dispatches[3].name) == "REBLUR_DIFFUSE_SPECULAR - Blur");
    for (const DispatchDesc& dispatch : dispatches)
    {
        CHECK(dispatch.identifier == 0);
        CHECK(dispatch.indirectBufferIndex == kNoBuffer);
    }
}

TEST_CASE("grids cover the rect, tiles one group each", "[unit]")
{
    Steady steady({kReblurBoth});
    steady.common.rectSize[0] = 65;
    steady.common.rectSize[1] = 33;
    ReblurSettings settings;
    settings.prePassMode = PrePassMode::SIMPLE;
    REQUIRE(SetDenoiserSettings(*steady.instance, 0, settings) == Result::SUCCESS);
    const std::vector<DispatchDesc> dispatches = requestFrame(*steady.instance, steady.common);
    const auto grid = [&](const char* name)
    {
        const DispatchDesc* dispatch = findPass(dispatches, name);
        REQUIRE(dispatch);
        return std::make_pair(dispatch->gridWidth, dispatch->gridHeight);
    };
    CHECK(grid("Classify tiles") == std::make_pair(5u, 3u));
    CHECK(grid("Pre-pass") == std::make_pair(9u, 3u));
    CHECK(grid("Blur") == std::make_pair(9u, 3u));
}

TEST_CASE("passes that the settings do not need are not emitted", "[unit]")
{
    Steady steady({kReblurBoth});
    ReblurSettings settings;
    const auto isEmitted = [&](const char* name)
    {
        REQUIRE(SetDenoiserSettings(*steady.instance, 0, settings) == Result::SUCCESS);
        return findPass(requestFrame(*steady.instance, steady.common), name) != nullptr;
    };
    CHECK_FALSE(isEmitted("Pre-pass"));
    settings.hitDistanceReconstructionMode = HitDistanceReconstructionMode::AREA_3X3;
    CHECK(isEmitted("Pre-pass"));
    settings = {};
    settings.prePassMode = PrePassMode::SIMPLE;
    settings.diffusePrepassBlurRadius = 0.0f;
    CHECK(isEmitted("Pre-pass"));
    settings.specularPrepassBlurRadius = 0.0f;
    CHECK_FALSE(isEmitted("Pre-pass"));
}

TEST_CASE("without stabilisation its pass only hands on what was denoised", "[unit]")
{
    Steady steady({kReblurBoth});
    const auto pipelineOf = [&](uint32_t frameNum)
    {
        ReblurSettings settings;
        settings.maxStabilizedFrameNum = frameNum;
        REQUIRE(SetDenoiserSettings(*steady.instance, 0, settings) == Result::SUCCESS);
        const std::vector<DispatchDesc> dispatches = requestFrame(*steady.instance, steady.common);
        const DispatchDesc* pass = findPass(dispatches, "Temporal stabilization");
        REQUIRE(pass);
        return pass->pipelineIndex;
    };
    CHECK(pipelineOf(0) != pipelineOf(20));
}

TEST_CASE("the split screen runs last, and alone when it covers everything", "[unit]")
{
    Steady steady({kReblurBoth});
    steady.common.splitScreen = 0.25f;
    std::vector<std::string> expected = kSteadyPasses;
    expected.emplace_back("Split screen");
    CHECK(passNames(requestFrame(*steady.instance, steady.common)) == expected);
    steady.common.splitScreen = 1.0f;
    CHECK(passNames(requestFrame(*steady.instance, steady.common)) == std::vector<std::string>{"Split screen"});
}

TEST_CASE("denoisers follow the order of the list and share common settings", "[unit]")
{
    Steady steady({kReblurBoth, Denoiser::REFERENCE, kReblurBoth});
    const std::vector<DispatchDesc> dispatches = requestFrame(*steady.instance, steady.common, {2, 1});
    REQUIRE(dispatches.size() == kSteadyPasses.size() + 2);
    CHECK(dispatches.front().identifier == 2);
    CHECK(dispatches.back().identifier == 1);
    CHECK(std::string(dispatches.back().name) == "REFERENCE - Copy");
    CHECK(request(*steady.instance, {0}).size() == kSteadyPasses.size()); // later in the same frame
    CHECK(request(*steady.instance, {}).empty());
}

TEST_CASE("two denoisers of one kind share pipelines and transient textures, but no history", "[unit]")
{
    const InstancePtr one = makeInstance({kReblurBoth});
    Steady two({kReblurBoth, kReblurBoth});
    const InstanceDesc &a = GetInstanceDesc(*one), &b = GetInstanceDesc(*two.instance);
    CHECK(b.pipelinesNum == a.pipelinesNum);
    CHECK(b.transientPoolSize == a.transientPoolSize);
    CHECK(b.permanentPoolSize == 2 * a.permanentPoolSize);

    const std::vector<DispatchDesc> dispatches = requestFrame(*two.instance, two.common, {0, 1});
    std::set<uint16_t> permanent[2], transient[2];
    for (const DispatchDesc& dispatch : dispatches)
    {
        for (uint32_t i = 0; i < dispatch.resourcesNum; i++)
        {
            const ResourceDesc& r = dispatch.resources[i];
            if (r.type == ResourceType::PERMANENT_POOL) permanent[dispatch.identifier].insert(r.indexInPool);
            if (r.type == ResourceType::TRANSIENT_POOL) transient[dispatch.identifier].insert(r.indexInPool);
        }
    }
    for (uint16_t index : permanent[0]) CHECK(permanent[1].count(index) == 0);
    CHECK(transient[0] == transient[1]);
}

TEST_CASE("pipelines are unique, complete and specialised by the encodings", "[unit]")
{
    InstanceCreationDesc creation;
    creation.normalEncoding = NormalEncoding::RGBA16_UNORM;
    creation.roughnessEncoding = RoughnessEncoding::SQ_LINEAR;
    creation.isSoftwareDevice = true;
    const InstancePtr instance = makeInstance({kReblurBoth, Denoiser::REFERENCE, kReblurBoth}, creation);
    const InstanceDesc& desc = GetInstanceDesc(*instance);
    std::set<std::vector<uint32_t>> seen;
    for (uint32_t i = 0; i < desc.pipelinesNum; i++)
    {
        const PipelineDesc& pipeline = desc.pipelines[i];
        CHECK(pipeline.computeShaderSPIRV.words);
        CHECK(pipeline.computeShaderSPIRV.byteSize > 0);
        const std::string name = pipeline.shaderIdentifier;
        std::vector<uint32_t> key(name.begin(), name.end());
        for (uint32_t k = 0; k < pipeline.specializationConstantsNum; k++)
        {
            key.push_back(pipeline.specializationConstants[k].id);
            key.push_back(pipeline.specializationConstants[k].value);
        }
        CHECK(seen.insert(key).second);
        if (!pipeline.hasConstantData) continue;
        CHECK(specializationOf(pipeline, 0) == static_cast<uint32_t>(NormalEncoding::RGBA16_UNORM));
        CHECK(specializationOf(pipeline, 1) == static_cast<uint32_t>(RoughnessEncoding::SQ_LINEAR));
        CHECK(specializationOf(pipeline, 10) == 1); // SPEC_IS_SOFTWARE
    }
}

TEST_CASE("settings pick the pipeline and the optional inputs", "[unit]")
{
    Steady steady({kReblurBoth});
    const PipelineDesc* pipelines = GetInstanceDesc(*steady.instance).pipelines;
    const auto accumulation = [&]()
    {
        const std::vector<DispatchDesc> dispatches = requestFrame(*steady.instance, steady.common);
        return *findPass(dispatches, "Temporal accumulation");
    };
    ReblurSettings settings;
    settings.prePassMode = PrePassMode::SIMPLE;
    REQUIRE(SetDenoiserSettings(*steady.instance, 0, settings) == Result::SUCCESS);
    const DispatchDesc plain = accumulation();
    CHECK(specializationOf(pipelines[plain.pipelineIndex], 2) == 1); // pre-pass
    CHECK(specializationOf(pipelines[plain.pipelineIndex], 3) == 1); // stabilisation
    CHECK(specializationOf(pipelines[plain.pipelineIndex], 4) == 0); // material test
    CHECK(specializationOf(pipelines[plain.pipelineIndex], 5) == 0); // confidence
    CHECK(specializationOf(pipelines[plain.pipelineIndex], 6) == 0); // motion of what is reflected
    CHECK_FALSE(findUser(plain, ResourceType::IN_DIFF_CONFIDENCE));
    CHECK_FALSE(findUser(plain, ResourceType::IN_DIFF_RADIANCE_HITDIST)); // the pre-pass's result instead

    steady.common.isHistoryConfidenceAvailable = true;
    steady.common.isDisocclusionThresholdMixAvailable = true;
    steady.common.isSpecularMotionAvailable = true;
    steady.common.strandMaterialID = 2;
    settings.prePassMode = PrePassMode::AUTO;
    REQUIRE(SetDenoiserSettings(*steady.instance, 0, settings) == Result::SUCCESS);
    const DispatchDesc all = accumulation();
    CHECK(specializationOf(pipelines[all.pipelineIndex], 2) == 0);
    CHECK(specializationOf(pipelines[all.pipelineIndex], 4) == 1);
    CHECK(specializationOf(pipelines[all.pipelineIndex], 5) == 1);
    CHECK(specializationOf(pipelines[all.pipelineIndex], 6) == 1);
    CHECK(all.resourcesNum == plain.resourcesNum);
    for (ResourceType type : {ResourceType::IN_DIFF_CONFIDENCE, ResourceType::IN_SPEC_CONFIDENCE,
                              ResourceType::IN_DISOCCLUSION_THRESHOLD_MIX, ResourceType::IN_SPEC_MV,
                              ResourceType::IN_DIFF_RADIANCE_HITDIST, ResourceType::IN_SPEC_RADIANCE_HITDIST})
    {
        INFO(toString(type));
        CHECK(findUser(all, type));
    }
}

TEST_CASE("states follow the use, and what is read and written at once is in one state", "[unit]")
{
    Steady steady({kReblurBoth});
    size_t bothNum = 0;
    for (const DispatchDesc& dispatch : requestFrame(*steady.instance, steady.common))
    {
        INFO(dispatch.name);
        for (uint32_t i = 0; i < dispatch.resourcesNum; i++)
        {
            const ResourceDesc& r = dispatch.resources[i];
            const PipelineDesc& pipeline = GetInstanceDesc(*steady.instance).pipelines[dispatch.pipelineIndex];
            CHECK((r.descriptorType == DescriptorType::TEXTURE) == (i < pipeline.texturesNum));
            if (r.state == ResourceState::SAMPLED_AND_STORAGE)
                bothNum++;
            else
                CHECK((r.state == ResourceState::SAMPLED) == (r.descriptorType == DescriptorType::TEXTURE));
        }
    }
    CHECK(bothNum == 4); // the stabilisation works in place on two textures
}

TEST_CASE("ping-pong textures change places with every request of their denoiser, whatever the frame index", "[unit]")
{
    Steady steady({kReblurBoth, kReblurBoth});
    const InstanceDesc& desc = GetInstanceDesc(*steady.instance);
    REQUIRE(desc.denoisersNum == 2);
    CHECK(desc.denoisers[0].historyPeriod == 2);
    const auto track = [&](Identifier identifier) { // read as the previous one, written
        steady.common.frameIndex += 7;
        const std::vector<DispatchDesc> dispatches = requestFrame(*steady.instance, steady.common, {identifier});
        const DispatchDesc* pass = findPass(dispatches, "Temporal accumulation");
        const uint32_t readNum = desc.pipelines[pass->pipelineIndex].texturesNum;
        return std::make_pair(pass->resources[readNum - 3].indexInPool,             // IN_SPEC_MV and the cap follow
                              pass->resources[pass->resourcesNum - 2].indexInPool); // the last is the overlay's
    };
    const auto first = track(0), second = track(0);
    CHECK(first.first != first.second);
    CHECK(second.first == first.second);
    CHECK(second.second == first.first);
    track(1); // another denoiser's requests do not matter
    CHECK(track(0) == first);
}

TEST_CASE("constants are said to repeat only where they do", "[unit]")
{
    Steady steady({kReblurBoth, Denoiser::REFERENCE, kReblurBoth});
    const std::vector<DispatchDesc> dispatches = requestFrame(*steady.instance, steady.common, {0, 2, 1});
    CHECK_FALSE(dispatches[0].constantBufferDataMatchesPreviousDispatch);
    for (size_t i = 1; i < dispatches.size(); i++)
    {
        const DispatchDesc &a = dispatches[i - 1], &b = dispatches[i];
        const bool isEqual =
            a.constantBufferDataSize == b.constantBufferDataSize &&
            std::equal(a.constantBufferData, a.constantBufferData + a.constantBufferDataSize, b.constantBufferData);
        INFO(b.name);
        CHECK(b.constantBufferDataMatchesPreviousDispatch == isEqual);
        CHECK(b.constantBufferDataSize <= GetInstanceDesc(*steady.instance).constantBufferMaxDataSize);
        CHECK(reinterpret_cast<uintptr_t>(b.constantBufferData) % 16 == 0);
    }
}

TEST_CASE("an instance without denoisers is allowed and empty", "[unit]")
{
    const InstancePtr instance = makeInstance({});
    CommonSettings common = makeCommon();
    CHECK(requestFrame(*instance, common, {}).empty());
    CHECK(GetInstanceDesc(*instance).pipelinesNum == 0);
}

TEST_CASE("the library says what it offers", "[unit]")
{
    const LibraryDesc& desc = GetLibraryDesc();
    CHECK(desc.headerVersion == kHeaderVersion);
    const std::set<Denoiser> offered(desc.supportedDenoisers, desc.supportedDenoisers + desc.supportedDenoisersNum);
    CHECK(offered.size() == desc.supportedDenoisersNum);
    CHECK(offered.count(kReblurBoth) == 1);
    CHECK(offered.count(Denoiser::REFERENCE) == 1);
    for (Denoiser denoiser : offered) makeInstance({denoiser});
}
