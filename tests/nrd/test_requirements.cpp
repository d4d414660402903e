#include "fixture.h"
#include <map>

using namespace test;

namespace
{
std::vector<ResourceRequirement> requirements(const Instance& instance, Identifier identifier = 0)
{
    const ResourceRequirement* list = nullptr;
    uint32_t num = 0;
    REQUIRE(GetRequiredResources(instance, identifier, list, num) == Result::SUCCESS);
    return {list, list + num};
}

std::map<ResourceType, ResourceRequirement> byType(const Instance& instance)
{
    std::map<ResourceType, ResourceRequirement> result;
    for (const ResourceRequirement& r : requirements(instance)) CHECK(result.emplace(r.type, r).second);
    return result;
}
} // namespace

TEST_CASE("requirements name what the emitted passes bind, inputs first", "[unit]")
{
    const InstancePtr instance = makeInstance({kReblurBoth});
    CommonSettings common = makeCommon();
    common.isHistoryConfidenceAvailable = true;
    common.isDisocclusionThresholdMixAvailable = true;
    common.isSpecularMotionAvailable = true;
    const std::vector<DispatchDesc> dispatches = requestFrame(*instance, common);
    std::map<ResourceType, bool> bound;
    for (const DispatchDesc& dispatch : dispatches)
    {
        for (uint32_t i = 0; i < dispatch.resourcesNum; i++)
        {
            if (!isPool(dispatch.resources[i].type)) bound[dispatch.resources[i].type] = true;
        }
    }
    bool hasOutput = false;
    size_t requiredNum = 0;
    for (const ResourceRequirement& r : requirements(*instance))
    {
        INFO(toString(r.type));
        CHECK(r.isRequired == (bound.count(r.type) == 1));
        CHECK(r.minFormat < Format::MAX_NUM);
        const bool isOutput = r.descriptorType == DescriptorType::STORAGE_TEXTURE;
        CHECK_FALSE((hasOutput && !isOutput));
        hasOutput = hasOutput || isOutput;
        requiredNum += r.isRequired ? 1 : 0;
    }
    CHECK(requiredNum == bound.size());
    CHECK(hasOutput);
}

TEST_CASE("optional inputs are listed as optional until the settings ask for them", "[unit]")
{
    const InstancePtr instance = makeInstance({kReblurBoth});
    CommonSettings common = makeCommon();
    REQUIRE(SetCommonSettings(*instance, common) == Result::SUCCESS);
    auto list = byType(*instance);
    REQUIRE(list.count(ResourceType::IN_SPEC_CONFIDENCE) == 1);
    CHECK_FALSE(list[ResourceType::IN_SPEC_CONFIDENCE].isRequired);
    REQUIRE(list.count(ResourceType::IN_SPEC_MV) == 1);
    CHECK_FALSE(list[ResourceType::IN_SPEC_MV].isRequired);
    CHECK(list[ResourceType::IN_MV].isRequired);
    CHECK(list[ResourceType::IN_MV].minFormat == Format::RG16_SFLOAT);
    CHECK(list[ResourceType::IN_NORMAL_ROUGHNESS].minFormat == Format::A2B10G10R10_UNORM_PACK32);
    CHECK(list[ResourceType::OUT_DIFF_RADIANCE_HITDIST].descriptorType == DescriptorType::STORAGE_TEXTURE);
    CHECK(list[ResourceType::OUT_DIFF_RADIANCE_HITDIST].isReadBack);
    CHECK_FALSE(list[ResourceType::IN_MV].isReadBack);

    common.isHistoryConfidenceAvailable = true;
    common.isSpecularMotionAvailable = true;
    common.isMotionVectorInWorldSpace = true;
    REQUIRE(SetCommonSettings(*instance, common) == Result::SUCCESS);
    list = byType(*instance);
    CHECK(list[ResourceType::IN_SPEC_CONFIDENCE].isRequired);
    CHECK(list[ResourceType::IN_SPEC_MV].isRequired);
    CHECK(list[ResourceType::IN_SPEC_MV].minFormat == Format::RGBA16_SFLOAT);
    CHECK(list[ResourceType::IN_MV].minFormat == Format::RGBA16_SFLOAT);

    common.splitScreen = 1.0f;
    REQUIRE(SetCommonSettings(*instance, common) == Result::SUCCESS);
    list = byType(*instance);
    CHECK_FALSE(list[ResourceType::IN_MV].isRequired);
    CHECK(list[ResourceType::IN_DIFF_RADIANCE_HITDIST].isRequired);
}

TEST_CASE("REFERENCE needs its signal and nothing else", "[unit]")
{
    const InstancePtr instance = makeInstance({Denoiser::REFERENCE});
    const std::vector<ResourceRequirement> list = requirements(*instance);
    REQUIRE(list.size() == 2);
    CHECK(list[0].type == ResourceType::IN_SIGNAL);
    CHECK(list[1].type == ResourceType::OUT_SIGNAL);
}
