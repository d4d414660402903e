// What one looks through, and what bends, leaves no trails: errors while it moves, and how long they last afterwards.
#include "catch.h"
#include "render_fixture.h"
#include "scene_veils.h"

#include <algorithm>
#include <cstdio>
#include <numeric>

using namespace sample;

namespace
{
constexpr uint32_t kWidth = 224, kHeight = 84;
constexpr uint32_t kMoving = 12;  // frames, the last two of them with references
constexpr uint32_t kTrailing = 6; // frames in which what was there could still be seen
constexpr uint32_t kStill = 20;   // frames after that in which nothing moves any more
constexpr uint32_t kSettled = 4;  // the last of them
constexpr uint32_t kSamples = 64;
constexpr double kPerFrame = 0.13; // seconds of animation

struct Thing
{
    const char* name;
    double place; // along X
    bool hasMotion;
};
constexpr Thing kThings[] = {{"glass, refracting", kVeilPlaces[0], false},
                             {"blended", kVeilPlaces[1], false},
                             {"masked", kVeilPlaces[2], true},
                             {"skinned", kVeilPlaces[3], true}};

struct Figures
{
    double flicker = 0.0;
    double trail = 0.0;   // see trailOf(), in the last frame of the movement
    double moving = 0.0;  // FLIP where the thing was or is, in that frame
    double settled = 0.0; // and long after it
    int lag = 0;          // frames after the movement until FLIP is less than 1.25 times the settled one
};

// Pixels that the thing crosses: half a metre to either side of its place.
Mask maskOf(const Camera& camera, const Thing& thing)
{
    Mask mask(kWidth * kHeight);
    const auto column = [&](double x)
    {
        const glm::vec4 clip = camera.viewToClip * camera.worldToView * glm::vec4(float(x), 0.8f, 0.0f, 1.0f);
        return (0.5f + 0.5f * clip.x / clip.w) * float(kWidth);
    };
    for (size_t i = 0; i < mask.size(); ++i)
    {
        const float x = float(i % kWidth);
        mask[i] = x > column(thing.place - 0.55) && x < column(thing.place + 0.55);
    }
    return mask;
}

// How the pixels of the last frame changed in the frames before it.
struct Crossed
{
    Mask uncovered; // something stood before what is seen now, or tinted it
    Mask covered;
};

Crossed crossedIn(const std::vector<Planes>& frames)
{
    const Planes& last = frames.back();
    Crossed crossed = {Mask(last.pixelCount()), Mask(last.pixelCount())};
    for (const Planes& frame : frames)
        for (size_t i = 0; i < last.pixelCount(); ++i)
        {
            const float was = std::abs(frame[Channel::ViewZ][i]), is = std::abs(last[Channel::ViewZ][i]);
            const float tint = last[Channel::DiffuseFactorR][i] / frame[Channel::DiffuseFactorR][i];
            crossed.covered[i] |= is < 0.98f * was;
            crossed.uncovered[i] |= is > 1.02f * was || (is > 0.98f * was && (tint < 0.9f || tint > 1.1f));
        }
    return crossed;
}

Mask both(Mask a, const Mask& b)
{
    for (size_t i = 0; i < a.size(); ++i) a[i] &= b[i];
    return a;
}

// Light that is left where something was, or missing where something is: mean difference to the same view long after,
// which noise has none of, as a share of its mean.
double trailOf(const Picture& shown, const Picture& settled, const Mask& mask)
{
    double difference = 0.0, sum = 0.0;
    for (size_t c = 0; c < 3; ++c)
        for (size_t i = 0; i < mask.size(); ++i)
        {
            difference += mask[i] ? double(shown.planes[c][i]) - double(settled.planes[c][i]) : 0.0;
            sum += mask[i] ? double(settled.planes[c][i]) : 0.0;
        }
    return sum > 0.0 ? std::abs(difference) / sum : 0.0;
}

// Of the last two frames of the movement; the thing stays where it is in the last one.
struct References
{
    Picture before, last;
};

class Recording
{
public:
    explicit Recording(bool hasWrongMotion)
        : m_run(makeVeils(), makeUniformEnvironment(glm::vec3(0.9f, 1.0f, 1.1f)), optionsFor(hasWrongMotion))
    {
    }

    // Traces the references where there are none.
    void render(std::optional<References>& references)
    {
        std::vector<Planes> guides;
        for (uint32_t i = 0; i + 1 < kMoving; ++i)
        {
            m_run.renderAt(i * kPerFrame);
            if (i + 1 + kTrailing >= kMoving) guides.push_back(m_run.renderer().readFrame());
        }
        m_before = m_run.shown();
        Picture before = references ? Picture() : m_run.reference(kSamples);
        for (uint32_t i = 0; i <= kStill; ++i)
        {
            m_run.renderAt((kMoving - 1) * kPerFrame);
            m_frames.push_back(m_run.shown());
            if (i == 0) guides.push_back(m_run.renderer().readFrame());
            if (!references) references = {std::move(before), m_run.reference(kSamples)};
        }
        m_crossed = crossedIn(guides);
    }

    Figures measure(const Thing& thing, const References& references)
    {
        const Mask place = maskOf(m_run.renderer().frame().view.camera, thing);
        const Mask uncovered = both(place, m_crossed.uncovered), covered = both(place, m_crossed.covered);
        Mask mask = uncovered;
        for (size_t i = 0; i < mask.size(); ++i) mask[i] |= covered[i];
        std::vector<double> errors;
        for (const Picture& frame : m_frames) errors.push_back(test::flipOf(frame, references.last, mask));
        Figures f;
        f.flicker = flicker({toneMapped(m_frames.front()), toneMapped(m_before), toneMapped(references.last),
                             toneMapped(references.before)},
                            mask);
        f.trail = std::max(trailOf(m_frames.front(), m_frames.back(), uncovered),
                           trailOf(m_frames.front(), m_frames.back(), covered));
        f.moving = errors.front();
        f.settled = std::accumulate(errors.end() - kSettled, errors.end(), 0.0) / kSettled;
        f.lag = int(std::find_if(errors.begin(), errors.end(), [&](double e) { return e < 1.25 * f.settled; }) -
                    errors.begin());
        return f;
    }

private:
    static Options optionsFor(bool hasWrongMotion)
    {
        Options options = test::renderOptions("REBLUR_DIFFUSE_SPECULAR", false);
        options.width = kWidth;
        options.height = kHeight;
        if (hasWrongMotion) // and nothing on that would notice it
            options.settings = {{"motionVectorScale", "-3,-3,-3"},
                                {"disocclusionThreshold", "1"},
                                {"maxFastAccumulatedFrameNum", "63"},
                                {"maxStabilizedFrameNum", "0"}};
        return options;
    }

    test::Run m_run;
    Crossed m_crossed;
    Picture m_before;
    std::vector<Picture> m_frames; // from the last one of the movement on
};
} // namespace

TEST_CASE("glass, blended, masked and skinned things leave no trails", "[quality]")
{
    std::optional<References> references;
    Recording asIs(false), reversed(true);
    asIs.render(references);
    reversed.render(references);
    for (const Thing& thing : kThings)
    {
        const Figures figures[] = {asIs.measure(thing, *references), reversed.measure(thing, *references)};
        for (const Figures& f : figures)
            std::printf("%-18s %-15s flicker %.4f, trail %.4f, FLIP %.4f moving and %.4f settled, lag "
                        "%d frames\n",
                        thing.name, &f == figures ? "" : "motion reversed", f.flicker, f.trail, f.moving, f.settled,
                        f.lag);
        const Figures &right = figures[0], &wrong = figures[1];
        INFO(thing.name);
        CHECK(right.flicker < 0.03);
        CHECK(right.trail < 0.06);
        CHECK(right.moving < 1.6 * right.settled);
        CHECK(right.lag <= 6);
        // What is seen through glass and panes stands still, so that reversing does nothing to it.
        if (!thing.hasMotion) continue;
        CHECK(wrong.trail > 0.12);
        CHECK(wrong.lag > 6);
    }
}
