// The overlay as a pass like any other: there when it is asked for, and nowhere else.
#include "denoiser_constants.h"
#include "fixture.h"
#include <algorithm>

using namespace test;
using nrd::shared::DenoiserConstants;

namespace
{
constexpr Denoiser kDenoisers[] = {Denoiser::REBLUR_DIFFUSE, Denoiser::REBLUR_SPECULAR, kReblurBoth,
                                   Denoiser::REBLUR_SPECULAR_OCCLUSION, Denoiser::REBLUR_DIFFUSE_SPECULAR_SH};

// Null where the slot is not listed at all.
const ResourceRequirement* findRequirement(const Instance& instance, ResourceType type)
{
    const ResourceRequirement* list = nullptr;
    uint32_t num = 0;
    REQUIRE(GetRequiredResources(instance, 0, list, num) == Result::SUCCESS);
    const auto found = std::find_if(list, list + num, [=](const ResourceRequirement& r) { return r.type == type; });
    return found == list + num ? nullptr : found;
}

bool isBound(const DispatchDesc& dispatch, ResourceType type)
{
    const auto is = [=](const ResourceDesc& r) { return r.type == type; };
    return std::any_of(dispatch.resources, dispatch.resources + dispatch.resourcesNum, is);
}

size_t countBound(const std::vector<DispatchDesc>& dispatches, ResourceType type)
{
    const auto is = [=](const DispatchDesc& dispatch) { return isBound(dispatch, type); };
    return static_cast<size_t>(std::count_if(dispatches.begin(), dispatches.end(), is));
}
} // namespace

TEST_CASE("OUT_VALIDATION is required while it is enabled, and bound by the last pass alone", "[unit]")
{
    for (const Denoiser denoiser : kDenoisers)
    {
        INFO(toString(denoiser));
        const InstancePtr instance = makeInstance({denoiser});
        CommonSettings common = makeCommon();
        CHECK(countBound(requestFrame(*instance, common), ResourceType::OUT_VALIDATION) == 0); // clears included
        const ResourceRequirement* requirement = findRequirement(*instance, ResourceType::OUT_VALIDATION);
        REQUIRE(requirement);
        CHECK_FALSE(requirement->isRequired);

        common.enableValidation = true;
        for (const AccumulationMode mode : {AccumulationMode::CONTINUE, AccumulationMode::CLEAR_AND_RESTART})
        {
            common.accumulationMode = mode;
            const std::vector<DispatchDesc> dispatches = requestFrame(*instance, common);
            CHECK(passNames(dispatches).back() == "Validation");
            CHECK(countBound(dispatches, ResourceType::OUT_VALIDATION) == 1);
        }
        requirement = findRequirement(*instance, ResourceType::OUT_VALIDATION);
        REQUIRE(requirement);
        CHECK(requirement->isRequired);
        CHECK(requirement->descriptorType == DescriptorType::STORAGE_TEXTURE);
        CHECK(requirement->minFormat == Format::RGBA8_UNORM);
    }
}

TEST_CASE("the overlay changes no pipeline of the other passes", "[unit]")
{
    const InstancePtr instance = makeInstance({kReblurBoth});
    CommonSettings common = makeCommon();
    requestFrame(*instance, common);
    const auto pipelinesOf = [](const std::vector<DispatchDesc>& dispatches)
    {
        std::vector<uint16_t> pipelines;
        for (const DispatchDesc& dispatch : dispatches) pipelines.push_back(dispatch.pipelineIndex);
        return pipelines;
    };
    const std::vector<uint16_t> off = pipelinesOf(requestFrame(*instance, common));
    common.enableValidation = true;
    std::vector<uint16_t> on = pipelinesOf(requestFrame(*instance, common));
    common.enableValidation = false;
    CHECK(pipelinesOf(requestFrame(*instance, common)) == off);

    REQUIRE(on.size() == off.size() + 1);
    on.pop_back();
    CHECK(on == off);
}

TEST_CASE("where only the input is shown the overlay reads nothing that nobody wrote", "[unit]")
{
    const InstancePtr instance = makeInstance({kReblurBoth});
    CommonSettings common = makeCommon();
    requestFrame(*instance, common);
    common.splitScreen = 1.0f;
    common.enableValidation = true;
    const std::vector<DispatchDesc> dispatches = requestFrame(*instance, common);
    const DispatchDesc* pass = findPass(dispatches, "Validation");
    REQUIRE(pass);
    CHECK_FALSE(isBound(*pass, ResourceType::TRANSIENT_POOL));
    CHECK_FALSE(isBound(*pass, ResourceType::PERMANENT_POOL));
    CHECK(isBound(*pass, ResourceType::IN_MV));
}

TEST_CASE("REFERENCE has no overlay and does not mind", "[unit]")
{
    const InstancePtr instance = makeInstance({Denoiser::REFERENCE});
    CommonSettings common = makeCommon();
    common.enableValidation = true;
    CHECK(countBound(requestFrame(*instance, common), ResourceType::OUT_VALIDATION) == 0);
    CHECK(findRequirement(*instance, ResourceType::OUT_VALIDATION) == nullptr);
}

TEST_CASE("the overlay is told where camera and sample lie", "[unit]")
{
    const InstancePtr instance = makeInstance({kReblurBoth});
    CommonSettings common = makeCommon();
    requestFrame(*instance, common);
    setCameraPosition(common.worldToViewMatrix, 3.25f, -1.5f, 1030.0f);
    common.cameraJitter[0] = 0.25f;
    common.cameraJitter[1] = -0.375f;
    common.cameraJitterPrev[0] = 0.125f;
    const std::vector<DispatchDesc> dispatches = requestFrame(*instance, common);
    const DenoiserConstants& g = constantsOf<DenoiserConstants>(dispatches.back());
    CHECK(g.cameraPosition.x == 3.25f);
    CHECK(g.cameraPosition.y == 1022.5f);
    CHECK(g.cameraPosition.z == 6.0f);
    CHECK(g.cameraJitter.x == 0.25f);
    CHECK(g.cameraJitter.y == -0.375f);
    CHECK(g.cameraJitter.z == 0.125f);
}
