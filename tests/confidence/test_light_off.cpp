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
    size_t frame = kSwitchFrame;
    while (frame < frames.size() && frames[frame].*error >= 1.25 * settled) frame++;
    return int(frame - kSwitchFrame);
}

void print(const char* denoiser, const char* confidence, const Frames& frames)
{
    std::printf(
        "FIGURE %s, confidence %s: frames to 1.25 of the settled error after a light goes off: FLIP %d, RMSE %d; "
        "FLIP by frame:",
        denoiser, confidence, lagOf(frames, &FrameFigures::flip), lagOf(frames, &FrameFigures::rmse));
    for (uint32_t i = 0; i < kFramesAfter; i++)
        if (i < 6 || i % 8 == 7) std::printf(" %.4f", frames[kSwitchFrame + i].flip);
    std::printf("\n");
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
    for (const Comparison& c : runSwitchedLight())
    {
        INFO(c.denoiser);
        print(c.denoiser, "off", c.without);
        print(c.denoiser, "on", c.with);
        CHECK(lagOf(c.with, &FrameFigures::flip) <= kMaxLag);
        CHECK(lagOf(c.with, &FrameFigures::rmse) <= kMaxLag);
        CHECK(lagOf(c.without, &FrameFigures::flip) > kMaxLag); // or the scene would show nothing
        checkConfidence(c, "diffuse", &FrameFigures::diffuse);
        checkConfidence(c, "specular", &FrameFigures::specular);
    }
}
