// History is of the last frame, of the same surface, and of nothing else.
#include "catch.h"
#include "pictures.h"
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>
#include <runner.h>

using namespace shadow;
using options::Result;
using options::Runner;

namespace
{
constexpr glm::ivec2 kSize{100, 75}; // not of whole tiles
constexpr int kSkyFrame = 5;
constexpr float kNear = 10.0f; // of viewZ

const Light kSun = makeSun(60.0f, 30.0f, 0.1f);

options::Setup makeFloor(nrd::Denoiser denoiser) { return makeSetup(denoiser, kSize, kSun, makeEdge(2.0f, 1.0f)); }

// Until `frame` other rays arrive: what of them is still seen later was remembered.
void shadowBefore(options::Setup& setup, int frame)
{
    setup.rayAt = [rayAt = setup.rayAt, frame](glm::vec3 P, glm::ivec2 pixel, int now)
    {
        const bool isOther = now < frame && pixel.x % 3 != 0;
        return isOther ? options::LightRay{0.4f, glm::vec4(0.0f)} : rayAt(P, pixel, now);
    };
}

size_t countMemories(nrd::Denoiser denoiser, options::Setup setup, int firstFrame, int frameCount)
{
    Runner runner(denoiser);
    std::vector<Result> one, other;
    for (std::vector<Result>* results : {&one, &other})
    {
        runner.start(setup);
        for (int frame = 0; frame < firstFrame + frameCount; frame++) results->push_back(runner.denoise(frame));
        shadowBefore(setup, kSkyFrame);
    }
    size_t different = 0;
    for (int frame = 0; frame < kSkyFrame; frame++)
        different += options::countDifferent(one[size_t(frame)], other[size_t(frame)]);
    CHECK(different > 0); // the other rays are seen, or the test would say nothing
    different = 0;
    for (int frame = firstFrame; frame < firstFrame + frameCount; frame++)
        different += options::countDifferent(one[size_t(frame)], other[size_t(frame)]);
    return different;
}

// Nods, so that from frame to frame the floor gives way to the sky and comes back, by several pixels.
quality::Camera nod(int frame)
{
    const float pitch = -0.25f + 0.12f * std::sin(1.3f * static_cast<float>(frame));
    const glm::vec3 eye(0.0f, 1.5f, -4.0f);
    quality::Camera camera;
    camera.position = eye;
    camera.worldToView = glm::lookAtLH(eye, eye + glm::vec3(0.0f, pitch, 1.0f), {0, 1, 0});
    return camera;
}

// A backdrop in place of the sky, where it is told from the floor by its depth alone.
void hangBackdrop(options::Setup& setup)
{
    setup.scene = [scene = setup.scene](const quality::Camera& camera, glm::ivec2 size, int frame)
    {
        quality::Guides guides = scene(camera, size, frame);
        for (float& z : guides.viewZ) z = std::min(z, 0.9f * quality::kDenoisingRange);
        return guides;
    };
}

// Largest difference on the floor, of all frames; nearer than where a window of pixels reaches its end.
double differenceOnFloor(const std::vector<Result>& a, const std::vector<Result>& b)
{
    double worst = 0.0;
    for (size_t frame = 0; frame < a.size(); frame++)
        for (size_t i = 0; i < a[frame].frame.guides.viewZ.size(); i++)
            if (a[frame].frame.guides.viewZ[i] < kNear)
                worst = std::max(worst, double(std::abs(shadowOf(a[frame], i).x - shadowOf(b[frame], i).x)));
    return worst;
}
} // namespace

TEST_CASE("what was sky has no history when a surface comes back", "[gpu]")
{
    for (const nrd::Denoiser denoiser : kBoth)
    {
        options::Setup setup = makeFloor(denoiser);
        setup.changeCommon = [](nrd::CommonSettings& common, int) { common.enableCutDetection = false; };
        setup.scene = [scene = setup.scene](const quality::Camera& camera, glm::ivec2 size, int frame)
        {
            quality::Guides guides = scene(camera, size, frame);
            if (frame == kSkyFrame) guides.viewZ.assign(guides.viewZ.size(), 2.0f * quality::kDenoisingRange);
            return guides;
        };
        CHECK(countMemories(denoiser, setup, kSkyFrame, 4) == 0);
    }
}

TEST_CASE("a floor's history is the same whether sky or something far takes its place on the screen", "[gpu]")
{
    for (const nrd::Denoiser denoiser : kBoth)
    {
        Runner runner(denoiser);
        std::vector<Result> sky, backdrop;
        options::Setup setup = makeFloor(denoiser);
        setup.projection = options::Projection::Perspective;
        setup.camera = nod;
        for (std::vector<Result>* results : {&sky, &backdrop})
        {
            runner.start(setup);
            for (int frame = 0; frame < 10; frame++) results->push_back(runner.denoise(frame));
            hangBackdrop(setup);
        }
        const double difference = differenceOnFloor(sky, backdrop);
        std::printf("FIGURE %s, sky or a backdrop behind a floor that nods: largest difference %.5f\n",
                    nrd::toString(denoiser), difference);
        CHECK(difference < 1e-3);
    }
}

TEST_CASE("after a restart nothing old is left, also where the rectangle is smaller than the image", "[gpu]")
{
    for (const nrd::Denoiser denoiser : kBoth)
    {
        for (const bool isSmaller : {false, true})
        {
            options::Setup setup = makeFloor(denoiser);
            if (isSmaller) setup.rect = {61, 37};
            setup.changeCommon = [](nrd::CommonSettings& common, int frame)
            { common.accumulationMode = static_cast<nrd::AccumulationMode>(frame == kSkyFrame ? 1 : 0); };
            CHECK(countMemories(denoiser, setup, kSkyFrame, 6) == 0);
        }
    }
}

TEST_CASE("what lies beyond the rectangle is never looked at", "[gpu]")
{
    constexpr glm::ivec2 kRect{61, 37};
    for (const nrd::Denoiser denoiser : kBoth)
    {
        Runner runner(denoiser);
        for (const bool hasHistory : {true, false})
        {
            options::Setup whole = makeFloor(denoiser);
            whole.hasHistory = hasHistory;
            whole.size = whole.rect = kRect;
            const Result alone = options::runFrames(runner, whole, 4);
            options::Setup part = whole;
            part.size = kSize;
            part.origin = {17, 30};
            const Result inside = options::runFrames(runner, part, 4);
            CHECK(options::countDifferent(alone, inside) == 0);
            CHECK(options::countStray(inside) == 0);
        }
    }
}

TEST_CASE("tiles of a larger rectangle are not those of the smaller one that follows", "[gpu]")
{
    for (const nrd::Denoiser denoiser : kBoth)
    {
        Runner runner(denoiser);
        options::Setup setup = makeFloor(denoiser);
        setup.hasHistory = false;
        options::Setup smaller = setup;
        smaller.rect = {50, 33};
        runner.start(smaller);
        const Result fresh = runner.denoise(1);
        runner.start(setup);
        (void)runner.denoise(0);
        runner.change(smaller);
        CHECK(options::countDifferent(runner.denoise(1), fresh) == 0);
    }
}
