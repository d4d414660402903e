// History confidence as the descriptor library sees it: a pass table that stands among denoisers and is none.
#include "allocation_counter.h"
#include "confidence_constants.h"
#include "fixture.h"
#include "validate.h"
#include <algorithm>

using namespace test;

namespace
{
InstancePtr makeWithConfidence(uint32_t tileSize, Messages* messages = nullptr)
{
    InstanceCreationDesc desc;
    desc.confidenceTileSize = tileSize;
    if (messages) desc.messageSink = messages->sink();
    return makeInstance({kReblurBoth}, desc);
}

Result create(InstanceCreationDesc desc, const DenoiserDesc& denoiser, Messages& messages)
{
    desc.denoisers = &denoiser;
    desc.denoisersNum = 1;
    desc.messageSink = messages.sink();
    Instance* instance = nullptr;
    const Result result = CreateInstance(desc, instance);
    DestroyInstance(instance);
    return result;
}

std::vector<ResourceType> boundBy(const DispatchDesc& dispatch, DescriptorType type)
{
    std::vector<ResourceType> types;
    for (uint32_t i = 0; i < dispatch.resourcesNum; i++)
        if (dispatch.resources[i].descriptorType == type) types.push_back(dispatch.resources[i].type);
    return types;
}

// Steady state: the frame after the first has no clears.
std::vector<DispatchDesc> steadyFrame(Instance& instance, CommonSettings common)
{
    requestFrame(instance, common, {kConfidenceIdentifier});
    return requestFrame(instance, common, {kConfidenceIdentifier});
}

void requireRefused(const ConfidenceSettings& bad, const std::string& text)
{
    const nrd::Error error = findError(bad);
    CHECK(error.result == Result::INVALID_ARGUMENT);
    CHECK(std::string(error.text.c_str()) == "ConfidenceSettings::" + text);
}
} // namespace

TEST_CASE("confidence is made by a gradient, as many blurs as are asked for, and a result", "[unit]")
{
    const InstancePtr instance = makeWithConfidence(5);
    for (uint32_t num = 0; num <= 5; num++)
    {
        ConfidenceSettings settings;
        settings.blurPassNum = num;
        REQUIRE(SetConfidenceSettings(*instance, settings) == Result::SUCCESS);
        const std::vector<DispatchDesc> dispatches = steadyFrame(*instance, makeCommon());
        std::vector<std::string> expected = {"Gradient"};
        expected.insert(expected.end(), num, "Blur");
        expected.push_back("Confidence");
        CHECK(passNames(dispatches) == expected);
        CHECK(std::string(dispatches.front().name) == "CONFIDENCE - Gradient");
        CHECK(boundBy(dispatches.front(), DescriptorType::TEXTURE) ==
              std::vector<ResourceType>{ResourceType::IN_STORED_SAMPLE, ResourceType::IN_RETRACED_SAMPLE});
        CHECK(boundBy(dispatches.back(), DescriptorType::STORAGE_TEXTURE) ==
              std::vector<ResourceType>{ResourceType::IN_DIFF_CONFIDENCE, ResourceType::IN_SPEC_CONFIDENCE});
        // What the result reads is what was written last.
        const DispatchDesc& last = dispatches[dispatches.size() - 2];
        CHECK(dispatches.back().resources[0].indexInPool == last.resources[last.resourcesNum - 1].indexInPool);
    }
}

TEST_CASE("blurs lie further and further apart", "[unit]")
{
    const InstancePtr instance = makeWithConfidence(5);
    ConfidenceSettings settings;
    settings.blurPassNum = 5;
    REQUIRE(SetConfidenceSettings(*instance, settings) == Result::SUCCESS);
    std::vector<uint32_t> strides;
    for (const DispatchDesc& dispatch : steadyFrame(*instance, makeCommon()))
    {
        const PipelineDesc& pipeline = GetInstanceDesc(*instance).pipelines[dispatch.pipelineIndex];
        if (std::string(pipeline.shaderIdentifier) != "ConfidenceBlur") continue;
        for (uint32_t i = 0; i < pipeline.specializationConstantsNum; i++)
            if (pipeline.specializationConstants[i].id == 9) // SPEC_STEP
                strides.push_back(pipeline.specializationConstants[i].value);
    }
    CHECK(strides == std::vector<uint32_t>{1, 2, 3, 4, 5});
}

TEST_CASE("confidence spans the resource in tiles, whatever the rectangle", "[unit]")
{
    const InstancePtr instance = makeWithConfidence(5);
    CommonSettings common = makeCommon();
    for (auto size : {&common.rectSize, &common.rectSizePrev})
    {
        (*size)[0] = 51;
        (*size)[1] = 30;
    }
    for (const DispatchDesc& dispatch : steadyFrame(*instance, common))
    {
        CHECK(dispatch.gridWidth == 3);  // 100 pixels are 20 tiles
        CHECK(dispatch.gridHeight == 2); // 60 are 12
        const auto& g = constantsOf<shared::ConfidenceConstants>(dispatch);
        CHECK(g.rectSizePrev.x == 11.0f);
        CHECK(g.rectSizePrev.y == 6.0f);
        CHECK(g.outputSizeInv.x == 1.0f / 20.0f);
    }
}

TEST_CASE("confidence keeps nothing, stands in a list before what reads it, and may be made again", "[unit]")
{
    const InstancePtr with = makeWithConfidence(8), without = makeWithConfidence(0);
    CHECK(GetInstanceDesc(*with).permanentPoolSize == GetInstanceDesc(*without).permanentPoolSize);
    CHECK(GetInstanceDesc(*with).denoisersNum == 1);
    CommonSettings common = makeCommon();
    common.isHistoryConfidenceAvailable = true;
    requestFrame(*with, common, {kConfidenceIdentifier, 0});
    const std::vector<DispatchDesc> dispatches = requestFrame(*with, common, {kConfidenceIdentifier, 0});
    const DispatchDesc* result = findPass(dispatches, "Confidence");
    const DispatchDesc* reader = findPass(dispatches, "Temporal accumulation");
    REQUIRE(result);
    REQUIRE(reader);
    CHECK(result < reader);
    CHECK(result->identifier == kConfidenceIdentifier);
    const std::vector<ResourceType> read = boundBy(*reader, DescriptorType::TEXTURE);
    CHECK(std::count(read.begin(), read.end(), ResourceType::IN_SPEC_CONFIDENCE) == 1);
    CHECK(request(*with, {kConfidenceIdentifier}).size() == 5);
}

TEST_CASE("confidence allocates nothing once it is created", "[unit]")
{
    const InstancePtr instance = makeWithConfidence(5);
    CommonSettings common = makeCommon();
    const Identifier identifiers[] = {kConfidenceIdentifier, 0};
    const DispatchDesc* dispatches = nullptr;
    uint32_t num = 0;
    const size_t before = allocationNum();
    bool isFine = true;
    for (uint32_t frame = 0; frame < 4; frame++)
    {
        common.frameIndex = frame;
        isFine = isFine && SetCommonSettings(*instance, common) == Result::SUCCESS;
        isFine = isFine && SetConfidenceSettings(*instance, {}) == Result::SUCCESS;
        isFine = isFine && GetComputeDispatches(*instance, identifiers, 2, dispatches, num) == Result::SUCCESS;
    }
    const size_t after = allocationNum();
    CHECK(isFine);
    CHECK(after == before);
}

TEST_CASE("confidence says what it needs", "[unit]")
{
    const InstancePtr instance = makeWithConfidence(5);
    const ResourceRequirement* list = nullptr;
    uint32_t num = 0;
    REQUIRE(GetRequiredResources(*instance, kConfidenceIdentifier, list, num) == Result::SUCCESS);
    struct Row
    {
        ResourceType type;
        DescriptorType descriptor;
        Format format;
    };
    const Row expected[] = {
        {ResourceType::IN_DIFF_CONFIDENCE, DescriptorType::STORAGE_TEXTURE, Format::R8_UNORM},
        {ResourceType::IN_SPEC_CONFIDENCE, DescriptorType::STORAGE_TEXTURE, Format::R8_UNORM},
        {ResourceType::IN_STORED_SAMPLE, DescriptorType::TEXTURE, Format::RGBA16_SFLOAT},
        {ResourceType::IN_RETRACED_SAMPLE, DescriptorType::TEXTURE, Format::RGBA16_SFLOAT},
        {ResourceType::IN_STORED_NORMAL_ROUGHNESS, DescriptorType::TEXTURE, Format::A2B10G10R10_UNORM_PACK32},
    };
    REQUIRE(num == std::size(expected));
    for (uint32_t i = 0; i < num; i++)
    {
        INFO(toString(expected[i].type));
        CHECK(list[i].type == expected[i].type);
        CHECK(list[i].descriptorType == expected[i].descriptor);
        CHECK(list[i].minFormat == expected[i].format);
        CHECK(list[i].isRequired);
        CHECK_FALSE(list[i].isReadBack);
    }
}

TEST_CASE("an instance without tiles makes no confidence, and its identifier is nobody else's", "[unit]")
{
    Messages messages;
    const InstancePtr instance = makeWithConfidence(0, &messages);
    CHECK(SetConfidenceSettings(*instance, {}) == Result::INVALID_ARGUMENT);
    REQUIRE(messages.texts.size() == 1);
    CHECK_THAT(messages.texts[0], containing("InstanceCreationDesc::confidenceTileSize is 0, expected [1; 8]"));

    InstanceCreationDesc desc;
    desc.confidenceTileSize = 9;
    CHECK(create(desc, {0, kReblurBoth}, messages) == Result::INVALID_ARGUMENT);
    CHECK_THAT(messages.texts.back(), containing("confidenceTileSize is 9, expected [0; 8]"));
    CHECK(create({}, {kConfidenceIdentifier, kReblurBoth}, messages) == Result::NON_UNIQUE_IDENTIFIER);
    CHECK_THAT(messages.texts.back(), containing("kConfidenceIdentifier"));
}

TEST_CASE("settings of confidence out of range are refused by name, and those of a denoiser are none", "[unit]")
{
    using S = ConfidenceSettings;
    const auto with = [](auto change)
    {
        S settings;
        change(settings);
        return settings;
    };
    CHECK_FALSE(findError(S{}));
    requireRefused(with([](S& s) { s.sensitivity = 0.0f; }), "sensitivity is 0, expected (0; 100]");
    requireRefused(with([](S& s) { s.sensitivity = 101.0f; }), "sensitivity is 101, expected (0; 100]");
    requireRefused(with([](S& s) { s.tolerance = -0.5f; }), "tolerance is -0.5, expected [0; 1]");
    requireRefused(with([](S& s) { s.minLuminance = 0.0f; }), "minLuminance is 0, expected (0; 65504]");
    requireRefused(with([](S& s) { s.maxLuminance = 1e6f; }), "maxLuminance is 1e+06, expected (0; 65504]");
    requireRefused(with([](S& s) { s.planeDistanceSensitivity = 2.0f; }),
                   "planeDistanceSensitivity is 2, expected (0; 1]");
    requireRefused(with([](S& s) { s.blurPassNum = 6; }), "blurPassNum is 6, expected [0; 5]");

    Messages messages;
    const InstancePtr instance = makeWithConfidence(5, &messages);
    CHECK(SetDenoiserSettings(*instance, kConfidenceIdentifier, ReblurSettings{}) == Result::INVALID_ARGUMENT);
    REQUIRE(messages.texts.size() == 1);
    CHECK_THAT(messages.texts[0], containing("which is CONFIDENCE"));
}
