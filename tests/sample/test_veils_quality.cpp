// What one looks through, and what bends, leaves no trails: errors while it moves, and how long they last afterwards.
#include "catch.h"
#include "render_fixture.h"
#include "scene_veils.h"

#include <algorithm>
#include <cstdio>

using namespace sample;

namespace
{
constexpr uint32_t kMoving = 20; // frames, the last two of them with references
constexpr uint32_t kStill = 24;  // frames after that in which nothing moves any more
constexpr uint32_t kSettled = 8; // the last of them
constexpr uint32_t kSamples = 96;
constexpr double kPerFrame = 1.0 / 60.0; // seconds of animation

struct Thing
{
    const char* name;
    double place; // along X
};
constexpr Thing kThings[] = {{"glass, refracting", kVeilPlaces[0]},
                             {"blended", kVeilPlaces[1]},
                             {"masked", kVeilPlaces[2]},
                             {"skinned", kVeilPlaces[3]}};
constexpr size_t kThingCount = std::size(kThings);

struct Figures
{
    double flicker = 0.0;
    double moving = 0.0;  // FLIP in the last frame of the movement
    double settled = 0.0; // FLIP long after it
    int lag = 0;          // frames after the movement until FLIP is less than 1.25 times the settled one
};

// Pixels that the thing crosses: half a metre to either side of its place.
Mask maskOf(const Camera& camera, const Thing& thing, int width, int height)
{
    Mask mask(size_t(width) * size_t(height));
    const auto column = [&](double x)
    {
        const glm::vec4 clip = camera.viewToClip * camera.worldToView * glm::vec4(float(x), 0.8f, 0.0f, 1.0f);
        return (0.5f + 0.5f * clip.x / clip.w) * float(width);
    };
    for (size_t i = 0; i < mask.size(); ++i)
    {
        const float x = float(i % size_t(width));
        mask[i] = x > column(thing.place - 0.55) && x < column(thing.place + 0.55);
    }
    return mask;
}

Picture toneMappedShown(test::Run& run) { return toneMapped(run.shown()); }

std::array<Figures, kThingCount> measure(bool hasWrongMotion)
{
    Options options = test::renderOptions("REBLUR_DIFFUSE_SPECULAR", false);
    options.width = 240;
    options.height = 90;
    if (hasWrongMotion) options.settings = {{"motionVectorScale", "-1,-1,-1"}};
    test::Run run(makeVeils(), makeUniformEnvironment(glm::vec3(0.9f, 1.0f, 1.1f)), options);
    for (uint32_t i = 0; i + 1 < kMoving; ++i) run.renderAt(i * kPerFrame);
    const Picture before = toneMappedShown(run), referenceBefore = toneMapped(run.reference(kSamples));
    constexpr double kRest = (kMoving - 1) * kPerFrame;
    run.renderAt(kRest);
    const Picture now = toneMappedShown(run), reference = run.reference(kSamples), encoded = toneMapped(reference);
    std::array<Mask, kThingCount> masks;
    std::array<Figures, kThingCount> all;
    std::array<std::vector<double>, kThingCount> errors;
    for (uint32_t i = 0; i <= kStill; ++i)
    {
        const Picture shown = run.shown();
        for (size_t k = 0; k < kThingCount; ++k)
        {
            if (i == 0) masks[k] = maskOf(run.renderer().frame().view.camera, kThings[k], 240, 90);
            errors[k].push_back(test::flipOf(shown, reference, masks[k]));
        }
        if (i < kStill) run.renderAt(kRest);
    }
    for (size_t k = 0; k < kThingCount; ++k)
    {
        Figures& f = all[k];
        f.flicker = flicker({now, before, encoded, referenceBefore}, masks[k]);
        f.moving = errors[k].front();
        for (uint32_t i = 0; i < kSettled; ++i) f.settled += errors[k][errors[k].size() - 1 - i] / kSettled;
        f.lag = int(std::find_if(errors[k].begin(), errors[k].end(), [&](double e) { return e < 1.25 * f.settled; }) -
                    errors[k].begin());
    }
    return all;
}
} // namespace

TEST_CASE("glass, blended, masked and skinned things leave no trails", "[quality]")
{
    const std::array<Figures, kThingCount> right = measure(false), wrong = measure(true);
    for (size_t k = 0; k < kThingCount; ++k)
        for (const Figures* f : {&right[k], &wrong[k]})
            std::printf("%-18s %-15s flicker %.4f, FLIP %.4f moving and %.4f settled, lag %d frames\n", kThings[k].name,
                        f == &right[k] ? "" : "motion reversed", f->flicker, f->moving, f->settled, f->lag);
    CHECK(right[0].lag < 8);
}
