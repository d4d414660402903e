// Lights that blink, and one that is a pixel of the picture and 100,000 times as bright as all others.
#include "catch.h"
#include "figures.h"
#include "levels.h"
#include "runners.h"
#include <cmath>
#include <string_view>

using namespace stability;

namespace
{
constexpr int kSwitch = 40; // frames between switches

bool hasRadiance(nrd::Denoiser denoiser)
{
    const bool isOcclusion = std::string_view(nrd::toString(denoiser)).find("OCCLUSION") != std::string_view::npos;
    return isDenoiser(denoiser) && !isOcclusion && options::familyOf(denoiser) != options::Family::Sigma;
}

bool isLit(int frame, int period) { return frame / period % 2 == 0; }

Statistics measure(nrd::Denoiser denoiser, const options::Result& result)
{
    Statistician statistician;
    statistician.add(levelsOf(result, denoiser));
    return statistician.statistics();
}

options::Setup makeBlink(nrd::Denoiser denoiser, int period)
{
    options::Setup setup = makeSetup(denoiser);
    setup.meanAt = [period](glm::vec3, glm::ivec2, int frame) { return isLit(frame, period) ? 1.0f : 0.0f; };
    return setup;
}

// Frames shown with an error of a tenth of the step or more after a switch, the slower of off and on.
double framesToHeal(nrd::Denoiser denoiser)
{
    int wrong[3] = {};
    run(makeBlink(denoiser, kSwitch), 3 * kSwitch,
        [&](int frame, const options::Result& result)
        {
            const Statistics s = measure(denoiser, result);
            if (std::abs(s.denoised - s.truth) > 0.1) wrong[frame / kSwitch] = frame % kSwitch + 1;
        });
    return std::max(wrong[1], wrong[2]);
}

// Lit every other frame: what the shown frames lack of the light, or have too much, beside plain means of all before.
double energyError(nrd::Denoiser denoiser)
{
    double shown = 0.0, mean = 0.0;
    constexpr int kFirst = 8, kLast = 24;
    run(makeBlink(denoiser, 1), kLast,
        [&](int frame, const options::Result& result)
        {
            if (frame < kFirst) return;
            shown += measure(denoiser, result).denoised;
            mean += double(frame / 2 + 1) / (frame + 1);
        });
    return 100.0 * std::abs(shown / mean - 1.0);
}

// Occlusion is no light, and REFERENCE a mean of all its frames.
bool showsLight(nrd::Denoiser denoiser)
{
    return hasRadiance(denoiser) || options::familyOf(denoiser) == options::Family::Sigma;
}
} // namespace

TEST_CASE("a light that is switched shows soon", "[gpu]")
{
    // Half as long as a mean over 30 frames that does not react takes, from black too, where nothing is known of noise.
    Figure figure("light switched off and on: frames to a tenth of the step", "frames", 35.0);
    for (const nrd::Denoiser denoiser : someThat(showsLight)) figure.add(denoiser, framesToHeal(denoiser));
}

TEST_CASE("a light that blinks keeps its energy", "[gpu]")
{
    // What is seen of a step of brightness is about 5; RELAX_DIFFUSE_SPECULAR_SH takes 5.1.
    Figure figure("light lit every other frame: error of the mean", "%", 5.5);
    for (const nrd::Denoiser denoiser : someThat(isAny)) figure.add(denoiser, energyError(denoiser));
}

namespace
{
constexpr float kRadiance = 1e5f;
constexpr int kEmitterFrames = 16, kWarmUp = 8;

// Whose paths find it.
glm::ivec2 fixedPixel(int) { return {32, 24}; }
glm::ivec2 anyPixel(int frame) { return {(frame * 37 + 11) % kSize.x, (frame * 23 + 5) % kSize.y}; }

struct Emitter
{
    const char* name;
    glm::ivec2 (*pixelAt)(int frame);
    double brightest, mean; // bounds
};

// One path in thousands is a firefly, of which twice the mean is what the eye begins to see. What the same pixel finds
// every other frame is light: it stays, and blurs.
const Emitter kEmitters[] = {
    {"found by one pixel a frame, any", anyPixel, 2.0, 1.0},
    {"found by the same pixel", fixedPixel, INFINITY, INFINITY},
};

struct Others
{
    double brightest = 0.0; // of the pixels that do not find it now, times their mean
    double mean = 0.0;
};

// Half of the frames find it, twice as bright.
Others measureOthers(nrd::Denoiser denoiser, const Emitter& emitter)
{
    options::Setup setup = makeSetup(denoiser);
    setup.isAntithetic = true;
    setup.changeSettings([](auto& s) { s.enableAntiFirefly = true; });
    setup.meanAt = [&](glm::vec3, glm::ivec2 pixel, int frame)
    { return pixel == emitter.pixelAt(frame) ? kRadiance : 1.0f; };
    Others others;
    Statistician statistician;
    run(setup, kEmitterFrames,
        [&](int frame, const options::Result& result)
        {
            if (frame < kWarmUp) return;
            const std::vector<Level> levels = levelsOf(result, denoiser);
            const auto isOther = [&](const Level& l) { return l.pixel != emitter.pixelAt(frame); };
            statistician.add(levels, isOther);
            for (const Level& l : levels)
                if (isOther(l)) others.brightest = std::max(others.brightest, l.denoised);
        });
    others.mean = statistician.statistics().denoised;
    others.brightest /= others.mean;
    return others;
}
} // namespace

TEST_CASE("an emitter of one pixel leaves the picture around it as it is", "[gpu]")
{
    for (const Emitter& emitter : kEmitters)
    {
        const std::string name = std::string("one pixel of 1e5, ") + emitter.name;
        Figure brightest(name + ": brightest of the others", "times their mean", emitter.brightest);
        Figure mean(name + ": error of the others' mean", "%", emitter.mean);
        for (const nrd::Denoiser denoiser : someThat(hasRadiance))
        {
            const Others others = measureOthers(denoiser, emitter);
            brightest.add(denoiser, others.brightest);
            mean.add(denoiser, 100.0 * std::abs(others.mean - 1.0));
        }
    }
}
