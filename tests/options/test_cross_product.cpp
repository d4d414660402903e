// Every denoiser with every option on awkward sizes: runs without a message, writes finite values where it
// should and nothing elsewhere, and comes closer to the truth than its input.
#include "catch.h"
#include "long_form.h"
#include "measures.h"
#include "options.h"
#include <cstdio>
#include <string>

using namespace options;

namespace
{
constexpr glm::ivec2 kLarge{127, 63}, kOdd{17, 9};
constexpr int kLargeFrames = 3, kSmallFrames = 2;
// The long form runs every combination at both sizes. Else a denoiser takes turns with its neighbours: in the middle
// form every combination runs small, RELAX's, which has many pipelines, by turns of three, and all large, where errors
// are measured, by turns of three; in the short form the turns are three times as long, and by three all run small.
constexpr size_t kTurns = 3;

bool isTurn(size_t denoiser, size_t option, size_t turns) { return (denoiser + option) % turns == 0; }

bool isMeasured(size_t denoiser, size_t option)
{
    return test::isLong() || isTurn(denoiser, option, test::isMiddle() ? kTurns : kTurns * kTurns);
}

bool isRunSmall(size_t denoiser, size_t option)
{
    const bool isEach = test::isLong() || (test::isMiddle() && !isRelax(testedDenoisers()[denoiser]));
    return isEach || isTurn(denoiser, option, kTurns);
}

// Ratios of the denoised picture's error to the noisy one's.
struct Tally
{
    int combinations = 0;
    double worst = 0.0;
    std::string worstName;

    void add(double ratio, const char* name)
    {
        if (ratio <= worst) return;
        worst = ratio;
        worstName = name;
    }
};

bool isLarge(const Setup& setup) { return setup.size.x >= kLarge.x; }

void checkFrame(const Result& result, int frame)
{
    INFO("frame " << frame);
    CHECK(countBroken(result) == 0);
    if (frame > 0) CHECK(countStray(result) == 0); // the first use clears the outputs
}

void checkError(const Result& last, const Setup& setup, const Option& option, Tally& tally)
{
    // Left of the split REFERENCE leaves the output alone, which here is another image than its input.
    if (setup.denoiser == nrd::Denoiser::REFERENCE && std::string(option.name).starts_with("split screen")) return;
    const bool isRestarted = setup.denoiser == nrd::Denoiser::REFERENCE && setup.isRectVarying;
    const bool isInput = std::string(option.name) == "split screen 1" || isRestarted;
    const bool isPartlyInput = std::string(option.name) == "split screen 0.5";
    for (const auto& [slot, plane] : last.outputs)
    {
        const double ratio = signalError(last, slot) / noisyError(last, slot);
        INFO(nrd::toString(slot) << ": " << ratio << " of the input's error");
        if (isInput)
            CHECK(ratio == Approx(1.0).epsilon(1e-3));
        else
            CHECK(ratio < 1.0);
        if (!isInput && !isPartlyInput) tally.add(ratio, option.name);
    }
}

void runOption(Runner& runner, Setup setup, const Option& option, Tally& tally)
{
    option.apply(setup);
    INFO(nrd::toString(setup.denoiser) << ", " << option.name << ", " << setup.size.x << "x" << setup.size.y);
    runner.start(setup);
    const int frameCount = isLarge(setup) ? kLargeFrames : kSmallFrames;
    Result last;
    for (int frame = 0; frame < frameCount; frame++)
    {
        last = runner.denoise(frame);
        checkFrame(last, frame);
    }
    if (isLarge(setup)) checkError(last, setup, option, tally);
    tally.combinations++;
}

void runOtherEncodings(size_t denoiserIndex, Tally& tally)
{
    const nrd::Denoiser denoiser = testedDenoisers()[denoiserIndex];
    using N = nrd::NormalEncoding;
    using R = nrd::RoughnessEncoding;
    const struct
    {
        const char* name;
        N normals;
        R roughness;
    } rows[] = {{"RGBA8_UNORM, SQ_LINEAR", N::RGBA8_UNORM, R::SQ_LINEAR},
                {"RGBA8_SNORM, SQRT_LINEAR", N::RGBA8_SNORM, R::SQRT_LINEAR},
                {"RGBA16_UNORM, SQ_LINEAR", N::RGBA16_UNORM, R::SQ_LINEAR},
                {"RGBA16_SNORM, SQRT_LINEAR", N::RGBA16_SNORM, R::SQRT_LINEAR}};
    for (size_t i = 0; i < std::size(rows); i++)
    {
        const auto& row = rows[i];
        if (!isRunSmall(denoiserIndex, i)) continue;
        Runner runner(denoiser, row.normals, row.roughness);
        Setup setup = makeSetup(denoiser, isMeasured(denoiserIndex, i) ? kLarge : kOdd);
        setup.normalEncoding = row.normals;
        setup.roughnessEncoding = row.roughness;
        runOption(runner, setup, {row.name, [](Setup&) {}}, tally);
    }
}
} // namespace

TEST_CASE("every denoiser denoises with every option at every size", "[gpu]")
{
    CHECK(allDenoisers().size() == static_cast<size_t>(nrd::Denoiser::MAX_NUM));
    for (size_t d = 0; d < testedDenoisers().size(); d++)
    {
        const nrd::Denoiser denoiser = testedDenoisers()[d];
        Tally tally;
        Runner runner(denoiser);
        const std::vector<Option>& options = allOptions(denoiser);
        for (size_t i = 0; i < options.size(); i++)
        {
            if (i == 0 || isRunSmall(d, i)) runOption(runner, makeSetup(denoiser, kOdd), options[i], tally);
            if (i == 0 || isMeasured(d, i)) runOption(runner, makeSetup(denoiser, kLarge), options[i], tally);
        }
        for (const glm::ivec2 size : {glm::ivec2(1, 1), glm::ivec2(3, 5)})
            runOption(runner, makeSetup(denoiser, size), options[0], tally);
        const uint32_t pipelines = runner.pipelineCount();
        runOtherEncodings(d, tally);
        std::printf("FIGURE %s: %d combinations, %u pipelines, worst error %.3f of the input's (%s)\n",
                    nrd::toString(denoiser), tally.combinations, pipelines, tally.worst, tally.worstName.c_str());
    }
}
