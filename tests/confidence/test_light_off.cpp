// A light goes off: how long its light stays in the picture, with and without confidence.
#include "catch.h"
#include "switched_light.h"
#include <cstdio>

using namespace confidence;

namespace
{
constexpr const char* kNames[] = {"REBLUR_DIFFUSE_SPECULAR", "RELAX_DIFFUSE_SPECULAR"};
constexpr const char* kBoth = "REBLUR_DIFFUSE_SPECULAR,RELAX_DIFFUSE_SPECULAR";
constexpr uint32_t kSettledFrames = 10;
constexpr int kMaxLag = 4;

using Field = double FrameFigures::*;

// Frames until the error is under 1.25 times what it settles at.
int lagOf(const std::vector<FrameFigures>& frames, Field error)
{
    double settled = 0.0;
    for (size_t i = frames.size() - kSettledFrames; i < frames.size(); i++)
        settled += frames[i].*error / double(kSettledFrames);
    size_t frame = kSwitchFrame;
    while (frame < frames.size() && frames[frame].*error >= 1.25 * settled) frame++;
    return int(frame - kSwitchFrame);
}

void print(const char* name, bool hasConfidence, const std::vector<FrameFigures>& frames)
{
    std::printf("FIGURE %s, confidence %s: frames to 1.25 of the settled error after a light goes off: FLIP %d, RMSE %d; "
                "FLIP by frame:",
                name, hasConfidence ? "on" : "off", lagOf(frames, &FrameFigures::flip),
                lagOf(frames, &FrameFigures::rmse));
    for (uint32_t i = 0; i < kFramesAfter; i++)
        if (i < 6 || i % 8 == 7) std::printf(" %.4f", frames[kSwitchFrame + i].flip);
    std::printf("\n");
}
} // namespace

TEST_CASE("with confidence a light that went off is gone within four frames, and history is kept while nothing changes",
          "[gpu]")
{
    const auto with = runSwitchedLight(kBoth, true), without = runSwitchedLight(kBoth, false);
    for (size_t i = 0; i < std::size(kNames); i++)
    {
        INFO(kNames[i]);
        print(kNames[i], false, without[i]);
        print(kNames[i], true, with[i]);
        CHECK(lagOf(with[i], &FrameFigures::flip) <= kMaxLag);
        for (const auto lobe : {&FrameFigures::diffuse, &FrameFigures::specular})
        {
            std::printf("FIGURE %s, mean confidence: before %.4f, of the switch %.4f, then %.4f\n", kNames[i],
                        *(with[i][kSwitchFrame - 1].*lobe), *(with[i][kSwitchFrame].*lobe),
                        *(with[i][kSwitchFrame + 1].*lobe));
            CHECK(*(with[i][kSwitchFrame - 1].*lobe) > 0.95);
            CHECK(*(with[i][kSwitchFrame].*lobe) < 0.3);
            CHECK(*(with[i][kSwitchFrame + 1].*lobe) > 0.95);
            CHECK_FALSE(without[i][kSwitchFrame].diffuse.has_value());
        }
    }
}
