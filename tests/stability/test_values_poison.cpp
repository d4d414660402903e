// Whatever any image holds, outputs and histories hold numbers.
#include "catch.h"
#include "figures.h"
#include "poison.h"
#include "runners.h"

using namespace stability;

namespace
{
constexpr glm::ivec2 kSmall{48, 32};
constexpr int kPoisonedFrames = 4, kFrames = 6; // the last ones show what stayed

// One pixel in 23, others each frame; another poison in each.
void sprinkle(options::Frame& frame, const Target& target, int frameIndex)
{
    int next = frameIndex;
    for (int y = 0; y < frame.size.y; y++)
        for (int x = 0; x < frame.size.x; x++)
            if ((x * 7 + y * 13 + frameIndex * 5) % 23 == 0)
                poisonTexel(frame, target, {x, y}, poisons()[size_t(next++) % poisons().size()].value);
}

// 1: an output or a history of some frame held what is no number.
int runPoisoned(options::Runner& runner, const options::Setup& setup, const std::string& what)
{
    bool isSound = true;
    runner.start(setup);
    for (int frame = 0; frame < kFrames; frame++)
    {
        const options::Result result = runner.denoise(frame);
        const std::string unsound = findUnsound(result, runner.histories());
        INFO(nrd::toString(setup.denoiser) << ", poisoned: " << what << ", frame " << frame);
        if (isSound) CHECK(unsound == ""); // what follows is the same fault
        isSound = isSound && unsound.empty();
    }
    return isSound ? 0 : 1;
}

void checkDenoiser(nrd::Denoiser denoiser, Figure& figure)
{
    const auto runner = makeOpenRunner(denoiser);
    const options::Setup clean = makeOpenSetup(denoiser, kSmall);
    const std::vector<Target> targets = targetsOf(options::runFrames(*runner, clean, 2).frame);
    int unsound = 0;
    for (const Target& target : targets)
    {
        if (!isLong() && !isWidest(denoiser)) break; // all at once is for every denoiser

        options::Setup setup = clean;
        setup.changeInputs = [&](options::Frame& frame, int index)
        {
            if (index < kPoisonedFrames) sprinkle(frame, target, index);
        };
        unsound += runPoisoned(*runner, setup, nameOf(target));
    }
    options::Setup all = clean;
    all.changeInputs = [&](options::Frame& frame, int index)
    {
        for (size_t i = 0; i < targets.size() && index < kPoisonedFrames; i++)
            sprinkle(frame, targets[i], index + int(i));
    };
    unsound += runPoisoned(*runner, all, "everything");
    figure.add(denoiser, unsound);
}
} // namespace

TEST_CASE("whatever an image holds, outputs and histories hold numbers", "[gpu]")
{
    Figure figure("inputs whose poison reached an output or a history", "inputs", 0.0);
    for (const nrd::Denoiser denoiser : options::testedDenoisers()) checkDenoiser(denoiser, figure);
}
