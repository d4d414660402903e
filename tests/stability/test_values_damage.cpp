// One poisoned pixel in one frame: how far its damage reaches, and how long it lasts.
#include "catch.h"
#include "figures.h"
#include "levels.h"
#include "poison.h"
#include "runners.h"
#include <algorithm>
#include <cmath>

using namespace stability;

namespace
{
constexpr glm::ivec2 kWide{80, 40}, kPlace{28, 26};
constexpr int kWarmUp = 6;
// The frame itself and the default lengths of histories after it, and a quarter more: a running mean forgets bit by bit.
constexpr int kMostFrames = 1 + int(nrd::ReblurSettings{}.maxAccumulatedFrameNum) * 5 / 4;
constexpr int kMostShadowFrames = 1 + int(nrd::SigmaSettings{}.maxStabilizedFrameNum);

using Picture = std::vector<Level>;

struct Clean
{
    options::Setup setup;
    std::vector<Target> targets;
    std::vector<Picture> pictures; // from the frame on that others have poison in
    std::vector<double> noise;     // root mean square, of each
};

Clean runClean(options::Runner& runner, nrd::Denoiser denoiser)
{
    Clean clean = {makeOpenSetup(denoiser, kWide), {}, {}, {}};
    clean.setup.speed = 0.0f;
    // 65504 is a firefly, which RELAX keeps unless told otherwise.
    clean.setup.changeSettings([](auto& s) { s.enableAntiFirefly = true; });
    runner.start(clean.setup);
    for (int frame = 0; frame <= kWarmUp + kMostFrames; frame++)
    {
        const options::Result result = runner.denoise(frame);
        if (frame == 0) clean.targets = targetsOf(result.frame);
        if (frame < kWarmUp) continue;
        Statistician statistician;
        clean.pictures.push_back(levelsOf(result, denoiser));
        statistician.add(clean.pictures.back());
        clean.noise.push_back(statistician.statistics().error);
    }
    return clean;
}

struct Damage
{
    double radius = 0.0; // pixels; where it is more than a hundredth of the mean
    double frames = 0.0; // until no pixel is off by more than the noise of the others
};

double radiusOf(const Picture& clean, const Picture& hurt)
{
    constexpr double kVisible = 0.01;
    double radius = 0.0;
    for (size_t i = 0; i < clean.size(); i++)
    {
        if (std::abs(clean[i].denoised - hurt[i].denoised) <= kVisible) continue;
        const glm::ivec2 apart = glm::abs(clean[i].pixel - kPlace);
        radius = std::max(radius, double(std::max(apart.x, apart.y)));
    }
    return radius;
}

bool isHealed(const Picture& clean, const Picture& hurt, double noise)
{
    for (size_t i = 0; i < clean.size(); i++)
        if (!(std::abs(clean[i].denoised - hurt[i].denoised) <= noise)) return false; // nor does NaN pass
    return true;
}

// The short form tries what differs most. A mean is to hold every number that it is fed.
bool isTried(nrd::Denoiser denoiser, const Poison& poison)
{
    if (denoiser == nrd::Denoiser::REFERENCE && std::isfinite(poison.value)) return false;
    return isLong() || !(std::abs(poison.value) < 65504.0f) || poison.value == -1.0f;
}

Damage findDamage(options::Runner& runner, const Clean& clean, const Target& target, float value)
{
    options::Setup setup = clean.setup;
    setup.changeInputs = [&](options::Frame& frame, int index)
    {
        if (index == kWarmUp) poisonTexel(frame, target, kPlace, value);
    };
    runner.start(setup);
    for (int frame = 0; frame < kWarmUp; frame++) (void)runner.denoise(frame);
    Damage damage;
    for (int i = 0; i <= kMostFrames; i++)
    {
        const Picture hurt = levelsOf(runner.denoise(kWarmUp + i), setup.denoiser);
        damage.radius = std::max(damage.radius, radiusOf(clean.pictures[size_t(i)], hurt));
        if (isHealed(clean.pictures[size_t(i)], hurt, clean.noise[size_t(i)])) return damage;
        damage.frames = i + 1;
    }
    return damage;
}
} // namespace

TEST_CASE("a poisoned pixel's damage stays near and heals", "[gpu]")
{
    // RELAX's wavelet reaches 2^4 - 1 pixels; at this height no blur reaches further.
    Figure radius("radius of one pixel's damage above 1 % of the mean", "pixels", 15.0);
    Figure frames("one pixel's damage heals to the noise of the others", "frames", kMostFrames);
    Figure shadowFrames("one ray's damage heals to the noise of the others", "frames", kMostShadowFrames);
    for (const nrd::Denoiser denoiser : denoisersThat(isLong() ? isAny : isWidest))
    {
        const auto runner = makeOpenRunner(denoiser);
        const Clean clean = runClean(*runner, denoiser);
        const bool isShadow = options::familyOf(denoiser) == options::Family::Sigma;
        for (const Target& target : clean.targets)
        {
            for (const Poison& poison : poisons())
            {
                if (!isTried(denoiser, poison)) continue;
                INFO(nameOf(target) << ", " << poison.name);
                const Damage damage = findDamage(*runner, clean, target, poison.value);
                radius.add(denoiser, damage.radius);
                (isShadow ? shadowFrames : frames).add(denoiser, damage.frames);
            }
        }
    }
}
