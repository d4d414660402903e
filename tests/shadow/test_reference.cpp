// REFERENCE against means in double precision.
#include "catch.h"
#include "pictures.h"
#include <cmath>
#include <cstdio>
#include <limits>
#include <runner.h>

using options::Plane;
using options::Result;
using options::Runner;

namespace
{
constexpr auto kOut = nrd::ResourceType::OUT_SIGNAL;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

glm::vec4 noise(glm::ivec2 pixel, int frame)
{
    glm::vec4 v;
    for (int c = 0; c < 4; c++) v[c] = shadow::random(pixel, frame, static_cast<uint32_t>(c));
    return v;
}

options::Setup makeSetup(glm::ivec2 size)
{
    options::Setup setup;
    setup.denoiser = nrd::Denoiser::REFERENCE;
    setup.size = setup.rect = size;
    setup.hasLargeFormats = true;
    setup.speed = 0.0f; // another camera starts another mean
    setup.sampleAt = noise;
    setup.referenceSettings.maxAccumulatedFrameNum = 4095;
    return setup;
}

// What was fed, as the images held it.
class Mean
{
public:
    void add(const Result& result)
    {
        const Plane& fed = result.frame.noisy.at(kOut);
        m_sums.resize(fed.size(), glm::dvec4(0.0));
        for (size_t i = 0; i < fed.size(); i++) m_sums[i] += glm::dvec4(fed[i]);
        m_count += 1.0;
    }

    double worstShare(const Result& result) const // of the mean, over all pixels and channels
    {
        const Plane& out = result.outputs.at(kOut);
        double worst = 0.0;
        for (size_t i = 0; i < m_sums.size(); i++)
            for (int c = 0; c < 4; c++)
                worst = std::max(worst, std::abs(double(out[i][c]) * m_count / m_sums[i][c] - 1.0));
        return worst;
    }

    double pictureMean() const
    {
        double sum = 0.0;
        for (const glm::dvec4& v : m_sums) sum += v.x / m_count;
        return sum / static_cast<double>(m_sums.size());
    }

private:
    std::vector<glm::dvec4> m_sums;
    double m_count = 0.0;
};

// Of white noise between 0 and 1, over all pixels and channels.
double variance(const Plane& plane)
{
    double sum = 0.0;
    for (const glm::vec4& v : plane)
    {
        const glm::dvec4 d = glm::dvec4(v) - 0.5;
        sum += glm::dot(d, d) / 4.0;
    }
    return sum / static_cast<double>(plane.size());
}
} // namespace

TEST_CASE("the mean of 4,095 frames is that in double precision, also of what came late", "[gpu]")
{
    constexpr int kFrames = 4095, kStep = 3500;
    options::Setup setup = makeSetup({16, 8});
    setup.sampleAt = [](glm::ivec2 pixel, int frame)
    { return noise(pixel, frame) + glm::vec4(frame >= kStep ? 1.5f : 0.5f); };
    Runner runner(setup.denoiser);
    runner.start(setup);
    Mean mean;
    double before = 0.0;
    Result last;
    for (int frame = 0; frame < kFrames; frame++)
    {
        last = runner.denoise(frame);
        mean.add(last);
        if (frame + 1 != kStep) continue;
        before = mean.pictureMean();
        std::printf("FIGURE REFERENCE, %d frames of noise: %.2e from the mean at worst\n", kStep,
                    mean.worstShare(last));
        CHECK(mean.worstShare(last) < 5e-4);
    }
    const double moved = mean.pictureMean() - before, expected = double(kFrames - kStep) / kFrames;
    std::printf("FIGURE REFERENCE, %d frames, the last %d brighter by 1: %.2e from the mean at worst, which moved by "
                "%.4f\n",
                kFrames, kFrames - kStep, mean.worstShare(last), moved);
    CHECK(mean.worstShare(last) < 5e-4);
    CHECK(moved == Approx(expected).epsilon(0.02)); // or the step would not have been one
}

TEST_CASE("the variance of the mean falls as one over its frames", "[gpu]")
{
    options::Setup setup = makeSetup({64, 64});
    Runner runner(setup.denoiser);
    runner.start(setup);
    double first = 0.0;
    for (int frame = 0; frame < 256; frame++)
    {
        const Result result = runner.denoise(frame);
        const double now = variance(result.outputs.at(kOut)), count = frame + 1;
        if (frame == 0) first = now;
        if (std::fmod(std::log2(count), 2.0) != 0.0) continue;
        std::printf("FIGURE REFERENCE, %g frames: variance times frames %.4f of one frame's\n", count,
                    now * count / first);
        CHECK(now * count == Approx(first).epsilon(0.05));
    }
}

TEST_CASE("a constant comes back bit for bit after a hundred frames", "[gpu]")
{
    const glm::vec4 values[] = {{0.1f, 1.0f / 3.0f, 12345.678f, 1e-20f}, {-0.7f, 3e30f, 65504.0f, 0.0f}};
    options::Setup setup = makeSetup({7, 5});
    setup.sampleAt = [&](glm::ivec2 pixel, int) { return values[pixel.x & 1]; };
    Runner runner(setup.denoiser);
    const Result last = options::runFrames(runner, setup, 100);
    const Plane& out = last.outputs.at(kOut);
    for (size_t i = 0; i < out.size(); i++) CHECK(out[i] == values[(i % 7) & 1]);
}

// The lost frame's place in the mean is the mean's own.
TEST_CASE("a restart after a frame of no numbers leaves nothing of them", "[gpu]")
{
    options::Setup setup = makeSetup({17, 9});
    setup.sampleAt = [](glm::ivec2 pixel, int frame) { return frame == 2 ? glm::vec4(kNan) : noise(pixel, frame); };
    setup.changeCommon = [](nrd::CommonSettings& common, int frame)
    { common.accumulationMode = frame == 4 ? nrd::AccumulationMode::RESTART : nrd::AccumulationMode::CONTINUE; };
    Runner runner(setup.denoiser);
    runner.start(setup);
    Mean mean;
    for (int frame = 0; frame < 8; frame++)
    {
        const Result result = runner.denoise(frame);
        INFO("frame " << frame);
        CHECK(options::countBroken(result) == 0);
        if (frame == 4) mean = Mean();
        if (frame != 2) mean.add(result);
        if (frame != 3) CHECK(mean.worstShare(result) < 1e-5);
    }
}

TEST_CASE("input and output may be one image", "[gpu]")
{
    options::Setup setup = makeSetup({33, 20});
    Runner runner(setup.denoiser);
    const Result apart = options::runFrames(runner, setup, 12);
    setup.isInPlace = true;
    const Result together = options::runFrames(runner, setup, 12);
    CHECK(options::countBroken(together) == 0);
    CHECK(options::countDifferent(apart, together) == 0);
}

TEST_CASE("left of the split position the output is left alone, so in place it shows the input", "[gpu]")
{
    constexpr glm::ivec2 kSize{33, 20};
    options::Setup setup = makeSetup(kSize);
    Runner runner(setup.denoiser);
    const Result whole = options::runFrames(runner, setup, 5);
    setup.isInPlace = true;
    setup.changeCommon = [](nrd::CommonSettings& common, int) { common.splitScreen = 0.25f; };
    const Result split = options::runFrames(runner, setup, 5);
    const Plane &out = split.outputs.at(kOut), &input = split.frame.noisy.at(kOut), &mean = whole.outputs.at(kOut);
    for (int y = 0; y < kSize.y; y++)
    {
        for (int x = 0; x < kSize.x; x++)
        {
            const size_t i = static_cast<size_t>(y * kSize.x + x);
            const bool isInput = static_cast<float>(x) + 0.5f < 0.25f * kSize.x;
            CHECK(out[i] == (isInput ? input[i] : mean[i]));
        }
    }
}
