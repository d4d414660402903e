// Panes of coloured glass: colours stay what they are, and where they are.
#include "catch.h"
#include "pictures.h"
#include <cstdio>
#include <runner.h>

using namespace shadow;
using options::Result;
using options::Runner;

namespace
{
constexpr glm::ivec2 kSize{160, 64};
constexpr float kHeight = 2.0f;
constexpr float kPane = 1.6f, kFrame = 3.2f; // metres from the middle
constexpr int kFrames = 12;
const glm::vec3 kRed(0.8f, 0.05f, 0.02f), kBlue(0.02f, 0.1f, 0.9f);

// Red glass at the left, blue at the right, in an opaque frame.
std::optional<Hit> meetWindow(glm::vec3 P, glm::vec3 V, int)
{
    const float share = (kHeight - P.y) / V.y;
    const float x = P.x + share * V.x;
    if (!(share > 0.0f) || std::abs(x) > kFrame) return std::nullopt;
    if (std::abs(x) > kPane) return Hit{share};
    return Hit{share, x < 0.0f ? kRed : kBlue};
}

struct Sums
{
    glm::dvec4 denoised{0.0}, truth{0.0};
    double count = 0.0;
};

Sums sumBetween(const Result& result, const Light& light, float left, float right)
{
    Sums sums;
    for (int y = 0; y < kSize.y; y++)
    {
        for (int x = 0; x < kSize.x; x++)
        {
            const glm::vec3 P = options::worldPosition(result.frame, x, y);
            if (P.x < left || P.x > right) continue;
            sums.denoised += glm::dvec4(shadowOf(result, result.frame.texel(x, y)));
            sums.truth += meanOf(light, meetWindow, P, 0);
            sums.count += 1.0;
        }
    }
    return sums;
}

// Largest amount of a colour's channel where a pane of the other colour fills the whole light.
float worstForeign(const Result& result, float halfWidth)
{
    float worst = 0.0f;
    for (int y = 0; y < kSize.y; y++)
    {
        for (int x = 0; x < kSize.x; x++)
        {
            const float at = options::worldPosition(result.frame, x, y).x;
            if (std::abs(at) < 2.0f * halfWidth || std::abs(at) > kPane - 2.0f * halfWidth) continue;
            const glm::vec4 v = shadowOf(result, result.frame.texel(x, y));
            worst = std::max(worst, at < 0.0f ? v.w - kRed.z : v.y - kBlue.x);
        }
    }
    return worst;
}
} // namespace

TEST_CASE("coloured glass keeps its colour, and none of it runs over its shadow's edge", "[gpu]")
{
    Runner runner(nrd::Denoiser::SIGMA_SHADOW_TRANSLUCENCY);
    for (const float tangent : {0.01f, 0.05f, 0.15f})
    {
        const Light sun = makeSun(90.0f, 0.0f, tangent);
        const float halfWidth = kHeight * tangent;
        options::Setup setup = makeSetup(nrd::Denoiser::SIGMA_SHADOW_TRANSLUCENCY, kSize, sun, meetWindow);
        for (const bool hasLargeFormats : {true, false})
        {
            setup.hasLargeFormats = hasLargeFormats;
            const Result last = options::runFrames(runner, setup, kFrames);
            const Sums red = sumBetween(last, sun, -kPane, 0.0f), blue = sumBetween(last, sun, 0.0f, kPane);
            const double redShare = red.denoised.y / red.truth.y, blueShare = blue.denoised.w / blue.truth.w;
            const float foreign = worstForeign(last, halfWidth);
            std::printf("FIGURE panes, half of a penumbra %.2f m, %s: red %.4f, blue %.4f of the truth; foreign %.4f\n",
                        double(halfWidth), hasLargeFormats ? "floats" : "8 bits", redShare, blueShare, double(foreign));
            CHECK(redShare == Approx(1.0).epsilon(0.02));
            CHECK(blueShare == Approx(1.0).epsilon(0.02));
            CHECK(foreign < 0.01f);
        }
    }
}

TEST_CASE("what is visible behind glass is nothing, and what comes through is not held for visible", "[gpu]")
{
    const Light sun = makeSun(90.0f, 0.0f, 0.05f);
    Runner runner(nrd::Denoiser::SIGMA_SHADOW_TRANSLUCENCY);
    const Result last = options::runFrames(
        runner, makeSetup(nrd::Denoiser::SIGMA_SHADOW_TRANSLUCENCY, kSize, sun, meetWindow), kFrames);
    CHECK(sumBetween(last, sun, -1.2f, 1.2f).denoised.x == 0.0);
    const Sums frame = sumBetween(last, sun, kPane + 0.6f, kFrame - 0.6f);
    for (int c = 0; c < 4; c++) CHECK(frame.denoised[c] == 0.0);
    const Sums free = sumBetween(last, sun, kFrame + 0.5f, kFrame + 2.0f);
    for (int c = 0; c < 4; c++) CHECK(free.denoised[c] == free.count);
}
