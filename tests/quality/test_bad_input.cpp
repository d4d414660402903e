// What is not finite in the noisy input never reaches a pixel whose own input was finite, nor stays.
#include "catch.h"
#include "harness.h"
#include "noise.h"
#include <cmath>
#include <limits>

using namespace quality;

namespace
{
bool isFinite(glm::vec4 v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && std::isfinite(v.w);
}

size_t countNonFinite(const Signal& signal, const Guides& guides)
{
    size_t count = 0;
    for (size_t i = 0; i < signal.size(); i++) count += guides.viewZ[i] < kDenoisingRange && !isFinite(signal[i]);
    return count;
}

void poison(Signal& signal, unsigned seed)
{
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    const glm::vec4 bad[] = {glm::vec4(nan),    {inf, 0, 0, 0.5f},         {1, -inf, nan, 0.5f}, {1, 0, 0, nan},
                             {-inf, 0, 0, inf}, {65504, 65504, -65504, 1}, {-5, 3, 2, -1}};
    std::mt19937 rng(seed);
    for (glm::vec4& v : signal)
        if (rng() % 50 == 0) v = bad[rng() % std::size(bad)];
}

void runPoisoned(const nrd::ReblurSettings& settings, int width, int height)
{
    Harness harness(width, height, settings);
    const size_t count = static_cast<size_t>(width) * static_cast<size_t>(height);
    for (int frame = 0; frame < 12; frame++)
    {
        Frame input{renderGuides(makeCamera(frame, 0.05f, width, height), width, height),
                    makeNoise(count, 1.0f, unsigned(2 * frame)), makeNoise(count, 1.0f, unsigned(2 * frame + 1))};
        if (frame < 6) poison(input.diffuse, unsigned(frame));
        if (frame < 6) poison(input.specular, unsigned(frame + 100));
        harness.denoise(input);
        INFO("frame " << frame << ", " << width << "x" << height);
        CHECK(countNonFinite(harness.diffuse(), input.guides) == 0);
        CHECK(countNonFinite(harness.specular(), input.guides) == 0);
    }
}
} // namespace

TEST_CASE("NaN and infinities in the noisy input never reach an output", "[gpu]")
{
    nrd::ReblurSettings settings;
    runPoisoned(settings, 96, 64);
    settings.diffusePrepassBlurRadius = settings.specularPrepassBlurRadius = 0.0f;
    runPoisoned(settings, 96, 64);
    settings.maxStabilizedFrameNum = 0;
    runPoisoned(settings, 96, 64);
}

TEST_CASE("a poisoned pixel leaves its neighbours as they would be without it", "[gpu]")
{
    constexpr int kWidth = 64, kHeight = 48;
    const size_t count = kWidth * kHeight;
    Signal signal(count, glm::vec4(1.0f, 0.0f, 0.0f, 0.4f));
    Harness harness(kWidth, kHeight);
    for (int frame = 0; frame < 4; frame++)
    {
        Frame input{renderGuides(makeCamera(0, 0.0f, kWidth, kHeight), kWidth, kHeight), signal, signal};
        poison(input.diffuse, 7);
        for (glm::vec4& v : input.diffuse)
            if (isFinite(v)) v = signal[0]; // only what is not finite stays
        harness.denoise(input);
        for (size_t i = 0; i < count; i++)
        {
            if (input.guides.viewZ[i] > kDenoisingRange || !isFinite(input.diffuse[i])) continue;
            CHECK(std::abs(harness.diffuse()[i].x - 1.0f) < 2e-3f);
        }
    }
}

TEST_CASE("odd sizes denoise to finite values", "[gpu]")
{
    const int sizes[][2] = {{1, 1}, {3, 5}, {17, 9}, {127, 63}};
    for (const auto& size : sizes) runPoisoned({}, size[0], size[1]);
}

TEST_CASE("nothing is written beyond the denoising range", "[gpu]")
{
    constexpr int kWidth = 64, kHeight = 48;
    const size_t count = kWidth * kHeight;
    Harness harness(kWidth, kHeight);
    harness.poisonOutputs(123.0f);
    size_t sky = 0;
    for (int frame = 0; frame < 3; frame++)
    {
        const Frame input{renderGuides(makeCamera(frame, 0.1f, kWidth, kHeight), kWidth, kHeight),
                          makeNoise(count, 1.0f, 1), makeNoise(count, 1.0f, 2)};
        harness.denoise(input,
                        [&](nrd::CommonSettings& common)
                        {
                            if (frame == 0) common.accumulationMode = nrd::AccumulationMode::CONTINUE;
                        });
        for (size_t i = 0; i < count; i++)
        {
            if (input.guides.viewZ[i] < kDenoisingRange) continue;
            sky++;
            // The first use clears outputs; later frames leave them alone.
            if (frame > 0) CHECK(harness.diffuse()[i] == glm::vec4(123.0f));
        }
    }
    CHECK(sky > 0);
}
