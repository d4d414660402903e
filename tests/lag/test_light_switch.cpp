// A light goes off and on again, then a shadow's edge crosses a part of the picture: how many frames go by until the
// error is near what it settles at.
#include "catch.h"
#include "picture.h"
#include "variants.h"
#include <cstdio>

using namespace lag;

namespace
{
constexpr int kOff = 40, kOn = 80, kEdgeStarts = 120, kEdgeRests = 132, kEnd = 172;
constexpr int kSettledFrames = 10;
constexpr float kDimmed = 0.2f;
constexpr int kEdgeBegin = kWidth / 4, kEdgeSpeed = 4; // pixels, pixels a frame
constexpr int kMostFrames = 8;

const bool kStates[] = {true, false};

int edgeAt(int frame) { return kEdgeBegin + kEdgeSpeed * std::clamp(frame - kEdgeStarts, 0, kEdgeRests - kEdgeStarts); }

Means meansAt(int frame)
{
    Means means(kPixelCount, frame >= kOff && frame < kOn ? kDimmed : 1.0f);
    // The shadow falls on the left of its edge, from the edge's first frame on.
    for (size_t i = 0; i < kPixelCount; i++)
    {
        const int x = int(i) % kWidth;
        if (x < kEdgeBegin || (frame >= kEdgeStarts && x < edgeAt(frame))) means[i] *= kDimmed;
    }
    return means;
}

struct Lags
{
    int off, on, edge;
};

// Frames shown with an error of 1.25 times the settled one or more, before the first with less.
int lagOf(const std::vector<double>& errors, int change, int next)
{
    double settled = 0.0;
    for (int frame = next - kSettledFrames; frame < next; frame++) settled += errors[size_t(frame)] / kSettledFrames;
    int frame = change;
    while (frame < next && errors[size_t(frame)] >= 1.25 * settled) frame++;
    return frame - change;
}

Lags measureLags(nrd::Denoiser denoiser, Reaction reaction)
{
    quality::Harness harness(kWidth, kHeight, makeSettings(denoiser, reaction), denoiser);
    const quality::Guides guides =
        quality::renderGuides(quality::makeCamera(0, 0.0f, kWidth, kHeight), kWidth, kHeight);
    const auto isInRange = [&](size_t i) { return guides.viewZ[i] < quality::kDenoisingRange; };
    const auto isSwept = [&](size_t i)
    {
        const int x = int(i) % kWidth;
        return isInRange(i) && x >= kEdgeBegin && x < edgeAt(kEnd);
    };
    std::vector<double> picture, swept;
    for (int frame = 0; frame < kEnd; frame++)
    {
        const Means means = meansAt(frame);
        const quality::Signal& out = denoiseLobe(harness, denoiser, guides, makePathNoise(means, unsigned(frame)));
        picture.push_back(pictureError(out, means, isInRange));
        swept.push_back(pictureError(out, means, isSwept));
    }
    if (getenv("LAG_CURVE")) { for (int f : {39,40,41,42,43,44,46,48,52,56,60,64,70,79,80,81,82,84,86,88,92,96,100,110,119}) std::printf("%d:%.4f ", f, picture[size_t(f)]); std::printf("| "); for (int f : {131,132,133,134,136,138,140,144,150,160,171}) std::printf("%d:%.4f ", f, swept[size_t(f)]); std::printf("\n"); }
    return {lagOf(picture, kOff, kOn), lagOf(picture, kOn, kEdgeStarts), lagOf(swept, kEdgeRests, kEnd)};
}

void checkNotSlower(const Lags& with, const Lags& without)
{
    CHECK(with.off <= without.off);
    CHECK(with.on <= without.on);
    CHECK(with.edge <= without.edge);
}

void checkDenoiser(nrd::Denoiser denoiser)
{
    Lags lags[2][2];
    for (const bool hasAntilag : kStates)
    {
        for (const bool hasClamping : kStates)
        {
            const Lags lag = lags[hasAntilag][hasClamping] = measureLags(denoiser, {hasAntilag, hasClamping});
            std::printf("FIGURE %s, antilag %s, fast clamp %s: lag of light off %d, on %d, shadow edge %d frames\n",
                        nrd::toString(denoiser), hasAntilag ? "on" : "off", hasClamping ? "on" : "off", lag.off, lag.on,
                        lag.edge);
        }
    }
    INFO(nrd::toString(denoiser));
    const Lags& both = lags[1][1];
    CHECK(both.off <= kMostFrames);
    CHECK(both.on <= kMostFrames);
    CHECK(both.edge <= kMostFrames);
    checkNotSlower(both, lags[0][0]);
}
} // namespace

TEST_CASE("a change of light is followed within 8 frames", "[gpu]")
{
    for (const nrd::Denoiser denoiser : kDenoisers) checkDenoiser(denoiser);
}
