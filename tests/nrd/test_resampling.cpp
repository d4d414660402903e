// Denoisers that are smaller than the guides: which images are small, who binds them, and where the pixels lie.
#include "fixture.h"
#include "frame_state.h"
#include <cmath>

using namespace test;

namespace
{
constexpr uint32_t kDivisor = 2;

Result create(Denoiser denoiser, FullSize fullSize, Messages& messages, InstancePtr* created = nullptr)
{
    const DenoiserDesc denoiserDesc = {0, denoiser, kDivisor, true, fullSize};
    InstanceCreationDesc desc;
    desc.denoisers = &denoiserDesc;
    desc.denoisersNum = 1;
    desc.messageSink = messages.sink();
    Instance* instance = nullptr;
    const Result result = CreateInstance(desc, instance);
    InstancePtr owner(instance);
    if (created) *created = std::move(owner);
    return result;
}

InstancePtr make(Denoiser denoiser, FullSize fullSize)
{
    Messages messages;
    InstancePtr instance;
    REQUIRE(create(denoiser, fullSize, messages, &instance) == Result::SUCCESS);
    return instance;
}

bool binds(const DispatchDesc& dispatch, ResourceType type)
{
    for (uint32_t i = 0; i < dispatch.resourcesNum; i++)
        if (dispatch.resources[i].type == type) return true;
    return false;
}

// Texels of the user's images, and nothing of history, say where the divisor counts.
uint32_t divisorOf(Instance& instance, ResourceType type)
{
    const ResourceRequirement* needs = nullptr;
    uint32_t num = 0;
    REQUIRE(GetRequiredResources(instance, 0, needs, num) == Result::SUCCESS);
    for (uint32_t i = 0; i < num; i++)
        if (needs[i].type == type) return needs[i].sizeDivisor;
    return 0;
}

struct Uv
{
    double x, y;
};

Uv project(const CommonSettings& common, const double (&world)[3])
{
    const float(&m)[16] = common.worldToViewMatrix;
    const float(&p)[16] = common.viewToClipMatrix;
    double view[4] = {0, 0, 0, 1}, clip[4] = {};
    for (int row = 0; row < 3; row++)
        view[row] = m[row] * world[0] + m[4 + row] * world[1] + m[8 + row] * world[2] + m[12 + row];
    for (int row = 0; row < 4; row++)
        for (int column = 0; column < 4; column++) clip[row] += p[4 * column + row] * view[column];
    return {0.5 + 0.5 * clip[0] / clip[3], 0.5 - 0.5 * clip[1] / clip[3]};
}
} // namespace

TEST_CASE("a denoiser that cannot be resampled refuses to be, and names the field", "[unit]")
{
    const struct
    {
        Denoiser denoiser;
        FullSize fullSize;
        Result result;
    } cases[] = {{Denoiser::REFERENCE, FullSize::GUIDES_AND_OUTPUTS, Result::INVALID_ARGUMENT},
                 {Denoiser::SIGMA_SHADOW, FullSize::GUIDES_AND_OUTPUTS, Result::SUCCESS},
                 {Denoiser::SIGMA_SHADOW_TRANSLUCENCY, FullSize::EVERYTHING, Result::INVALID_ARGUMENT},
                 {Denoiser::RELAX_DIFFUSE_SH, FullSize::EVERYTHING, Result::SUCCESS},
                 {kReblurBoth, FullSize::MAX_NUM, Result::INVALID_ARGUMENT}};
    for (const auto& c : cases)
    {
        INFO(toString(c.denoiser) << ", " << static_cast<uint32_t>(c.fullSize));
        Messages messages;
        CHECK(create(c.denoiser, c.fullSize, messages) == c.result);
        if (c.result == Result::SUCCESS) continue;
        REQUIRE(messages.texts.size() == 1);
        CHECK_THAT(messages.texts[0], containing("fullSize"));
    }
}

TEST_CASE("half of a checkerboard is not averaged: refused, with the field, and traced pixels may be half", "[unit]")
{
    Messages messages;
    InstancePtr instance;
    REQUIRE(create(Denoiser::RELAX_DIFFUSE, FullSize::EVERYTHING, messages, &instance) == Result::SUCCESS);
    RelaxSettings settings;
    settings.checkerboardMode = CheckerboardMode::WHITE;
    CHECK(SetDenoiserSettings(*instance, 0, settings) == Result::INVALID_ARGUMENT);
    REQUIRE(messages.texts.size() == 1);
    CHECK_THAT(messages.texts[0], containing("checkerboardMode is 2"));
    settings.checkerboardMode = CheckerboardMode::OFF;
    CHECK(SetDenoiserSettings(*instance, 0, settings) == Result::SUCCESS);

    REQUIRE(create(kReblurBoth, FullSize::GUIDES_AND_OUTPUTS, messages, &instance) == Result::SUCCESS);
    ReblurSettings half;
    half.checkerboardMode = CheckerboardMode::BLACK;
    CHECK(SetDenoiserSettings(*instance, 0, half) == Result::SUCCESS);
}

TEST_CASE("what keeps the full size is said of each image", "[unit]")
{
    const InstancePtr nothing = make(kReblurBoth, FullSize::NOTHING);
    const InstancePtr guides = make(kReblurBoth, FullSize::GUIDES_AND_OUTPUTS);
    const InstancePtr everything = make(kReblurBoth, FullSize::EVERYTHING);
    const struct
    {
        ResourceType type;
        uint32_t nothing, guides, everything;
    } cases[] = {{ResourceType::IN_VIEWZ, 2, 1, 1},
                 {ResourceType::IN_MV, 2, 1, 1},
                 {ResourceType::IN_DIFF_RADIANCE_HITDIST, 2, 2, 1},
                 {ResourceType::IN_SPEC_MV, 2, 2, 1},
                 {ResourceType::OUT_SPEC_RADIANCE_HITDIST, 2, 1, 1},
                 {ResourceType::IN_DIFF_CONFIDENCE, 2, 2, 2}};
    for (const auto& c : cases)
    {
        INFO(toString(c.type));
        CHECK(divisorOf(*nothing, c.type) == c.nothing);
        CHECK(divisorOf(*guides, c.type) == c.guides);
        CHECK(divisorOf(*everything, c.type) == c.everything);
    }
}

TEST_CASE("only the resampling passes see signals of the full size", "[unit]")
{
    for (Denoiser denoiser : {Denoiser::REBLUR_DIFFUSE, Denoiser::REBLUR_DIFFUSE_OCCLUSION, Denoiser::RELAX_DIFFUSE_SH})
    {
        INFO(toString(denoiser));
        const InstancePtr instance = make(denoiser, FullSize::EVERYTHING);
        CommonSettings common = makeCommon();
        common.splitScreen = 0.5f;
        requestFrame(*instance, common); // clears
        const std::vector<DispatchDesc> dispatches = requestFrame(*instance, common);
        CHECK(passNames(dispatches).front() == "Downsample");
        CHECK(passNames(dispatches).back() == "Upsample");
        for (uint32_t type = 0; type < static_cast<uint32_t>(ResourceType::TRANSIENT_POOL); type++)
        {
            const ResourceType resource = static_cast<ResourceType>(type);
            const bool isGuide = resource == ResourceType::IN_VIEWZ || resource == ResourceType::IN_NORMAL_ROUGHNESS ||
                                 resource == ResourceType::IN_MV;
            for (size_t i = 1; i + 1 < dispatches.size() && !isGuide; i++) CHECK_FALSE(binds(dispatches[i], resource));
        }
        CHECK(dispatches.back().gridWidth == (common.rectSize[0] + 15u) / 16u);
        CHECK(dispatches.front().gridWidth == ((common.rectSize[0] + 1u) / 2u + 15u) / 16u);
    }
}

TEST_CASE("pixel p of the small screen looks where pixel p * divisor of the full one does", "[unit]")
{
    CommonSettings common = makeCommon();
    common.rectSize[0] = common.rectSizePrev[0] = 101; // odd: the small screen reaches beyond the full one
    common.rectSize[1] = common.rectSizePrev[1] = 57;
    common.isMotionVectorInWorldSpace = false;
    for (uint32_t divisor : {2u, 3u, 8u})
    {
        const CommonSettings picked = atPickedPixels(common, divisor);
        CHECK(picked.rectSize[0] == (101 + divisor - 1) / divisor);
        const double points[][3] = {{0.3, -0.2, 5.0}, {-1.5, 0.9, 4.0}, {0.0, 0.0, 9.0}};
        for (const auto& point : points)
        {
            const Uv full = project(common, point), small = project(picked, point);
            CHECK(small.x * picked.rectSize[0] - 0.5 == Approx((full.x * 101 - 0.5) / divisor).margin(1e-4));
            CHECK(small.y * picked.rectSize[1] - 0.5 == Approx((full.y * 57 - 0.5) / divisor).margin(1e-4));
        }
        // A motion of so many pixels of the full screen.
        const double pixels = common.motionVectorScale[0] * 101.0;
        CHECK(picked.motionVectorScale[0] * picked.rectSize[0] * static_cast<float>(divisor) == Approx(pixels));
    }
}
