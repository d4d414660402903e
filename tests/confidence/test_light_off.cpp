// A light goes off: how long its light stays in the picture, with and without confidence.
#include "catch.h"
#include "switched_light.h"
#include <cstdio>

using namespace confidence;

namespace
{
constexpr uint32_t kSettledFrames = 10;
constexpr int kMaxLag = 4;

// Frames until the error is under 1.25 times what it settles at.
int lagOf(const Frames& frames, double FrameFigures::*error)
{
    double settled = 0.0;
    for (size_t i = frames.size() - kSettledFrames; i < frames.size(); i++)
        settled += frames[i].*error / double(kSettledFrames);
    const size_t first = frames.size() - kFramesAfter;
    size_t frame = first;
    while (frame < frames.size() && frames[frame].*error >= 1.25 * settled) frame++;
    return int(frame - first);
}

void print(const char* denoiser, const char* history, const Frames& frames)
{
    std::printf("FIGURE %s, %s: frames to 1.25 of the settled error after a light goes off: FLIP %d, RMSE %d; "
                "FLIP by frame:",
                denoiser, history, lagOf(frames, &FrameFigures::flip), lagOf(frames, &FrameFigures::rmse));
    for (uint32_t i = 0; i < kFramesAfter; i++)
        if (i < 6 || i % 8 == 7) std::printf(" %.4f", frames[frames.size() - kFramesAfter + i].flip);
    std::printf("\n");
}

void print(const Comparison& c)
{
    print(c.denoiser, "confidence off", c.without);
    print(c.denoiser, "confidence on", c.with);
    print(c.denoiser, "history restarted", c.restarted);
}

// No frame after the switch is worse than the other by more than the factor.
void checkErrors(const Frames& frames, const Frames& other, double factor)
{
    for (uint32_t i = 0; i < kFramesAfter; i++)
    {
        INFO("frame " << i);
        CHECK(frames[frames.size() - kFramesAfter + i].flip < factor * other[other.size() - kFramesAfter + i].flip);
    }
}

void checkConfidence(const Comparison& c, const char* lobe, std::optional<double> FrameFigures::*mean)
{
    const auto at = [&](uint32_t frame) { return (c.with[frame].*mean).value(); };
    std::printf("FIGURE %s, mean %s confidence: static scene %.4f, as the light goes off %.4f, then %.4f\n", c.denoiser,
                lobe, at(kSwitchFrame - 1), at(kSwitchFrame), at(kSwitchFrame + 1));
    for (uint32_t frame = 0; frame < kSwitchFrame; frame++) CHECK(at(frame) > 0.95);
    CHECK(at(kSwitchFrame) < 0.3);
    CHECK(at(kSwitchFrame + 1) > 0.95);
    CHECK_FALSE((c.without[kSwitchFrame].*mean).has_value());
}
} // namespace

// The room is small and its pictures are, so that history fix and blurs cover much of it: that the error of the first
// frames is near the settled one is a property of the denoisers, that nothing of the old light is in it is confidence.
TEST_CASE("with confidence a light that goes off is gone within four frames", "[gpu]")
{
    for (const Comparison& c : runSwitchedLight({}))
    {
        INFO(c.denoiser);
        print(c);
        CHECK(lagOf(c.with, &FrameFigures::flip) <= kMaxLag);
        CHECK(lagOf(c.with, &FrameFigures::rmse) <= kMaxLag);
        CHECK(lagOf(c.without, &FrameFigures::flip) > kMaxLag); // or the scene would show nothing
        checkConfidence(c, "diffuse", &FrameFigures::diffuse);
        checkConfidence(c, "specular", &FrameFigures::specular);
    }
}

// Where a noisy light remains, a new history takes longer to settle than four frames; nothing old may be on top of
// that.
TEST_CASE("with confidence a light that goes off under a lamp leaves what a new history would", "[gpu]")
{
    for (const Comparison& c : runSwitchedLight({.hasLamp = true}))
    {
        INFO(c.denoiser);
        print(c);
        checkErrors(c.with, c.restarted, 1.05);
        CHECK(lagOf(c.with, &FrameFigures::flip) < lagOf(c.without, &FrameFigures::flip));
        checkConfidence(c, "diffuse", &FrameFigures::diffuse);
    }
}

// The paths of the other lights must come back as they were, or all history would be dropped.
TEST_CASE("a weak light that goes off takes little of the history with it", "[gpu]")
{
    for (const Comparison& c : runSwitchedLight({.hasLamp = true, .strength = 0.1f}))
    {
        INFO(c.denoiser);
        print(c);
        const double confidence = c.with[kSwitchFrame].diffuse.value();
        std::printf("FIGURE %s, mean diffuse confidence as a weak light goes off %.4f\n", c.denoiser, confidence);
        CHECK(confidence > 0.5);
        CHECK(confidence < 0.95);
        checkErrors(c.with, c.without, 1.02);
    }
}
