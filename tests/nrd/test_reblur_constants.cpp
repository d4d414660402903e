#include "denoisers/reblur.h"
#include "expand.h"
#include "fixture.h"
#include "frame_state.h"
#include <cmath>

using namespace test;
using nrd::shared::DenoiserConstants;

namespace
{
struct Inputs
{
    CommonSettings common = makeCommon();
    ReblurSettings settings;
    RequestHistory history;
    bool isReset = false;

    Inputs()
    {
        history.isValid = history.isStabilized = true;
        history.splitScreen = 0.125f;
    }

    DenoiserConstants make() const
    {
        const FamilySettings family = settings;
        const FrameState frame = makeFrameState(common, frameRateScale(common.timeDeltaBetweenFrames));
        const Program program = expand(findVariant(Denoiser::REBLUR_DIFFUSE_SPECULAR), NormalEncoding::RGBA16_SNORM);
        return makeReblurConstants({common, common, family, frame, history, *program.variant, isReset, 1, 1});
    }
};

double degrees(const nrd::shared::vec4& rotator)
{
    CHECK(rotator.x == rotator.w);
    CHECK(rotator.y == -rotator.z);
    CHECK(rotator.x * rotator.x + rotator.y * rotator.y == Approx(1.0f));
    return std::atan2(double{rotator.y}, double{rotator.x}) * 180.0 / 3.14159265358979323846;
}
} // namespace

TEST_CASE("kernels turn by the golden ratio as specified", "[unit]")
{
    const double prePass[] = {63.640, 29.263, 84.886, 50.509};
    const double blur[] = {51.962, 17.585, 73.208, 38.831};
    Inputs inputs;
    for (uint32_t frame = 0; frame < 4; frame++)
    {
        inputs.common.frameIndex = frame;
        const DenoiserConstants g = inputs.make();
        CHECK(degrees(g.rotatorPrePass) == Approx(prePass[frame]).margin(1e-3));
        CHECK(degrees(g.rotatorBlur) == Approx(blur[frame]).margin(1e-3));
        CHECK(degrees(g.rotatorPostBlur) == Approx(blur[frame] + 22.5).margin(1e-3));
    }
    inputs.common.frameIndex = 0xFFFFFFFFu; // one frame before 0
    CHECK(degrees(inputs.make().rotatorPrePass) == Approx(63.640 + 34.377 - 90.0).margin(2e-3));
}

TEST_CASE("derived REBLUR settings are those of the specification", "[unit]")
{
    Inputs inputs;
    const DenoiserConstants g = inputs.make();
    CHECK(g.maxAccumulatedFrameNum.y == 40.0f);
    CHECK(g.maxFastAccumulatedFrameNum.x == 6.0f);
    CHECK(g.lobeAngleFraction == Approx(0.0225f));
    CHECK(g.stabilizationStrength == Approx(63.0f / 64.0f));
    CHECK(g.fastClampSigmaScale == 2.0f);
    CHECK(g.frameRateScale == Approx(2.0f));
    CHECK(g.disocclusionThreshold == Approx(0.01f + 1.0f / 60.0f));
    CHECK(g.disocclusionThresholdAlternate == Approx(0.05f + 1.0f / 60.0f));
    CHECK(g.splitScreenPrev == 0.125f);
    CHECK(g.isHistoryReset == 0);
    CHECK(g.rectSizeMinusOne.x == 99);
    CHECK(g.rectSizeInv.y == 1.0f / 60.0f);
    CHECK(g.historyFixStride == 14.0f);

    inputs.settings.maxBlurRadius = 1.0f; // half way to no spatial filter
    CHECK(inputs.make().fastClampSigmaScale == Approx(2.5f));
    inputs.settings.maxBlurRadius = 0.0f;
    CHECK(inputs.make().fastClampSigmaScale == Approx(3.0f));
    CHECK(inputs.make().maxBlurRadius == inputs.settings.minBlurRadius);
}

TEST_CASE("the convergence constants give the specified factor", "[unit]")
{
    const DenoiserConstants g = Inputs().make();
    const auto beta = [&](float n)
    {
        const float t = std::min(n * g.convergenceLengthInv, 1.0f);
        return 1.0f / (1.0f + (g.convergence.x + g.convergence.y * t) * n);
    };
    CHECK(beta(1.0f) == Approx(0.8814f).epsilon(1e-3));
    CHECK(beta(3.0f) == Approx(0.6707f).epsilon(1e-3));
    CHECK(beta(16.0f) == Approx(0.1505f).epsilon(1e-3));
    CHECK(beta(40.0f) == Approx(0.04f).epsilon(1e-3));
}

TEST_CASE("radii follow the root of the rectangle's height", "[unit]")
{
    Inputs inputs;
    inputs.settings.prePassMode = PrePassMode::SIMPLE;
    inputs.common.rectSize[0] = 50;
    inputs.common.rectSize[1] = 40; // a sixth of the radii at 1440 lines
    const DenoiserConstants g = inputs.make();
    CHECK(g.maxBlurRadius == Approx(5.0f));
    CHECK(g.diffusePrepassRadius == Approx(3.0f));
    CHECK(g.specularPrepassRadius == Approx(6.0f));
    CHECK(g.minBlurRadius == 1.0f);
    CHECK(g.resourceSizeInv.x == 1.0f / 100.0f);
}

TEST_CASE("a reset leaves no history to the shaders", "[unit]")
{
    Inputs inputs;
    inputs.isReset = true;
    inputs.common.splitScreen = 0.5f;
    const DenoiserConstants g = inputs.make();
    CHECK(g.isHistoryReset == 1);
    CHECK(g.maxAccumulatedFrameNum.y == 0.0f);
    CHECK(g.maxFastAccumulatedFrameNum.x == 0.0f);
    CHECK(g.stabilizationStrength == 0.0f);
    CHECK(g.splitScreenPrev == 0.5f);
}
