// A constant signal stays constant: constant radiance in, the same out, for any geometry and camera motion.
#include "catch.h"
#include "harness.h"
#include <algorithm>
#include <cmath>
#include <cstdio>

using namespace quality;

namespace
{
constexpr int kWidth = 96, kHeight = 64;

// Largest relative deviation from the constant over all in-range pixels.
double worstDeviation(const Signal& signal, const Guides& guides, glm::vec4 expected)
{
    double worst = 0.0;
    const float scale = std::max(expected.x, 1e-6f);
    for (size_t i = 0; i < signal.size(); i++)
    {
        if (guides.viewZ[i] > kDenoisingRange) continue;
        for (int c = 0; c < 3; c++) worst = std::max(worst, double(std::abs(signal[i][c] - expected[c])) / scale);
        worst = std::max(worst, double(std::abs(signal[i].w - expected.w)));
    }
    return worst;
}

double runConstant(const nrd::ReblurSettings& settings, float value, float speed, int frames)
{
    const glm::vec4 constant(toHalf(value), toHalf(0.25f * value), toHalf(-0.125f * value), toHalf(0.37f));
    Harness harness(kWidth, kHeight, settings);
    double worst = 0.0;
    for (int frame = 0; frame < frames; frame++)
    {
        const Camera camera = makeCamera(frame, speed, kWidth, kHeight);
        const Signal signal(static_cast<size_t>(kWidth * kHeight), constant);
        const Frame input{renderGuides(camera, kWidth, kHeight), signal, signal};
        harness.denoise(input);
        worst = std::max({worst, worstDeviation(harness.diffuse(), input.guides, constant),
                          worstDeviation(harness.specular(), input.guides, constant)});
    }
    return worst;
}
} // namespace

TEST_CASE("a constant signal stays constant under a moving camera", "[gpu]")
{
    for (const float value : {0.001f, 1.0f, 250.0f, 40000.0f})
    {
        for (const float speed : {0.0f, 0.05f, 0.6f})
        {
            const double worst = runConstant({}, value, speed, 20);
            INFO("value " << value << ", speed " << speed << ": " << worst);
            std::printf("FIGURE constant %g at speed %g: worst deviation %.3g\n", double(value), double(speed), worst);
            CHECK(worst <= 1.0 / 1024.0); // a half float's step
        }
    }
}

TEST_CASE("a constant signal stays constant without pre-pass, stabilisation and anti-firefly", "[gpu]")
{
    nrd::ReblurSettings settings;
    settings.diffusePrepassBlurRadius = settings.specularPrepassBlurRadius = 0.0f;
    settings.maxStabilizedFrameNum = 0;
    settings.enableAntiFirefly = false;
    CHECK(runConstant(settings, 2.0f, 0.1f, 16) <= 1.0 / 1024.0);
}

TEST_CASE("black stays black", "[gpu]") { CHECK(runConstant({}, 0.0f, 0.1f, 8) <= 1e-6); }

TEST_CASE("a constant signal does not drift over hundreds of frames", "[gpu]")
{
    CHECK(runConstant({}, 3.0f, 0.002f, 200) <= 1.0 / 1024.0);
}
