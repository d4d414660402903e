// nrd::Instance: instances are independent.
#include "catch.h"
#include "digest.h"
#include "side_by_side.h"
#include "valid_settings.h"
#include <vector>

using namespace nrd;

namespace
{
constexpr uint32_t kFrameNum = 120;
constexpr uint32_t kDenoiserNum = static_cast<uint32_t>(Denoiser::MAX_NUM);
constexpr Identifier kStranger = 1000;

// All denoisers in one instance, each under its own number.
Result create(Instance*& instance)
{
    std::vector<DenoiserDesc> denoisers(kDenoiserNum);
    for (uint32_t i = 0; i < kDenoiserNum; i++) denoisers[i] = {i, static_cast<Denoiser>(i)};
    InstanceCreationDesc desc;
    desc.denoisers = denoisers.data();
    desc.denoisersNum = kDenoiserNum;
    return CreateInstance(desc, instance);
}

CommonSettings settingsOf(uint32_t worker, uint32_t frame)
{
    CommonSettings settings = test::makeCommon();
    const auto x = static_cast<float>(frame);
    test::setCameraPosition(settings.worldToViewMatrix, 0.1f * x, static_cast<float>(worker), 0.0f);
    test::setCameraPosition(settings.worldToViewMatrixPrev, 0.1f * (x - 1.0f), static_cast<float>(worker), 0.0f);
    settings.frameIndex = frame;
    settings.resourceSize[0] = settings.resourceSizePrev[0] = static_cast<uint16_t>(100 + worker);
    return settings;
}

void denoise(Instance& instance, Identifier identifier, test::Digest& digest)
{
    ReblurSettings settings;
    settings.maxAccumulatedFrameNum = 1 + identifier;
    digest.add(SetDenoiserSettings(instance, identifier, settings)); // refused by the other families
    const DispatchDesc* dispatches = nullptr;
    uint32_t dispatchNum = 0;
    digest.add(GetComputeDispatches(instance, &identifier, 1, dispatches, dispatchNum));
    for (uint32_t i = 0; i < dispatchNum; i++) digest.add(dispatches[i]);
    const ResourceRequirement* needs = nullptr;
    uint32_t needNum = 0;
    digest.add(GetRequiredResources(instance, identifier, needs, needNum));
    for (uint32_t i = 0; i < needNum; i++) digest.add(toString(needs[i].type));
    digest.add(GetLastMessage(instance));
}

// Two instances in turn, as of an engine with two views, made anew halfway.
uint64_t renderTwoViews(uint32_t worker)
{
    test::Digest digest;
    for (uint32_t half = 0; half < 2; half++)
    {
        Instance* views[2] = {};
        for (Instance*& view : views) digest.add(create(view));
        for (uint32_t frame = 0; frame < kFrameNum / 2; frame++)
            for (Instance* view : views)
            {
                digest.add(SetCommonSettings(*view, settingsOf(worker, frame)));
                for (Identifier identifier = 0; identifier < kDenoiserNum; identifier++)
                    denoise(*view, identifier, digest);
                denoise(*view, kStranger + worker, digest);
            }
        for (Instance* view : views) DestroyInstance(view);
    }
    return digest.value();
}
} // namespace

TEST_CASE("instances on four threads emit what each of them emits alone", "[unit]")
{
    test::requireUndisturbed(renderTwoViews);
}
