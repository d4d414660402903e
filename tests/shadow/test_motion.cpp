// What stabilisation gives and costs: less flicker, and how many frames a shadow that moved is still seen.
#include "catch.h"
#include "pictures.h"
#include <algorithm>
#include <cstdio>
#include <runner.h>

using namespace shadow;
using options::Result;
using options::Runner;

namespace
{
constexpr glm::ivec2 kSize{128, 48};
constexpr float kHeight = 2.0f;
constexpr int kStart = 24, kEnd = 60, kSettled = 12;

struct Move
{
    const char* name;
    int frames;   // until it rests
    float metres; // in all, to the right
    float tangent;
};

float edgeAt(const Move& move, int frame)
{
    const int moved = std::clamp(frame - kStart + 1, 0, move.frames);
    return move.metres * (static_cast<float>(moved) / static_cast<float>(move.frames) - 0.5f);
}

// Root mean square over what the edge swept.
double sweptError(const Result& result, const Light& light, const Move& move, int frame)
{
    double sum = 0.0, count = 0.0;
    for (int y = 0; y < kSize.y; y++)
    {
        for (int x = 0; x < kSize.x; x++)
        {
            const glm::vec3 P = options::worldPosition(result.frame, x, y);
            if (std::abs(P.x) > 0.5f * std::abs(move.metres)) continue;
            const double truth = visibleBesideEdge(light, kHeight, edgeAt(move, frame), P);
            const double difference = double(shadowOf(result, result.frame.texel(x, y)).x) - truth;
            sum += difference * difference;
            count += 1.0;
        }
    }
    return std::sqrt(sum / count);
}

// Frames shown after the shadow rests until the error is within 1.25 of what it settles at.
int measureLag(Runner& runner, nrd::Denoiser denoiser, const Move& move)
{
    const Light sun = makeSun(90.0f, 0.0f, move.tangent);
    const Occluder plate = [=](glm::vec3 P, glm::vec3 V, int frame)
    { return makeEdge(kHeight, edgeAt(move, frame))(P, V, frame); };
    runner.start(makeSetup(denoiser, kSize, sun, plate));
    std::vector<double> errors;
    for (int frame = 0; frame < kEnd; frame++) errors.push_back(sweptError(runner.denoise(frame), sun, move, frame));
    double settled = 0.0;
    for (int frame = kEnd - kSettled; frame < kEnd; frame++) settled += errors[size_t(frame)] / kSettled;
    const int rests = kStart + move.frames - 1;
    int frame = rests;
    while (frame < kEnd && errors[size_t(frame)] > 1.25 * settled + 1e-3) frame++;
    std::printf("FIGURE %s, %s: %d frames until the error is what it settles at (%.4f; %.4f when the shadow rests)\n",
                nrd::toString(denoiser), move.name, frame - rests, settled, errors[size_t(rests)]);
    return frame - rests;
}

// Mean square change of visibility from frame to frame.
double measureFlicker(Runner& runner, nrd::Denoiser denoiser, uint32_t frameNum)
{
    options::Setup setup = makeSetup(denoiser, kSize, makeSun(90.0f, 0.0f, 0.2f), makeEdge(kHeight, 0.0f));
    setup.sigmaSettings.maxStabilizedFrameNum = frameNum;
    runner.start(setup);
    Result before;
    double sum = 0.0;
    for (int frame = 0; frame < 24; frame++)
    {
        Result now = runner.denoise(frame);
        for (size_t i = 0; frame >= 12 && i < static_cast<size_t>(kSize.x * kSize.y); i++)
        {
            const double change = double(shadowOf(now, i).x - shadowOf(before, i).x);
            sum += change * change;
        }
        before = std::move(now);
    }
    return std::sqrt(sum / (12.0 * kSize.x * kSize.y));
}
} // namespace

TEST_CASE("a shadow that moved is gone after the frames that stabilisation keeps", "[gpu]")
{
    const Move moves[] = {{"a sharp shadow that jumps", 1, 2.0f, 0.01f},
                          {"a soft shadow that jumps", 1, 2.0f, 0.15f},
                          {"a sharp shadow that leaves", 1, -2.0f, 0.01f},
                          {"a soft shadow that leaves", 1, -2.0f, 0.15f},
                          {"a sharp shadow at a pixel a frame", 16, 2.0f, 0.01f},
                          {"a soft shadow at a pixel a frame", 16, 2.0f, 0.15f},
                          {"a soft shadow that leaves at a pixel a frame", 16, -2.0f, 0.15f}};
    const int longest = static_cast<int>(nrd::SigmaSettings().maxStabilizedFrameNum) + 3;
    for (const nrd::Denoiser denoiser : kBoth)
    {
        Runner runner(denoiser);
        for (const Move& move : moves) CHECK(measureLag(runner, denoiser, move) <= longest);
    }
}

TEST_CASE("stabilisation takes most of the flicker", "[gpu]")
{
    for (const nrd::Denoiser denoiser : kBoth)
    {
        Runner runner(denoiser);
        const double without = measureFlicker(runner, denoiser, 0);
        for (const uint32_t frameNum : {5u, 8u, 15u})
        {
            const double with = measureFlicker(runner, denoiser, frameNum);
            std::printf("FIGURE %s, %u frames of stabilisation: flicker %.5f, %.3f of that without\n",
                        nrd::toString(denoiser), frameNum, with, with / without);
            CHECK(with < 0.5 * without);
        }
    }
}
