// Rare pixels of 10,000 times the mean: no blob may be seen of them, and the mean stays what it is without them. Light
// that only one path in hundreds finds is no firefly.
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
constexpr unsigned kOneIn = 5000, kSparseOneIn = 200;
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

enum class Input
{
    Clean,
    Fireflies,
    Sparse
};
constexpr const char* kInputNames[] = {"clean", "with fireflies", "sparse"};

struct Run
{
    Input input;
    bool hasAntiFirefly;
    bool hasPrePass;
};

// All light in one pixel of many, black otherwise.
quality::Signal makeSparse(unsigned seed)
{
    std::mt19937 rng(seed + 2000000u);
    quality::Signal signal = makePathNoise(Means(kPixelCount, kMean), seed);
    for (glm::vec4& v : signal) v = glm::vec4(glm::vec3(rng() % kSparseOneIn == 0 ? kSparseOneIn * kMean : 0.0f), v.w);
    return signal;
}

quality::Signal makeInput(Input input, unsigned seed)
{
    if (input == Input::Sparse) return makeSparse(seed);
    quality::Signal noise = makePathNoise(Means(kPixelCount, kMean), seed);
    if (input == Input::Fireflies) addFireflies(noise, seed);
    return noise;
}

Figures measureRun(nrd::Denoiser denoiser, const Run& run)
{
    const quality::Settings settings = makeFireflySettings(denoiser, run.hasAntiFirefly, run.hasPrePass);
    quality::Harness harness(kWidth, kHeight, settings, denoiser);
    const quality::Guides guides =
        quality::renderGuides(quality::makeCamera(0, 0.0f, kWidth, kHeight), kWidth, kHeight);
    Figures figures;
    double count = 0.0;
    for (int frame = 0; frame < kFrames; frame++)
    {
        const quality::Signal input = makeInput(run.input, unsigned(frame));
        const quality::Signal& out = denoiseLobe(harness, denoiser, guides, input);
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
    std::printf("FIGURE %s, %s, anti-firefly %s, pre-pass %s: brightest %.3f, mean %.4f\n", nrd::toString(denoiser),
                kInputNames[int(run.input)], run.hasAntiFirefly ? "on" : "off", run.hasPrePass ? "on" : "off",
                f.brightest, f.mean);
    return f;
}
} // namespace

// Twice the mean is 0.10 above it in what the eye sees. Without a pre-pass the mean is low with and without fireflies:
// limits relative to a noisy history cut the tail of the noise too.
TEST_CASE("with anti-firefly on, fireflies leave no blob and change no mean", "[gpu]")
{
    for (const nrd::Denoiser denoiser : kDenoisers)
    {
        for (const bool hasPrePass : {true, false})
        {
            INFO(nrd::toString(denoiser) << ", pre-pass " << hasPrePass);
            const Figures clean = printRun(denoiser, {Input::Clean, true, hasPrePass});
            const Figures with = printRun(denoiser, {Input::Fireflies, true, hasPrePass});
            CHECK(with.brightest < 2.0);
            CHECK(std::abs(with.mean / clean.mean - 1.0) < 0.02);
            if (hasPrePass) CHECK(std::abs(with.mean - 1.0) < 0.02);
        }
    }
}

TEST_CASE("without anti-firefly, fireflies stay", "[gpu]")
{
    for (const nrd::Denoiser denoiser : kDenoisers)
        CHECK(printRun(denoiser, {Input::Fireflies, false, true}).brightest > 5.0);
}

// Printed for RELAX only: its rank filter takes what stands alone in 3x3 pixels, which is nearly all of such a light.
TEST_CASE("the anti-firefly of REBLUR leaves most of a light that one path in 200 finds", "[gpu]")
{
    for (const nrd::Denoiser denoiser : kDenoisers)
    {
        for (const bool hasPrePass : {true, false})
        {
            INFO(nrd::toString(denoiser) << ", pre-pass " << hasPrePass);
            const Figures on = printRun(denoiser, {Input::Sparse, true, hasPrePass});
            const Figures off = printRun(denoiser, {Input::Sparse, false, hasPrePass});
            // 0.65 with bounds from 72 pixels instead of 16. Without a pre-pass 0.3 of the light of 0.6 is left, with
            // one 0.3 to 0.4 of 0.5.
            if (!isRelax(denoiser)) CHECK(on.mean > (hasPrePass ? 0.6 : 0.45) * off.mean);
        }
    }
}
