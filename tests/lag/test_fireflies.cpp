// Rare pixels of 10,000 times the mean: no blob may be seen of them, and the mean stays what it is without them.
#include "catch.h"
#include "picture.h"
#include "variants.h"
#include <cmath>
#include <cstdio>
#include <random>

using namespace lag;

namespace
{
constexpr int kFrames = 64, kWarmUp = 16;
constexpr float kFirefly = 1e4f; // times the mean
constexpr unsigned kOneIn = 5000;
constexpr float kMean = 1.0f;

struct Figures
{
    double brightest = 0.0; // over all pixels and frames, times the mean
    double mean = 0.0;      // of all pixels and frames, times the mean
};

void addFireflies(quality::Signal& signal, unsigned seed)
{
    std::mt19937 rng(seed + 1000000u);
    for (glm::vec4& v : signal)
        if (rng() % kOneIn == 0) v = glm::vec4(glm::vec3(kFirefly * kMean), v.w);
}

struct Run
{
    bool hasFireflies;
    bool hasAntiFirefly;
    bool hasPrePass;
};

Figures measureRun(nrd::Denoiser denoiser, const Run& run)
{
    const quality::Settings settings = makeFireflySettings(denoiser, run.hasAntiFirefly, run.hasPrePass);
    quality::Harness harness(kWidth, kHeight, settings, denoiser);
    const quality::Guides guides =
        quality::renderGuides(quality::makeCamera(0, 0.0f, kWidth, kHeight), kWidth, kHeight);
    const Means means(kPixelCount, kMean);
    Figures figures;
    double count = 0.0;
    for (int frame = 0; frame < kFrames; frame++)
    {
        quality::Signal noise = makePathNoise(means, unsigned(frame));
        if (run.hasFireflies) addFireflies(noise, unsigned(frame));
        const quality::Signal& out = denoiseLobe(harness, denoiser, guides, noise);
        if (frame < kWarmUp) continue;
        for (size_t i = 0; i < kPixelCount; i++)
        {
            if (guides.viewZ[i] > quality::kDenoisingRange) continue;
            figures.brightest = std::max(figures.brightest, double(out[i].x / kMean));
            figures.mean += double(out[i].x / kMean);
            count += 1.0;
        }
    }
    figures.mean /= count;
    return figures;
}

Figures printRun(nrd::Denoiser denoiser, const Run& run)
{
    const Figures f = measureRun(denoiser, run);
    std::printf("FIGURE %s, %s fireflies, anti-firefly %s, pre-pass %s: brightest %.3f, mean %.4f\n",
                nrd::toString(denoiser), run.hasFireflies ? "with" : "without", run.hasAntiFirefly ? "on" : "off",
                run.hasPrePass ? "on" : "off", f.brightest, f.mean);
    return f;
}
} // namespace

// Twice the mean is 0.10 above it in what the eye sees.
TEST_CASE("with anti-firefly on, fireflies leave no blob and change no mean", "[gpu]")
{
    for (const nrd::Denoiser denoiser : kDenoisers)
    {
        for (const bool hasPrePass : {true, false})
        {
            INFO(nrd::toString(denoiser) << ", pre-pass " << hasPrePass);
            const Figures clean = printRun(denoiser, {false, true, hasPrePass});
            const Figures with = printRun(denoiser, {true, true, hasPrePass});
            CHECK(with.brightest < 2.0);
            CHECK(std::abs(with.mean / clean.mean - 1.0) < 0.02);
            CHECK(std::abs(with.mean - 1.0) < 0.02);
        }
    }
}

TEST_CASE("without anti-firefly, fireflies stay", "[gpu]")
{
    for (const nrd::Denoiser denoiser : kDenoisers) CHECK(printRun(denoiser, {true, false, true}).brightest > 10.0);
}
