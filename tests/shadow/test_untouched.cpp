// Where nothing is in doubt the output is exactly light or darkness.
#include "catch.h"
#include "pictures.h"
#include <algorithm>
#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>
#include <runner.h>

using namespace shadow;
using options::Result;
using options::Runner;

namespace
{
constexpr glm::ivec2 kSize{128, 48};
constexpr float kHeight = 2.0f;
constexpr float kReach = 1.3f;    // metres from the middle of the penumbra that may be touched
constexpr float kFarthest = 6.0f; // of viewZ; beyond, some pixels are a metre

const Light kSun = makeSun(90.0f, 0.0f, 0.1f); // half of the penumbra's width: 0.2 m

// Pixels far from the edge that are not as light, or as dark, as they should be.
size_t countTouched(const Result& result, float edge)
{
    const bool hasColor = result.frame.formats.count(nrd::ResourceType::IN_TRANSLUCENCY) > 0;
    size_t touched = 0;
    for (int y = 0; y < result.frame.rect.y; y++)
    {
        for (int x = 0; x < result.frame.rect.x; x++)
        {
            if (result.frame.guides.viewZ[result.frame.pixel(x, y)] > kFarthest) continue;
            const float fromEdge = options::worldPosition(result.frame, x, y).x - edge;
            const glm::vec4 expected(fromEdge > 0.0f ? 1.0f : 0.0f);
            const glm::vec4 v = shadowOf(result, result.frame.texel(x, y));
            touched += std::abs(fromEdge) > kReach && (hasColor ? v != expected : v.x != expected.x);
        }
    }
    return touched;
}

options::Setup makeStill(nrd::Denoiser denoiser) { return makeSetup(denoiser, kSize, kSun, makeEdge(kHeight, 0.0f)); }

constexpr int kStart = 4, kRests = 12, kEnd = 36; // frames of a shadow that moves

float edgeAt(int frame) { return -2.0f + 0.5f * static_cast<float>(std::clamp(frame, kStart, kRests) - kStart); }

quality::Camera flyOver(int frame)
{
    const float t = static_cast<float>(frame);
    const glm::vec3 eye(-0.3f + 0.07f * t, 1.5f + 0.02f * t, -4.0f + 0.05f * t);
    quality::Camera camera;
    camera.position = eye;
    camera.worldToView = glm::lookAtLH(eye, eye + glm::vec3(0.02f * t, -0.3f, 1.0f), {0, 1, 0});
    return camera;
}
} // namespace

TEST_CASE("full light and full shadow come back exactly, whatever the format and the history", "[gpu]")
{
    for (const nrd::Denoiser denoiser : kBoth)
    {
        Runner runner(denoiser);
        for (const bool hasLargeFormats : {true, false})
        {
            for (const bool hasHistory : {true, false})
            {
                options::Setup setup = makeStill(denoiser);
                setup.hasLargeFormats = hasLargeFormats;
                setup.hasHistory = hasHistory;
                runner.start(setup);
                INFO(nrd::toString(denoiser) << ", large " << hasLargeFormats << ", history " << hasHistory);
                for (int frame = 0; frame < 6; frame++) CHECK(countTouched(runner.denoise(frame), 0.0f) == 0);
            }
        }
    }
}

TEST_CASE("full light and full shadow come back exactly under a moving camera", "[gpu]")
{
    for (const nrd::Denoiser denoiser : kBoth)
    {
        Runner runner(denoiser);
        options::Setup setup = makeStill(denoiser);
        setup.projection = options::Projection::Perspective;
        setup.camera = flyOver;
        runner.start(setup);
        for (int frame = 0; frame < 16; frame++)
        {
            INFO(nrd::toString(denoiser) << ", frame " << frame);
            CHECK(countTouched(runner.denoise(frame), 0.0f) == 0);
        }
    }
}

TEST_CASE("some frames after a shadow has passed nothing of it is left, to the last bit", "[gpu]")
{
    for (const nrd::Denoiser denoiser : kBoth)
    {
        Runner runner(denoiser);
        for (const float sign : {1.0f, -1.0f}) // covers, and gives free
        {
            const auto edge = [=](int frame) { return sign * edgeAt(frame); };
            options::Setup setup = makeSetup(denoiser, kSize, kSun,
                                             [=](glm::vec3 P, glm::vec3 V, int frame)
                                             { return makeEdge(kHeight, edge(frame))(P, V, frame); });
            runner.start(setup);
            int last = kRests;
            for (int frame = 0; frame < kEnd; frame++)
                if (countTouched(runner.denoise(frame), edge(frame)) > 0 && frame >= kRests) last = frame + 1;
            std::printf("FIGURE %s, a shadow that %s: exact %d frames after it rests\n", nrd::toString(denoiser),
                        sign > 0.0f ? "covers light" : "leaves", last - kRests);
            CHECK(last - kRests <= int(setup.sigmaSettings.maxStabilizedFrameNum) + 4);
        }
    }
}
