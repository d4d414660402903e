// Temporal anti-aliasing: edges as smooth as a mean over many sub-pixel positions, at rest and in motion. The scene
// shines by itself, so that there is no noise.
#include "catch.h"
#include "render_fixture.h"
#include "scene_shapes.h"

#include <cmath>
#include <cstdio>

using namespace sample;

namespace
{
constexpr uint32_t kJitterPeriod = 16;
constexpr uint32_t kFrames = 48;
constexpr double kRest = 0.7;            // seconds of animation
constexpr double kPerFrame = 1.0 / 30.0; // some two pixels

Material makeShining(const glm::vec3& radiance)
{
    Material material = makeMaterial("shining", glm::vec3(0.0f), 1.0f, 1.0f);
    material.emission = radiance;
    material.isDoubleSided = true;
    return material;
}

// Slanted bars before a dark wall, moving across it.
Scene makeBars()
{
    Scene scene;
    scene.name = "bars";
    scene.materials = {makeShining(glm::vec3(0.03f, 0.05f, 0.1f)), makeShining(glm::vec3(1.0f, 0.8f, 0.5f))};
    Mesh bars;
    for (int i = 0; i < 5; ++i)
        bars.primitives.push_back(makeQuad(1, glm::vec3(-2.0f + 0.8f * float(i), -1.5f, 0), glm::vec3(0.3f, 0.02f, 0),
                                           glm::vec3(0.5f, 3, 0)));
    scene.meshes = {{{makeQuad(0, glm::vec3(-9, -9, -1), glm::vec3(18, 0, 0), glm::vec3(0, 18, 0))}, {}}, bars};
    scene.nodes = {makeNode("wall", 0, glm::vec3(0.0f), 0.0f), makeNode("bars", 1, glm::vec3(0.0f), 0.0f),
                   makeNode("camera", kNone, glm::vec3(0, 0, 4), 0.0f)};
    scene.nodes[2].camera = 0;
    scene.cameras.push_back({0.6f, 0.05f});
    scene.duration = 4.0f;
    scene.channels.push_back(makeChannel(1, AnimationPath::Translation, 3, scene.duration,
                                         [](float phase)
                                         { return glm::vec3(0.8f * std::sin(phase), 0.1f * std::cos(phase), 0); }));
    return scene;
}

Options optionsFor(bool hasJitter, bool hasTemporalAa)
{
    Options options = test::renderOptions("NONE", false);
    options.width = 128;
    options.height = 72;
    options.hasJitter = hasJitter;
    options.hasTemporalAa = hasTemporalAa;
    return options;
}

// Where the animation rests: with as many sub-pixel positions as there are.
Picture supersampled()
{
    test::Run run(makeBars(), std::nullopt, optionsFor(true, false));
    Picture mean;
    for (uint32_t i = 0; i < kJitterPeriod; ++i)
    {
        run.renderAt(kRest);
        const Picture shown = rangeCompressed(run.shown());
        if (!mean.exists()) mean = Picture(shown.width, shown.height, 3);
        for (size_t c = 0; c < 3; ++c)
            for (size_t p = 0; p < mean.pixelCount(); ++p) mean.planes[c][p] += shown.planes[c][p] / kJitterPeriod;
    }
    return mean;
}

// The last of several frames; the bars come to the place where they rest in it.
Picture render(bool hasTemporalAa, bool isMoving)
{
    test::Run run(makeBars(), std::nullopt, optionsFor(false, hasTemporalAa));
    const uint32_t frames = hasTemporalAa ? kFrames : 1;
    for (uint32_t i = 1; i <= frames; ++i) run.renderAt(kRest - (isMoving ? (frames - i) * kPerFrame : 0.0) + 4.0);
    return rangeCompressed(run.shown());
}
} // namespace

TEST_CASE("temporal anti-aliasing smooths edges at rest and in motion, and drags nothing along", "[quality]")
{
    const Picture smooth = supersampled();
    const double aliased = rmse(render(false, false), smooth, {});
    const double still = rmse(render(true, false), smooth, {}), moving = rmse(render(true, true), smooth, {});
    std::printf("RMSE against 16 sub-pixel positions: aliased %.4f, anti-aliased at rest %.4f, in motion %.4f\n",
                aliased, still, moving);
    CHECK(still < 0.4 * aliased);
    CHECK(moving < 0.8 * aliased);
}
