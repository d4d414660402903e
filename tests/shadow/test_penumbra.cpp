// Penumbrae behind a straight edge and under a sphere, against the closed form: error, width, contacts.
#include "catch.h"
#include "pictures.h"
#include <cstdio>
#include <runner.h>

using namespace shadow;
using options::Result;
using options::Runner;

namespace
{
constexpr glm::ivec2 kSize{160, 48};
constexpr int kFrames = 12;

// A plate whose edge throws a penumbra of `width` pixels down the middle of the floor.
struct EdgeCase
{
    float width; // pixels
    float elevation, azimuth;
    bool isLightKnown;
};

struct Edge
{
    Light light;
    float height, x;

    Truth truth() const
    {
        return [*this](glm::vec3 P) { return visibleBesideEdge(light, height, x, P); };
    }
};

Edge makeEdgeOf(const EdgeCase& c)
{
    constexpr float kDistance = 40.0f; // to the edge: small angles, so that a penumbra is even on both sides
    const float middle = 0.37f * pixelSizeOf(kSize); // off the border between two pixels, where there were no noise
    const float sine = std::sin(glm::radians(c.elevation));
    const float stretch = c.azimuth == 0.0f ? 1.0f / sine : 1.0f; // across the edge
    const float tangent = 0.5f * c.width * pixelSizeOf(kSize) / (kDistance * stretch);
    const Light light = makeSun(c.elevation, c.azimuth, tangent);
    return {light, kDistance * light.direction.y, middle + kDistance * light.direction.x};
}

options::Setup makeEdgeSetup(nrd::Denoiser denoiser, const EdgeCase& c)
{
    const Edge edge = makeEdgeOf(c);
    options::Setup setup = makeSetup(denoiser, kSize, edge.light, makeEdge(edge.height, edge.x));
    if (!c.isLightKnown) hideLight(setup);
    return setup;
}

struct Figures
{
    Errors errors;
    double width, trueWidth; // pixels

    double share() const { return errors.denoised / errors.noisy; }
};

Figures measure(const Result& result, Rows rows, const Truth& truth)
{
    return {measureErrors(result, truth), widthOf(denoisedProfile(result, rows)),
            widthOf(trueProfile(result, rows, truth))};
}

Figures measureEdge(Runner& runner, nrd::Denoiser denoiser, const EdgeCase& c)
{
    const Result last = options::runFrames(runner, makeEdgeSetup(denoiser, c), kFrames);
    const Figures f = measure(last, {0, kSize.y}, makeEdgeOf(c).truth());
    std::printf("FIGURE %s, penumbra of %g pixels, sun at %g degrees %s the edge, %s: error %.4f, noisy %.4f; "
                "width %.2f, true %.2f\n",
                nrd::toString(denoiser), double(c.width), double(c.elevation), c.azimuth == 0.0f ? "across" : "along",
                c.isLightKnown ? "known" : "unknown", f.errors.denoised, f.errors.noisy, f.width, f.trueWidth);
    return f;
}

// Noise of narrow penumbrae can't be told from an edge, and a kernel that is not stretched along the light is short of
// pixels.
double expectedShare(const EdgeCase& c)
{
    if (c.width < 10.0f) return 0.5;
    return c.isLightKnown ? 0.2 : 0.4;
}

void checkWidths(Runner& runner, nrd::Denoiser denoiser, EdgeCase c)
{
    double widest = 0.0;
    for (const float width : {1.0f, 4.0f, 16.0f, 40.0f})
    {
        c.width = width;
        const Figures f = measureEdge(runner, denoiser, c);
        INFO(nrd::toString(denoiser) << ", " << width << " pixels, elevation " << c.elevation << ", azimuth "
                                     << c.azimuth << ", " << c.isLightKnown);
        CHECK(f.share() < expectedShare(c));
        CHECK(f.width == Approx(f.trueWidth).epsilon(0.25));
        CHECK(f.width > widest);
        widest = f.width;
    }
}
} // namespace

TEST_CASE("the closed form of a penumbra is the mean of its rays", "[unit]")
{
    for (const float azimuth : {0.0f, 90.0f, 30.0f})
    {
        const Edge edge = makeEdgeOf({40.0f, 30.0f, azimuth, true});
        const Light lamp = makeLamp({0.5f, 1.0f, 0.2f}, 0.2f);
        for (float x = -4.0f; x < 4.0f; x += 0.1f)
        {
            const glm::vec3 P(x, 0.0f, 0.3f);
            const double sun = meanOf(edge.light, makeEdge(edge.height, edge.x), P, 0).x;
            CHECK(visibleBesideEdge(edge.light, edge.height, edge.x, P) == Approx(sun).margin(0.01));
            const double local = meanOf(lamp, makeEdge(0.4f, 0.1f), P, 0).x;
            CHECK(visibleBesideEdge(lamp, 0.4f, 0.1f, P) == Approx(local).margin(0.01));
        }
    }
}

TEST_CASE("penumbrae of any width under any sun come out as wide as they are, with little of the noise", "[gpu]")
{
    Runner runner(nrd::Denoiser::SIGMA_SHADOW);
    for (const float elevation : {80.0f, 30.0f, 10.0f})
        for (const float azimuth : {0.0f, 90.0f})
            for (const bool isKnown : {true, false})
                checkWidths(runner, nrd::Denoiser::SIGMA_SHADOW, {0.0f, elevation, azimuth, isKnown});
    Runner translucent(nrd::Denoiser::SIGMA_SHADOW_TRANSLUCENCY);
    checkWidths(translucent, nrd::Denoiser::SIGMA_SHADOW_TRANSLUCENCY, {0.0f, 30.0f, 0.0f, true});
}

TEST_CASE("a shadow is sharp at the foot of its wall and widens with the distance", "[gpu]")
{
    constexpr glm::ivec2 kFloor{160, 96};
    constexpr int kBand = 4;                        // rows
    const Light sun = makeSun(45.0f, -90.0f, 0.1f); // from behind the wall
    const Truth truth = [&](glm::vec3 P) { return visibleBesideWall(sun, P); };
    for (const nrd::Denoiser denoiser : kBoth)
    {
        Runner runner(denoiser);
        const Result last = options::runFrames(runner, makeSetup(denoiser, kFloor, sun, makeWall()), kFrames);
        double widest = 0.0;
        for (const int fromWall : {1, 8, 20, 40})
        {
            const Figures f = measure(last, {kFloor.y / 2 - fromWall - kBand, kBand}, truth);
            std::printf("FIGURE %s, %d pixels from the foot of a wall: width %.2f, true %.2f; error %.4f, noisy %.4f\n",
                        nrd::toString(denoiser), fromWall, f.width, f.trueWidth, f.errors.denoised, f.errors.noisy);
            INFO(nrd::toString(denoiser) << ", " << fromWall);
            CHECK(f.width == Approx(f.trueWidth).epsilon(0.25).margin(0.3));
            CHECK(f.width > widest);
            CHECK(f.share() < 0.3);
            widest = f.width;
        }
    }
}

TEST_CASE("a lamp a metre over a table casts the penumbra of its size and place", "[gpu]")
{
    constexpr float kEdge = 0.045f; // the narrowest shadow's border lies in a pixel, not between two
    const Light lamp = makeLamp({0.3f, 1.0f, 0.0f}, 0.15f);
    Runner runner(nrd::Denoiser::SIGMA_SHADOW);
    for (const float height : {0.05f, 0.2f, 0.5f})
    {
        const Truth truth = [&](glm::vec3 P) { return visibleBesideEdge(lamp, height, kEdge, P); };
        for (const bool isKnown : {true, false})
        {
            options::Setup setup = makeSetup(nrd::Denoiser::SIGMA_SHADOW, {160, 96}, lamp, makeEdge(height, kEdge));
            if (!isKnown) hideLight(setup);
            const Figures f = measure(options::runFrames(runner, setup, kFrames), {46, 4}, truth);
            std::printf("FIGURE lamp over a table, edge at %g m, %s: width %.2f, true %.2f; error %.4f, noisy %.4f\n",
                        double(height), isKnown ? "known" : "unknown", f.width, f.trueWidth, f.errors.denoised,
                        f.errors.noisy);
            INFO(height << " m, " << isKnown);
            CHECK(f.width == Approx(f.trueWidth).epsilon(0.25).margin(0.3));
            CHECK(f.share() < 0.5);
        }
    }
}

TEST_CASE("shadows of spheres keep a fraction of the noise, seen from above and along the floor", "[gpu]")
{
    const Occluder spheres = join({makeSphere({-1.0f, 0.5f, 0.5f}, 0.5f), makeSphere({0.8f, 1.4f, 0.0f}, 0.3f),
                                   makeSphere({1.6f, 0.2f, -1.2f}, 0.2f)});
    for (const Light& light : {makeSun(40.0f, 20.0f, 0.05f), makeLamp({0.2f, 3.0f, 0.0f}, 0.25f)})
    {
        const Truth truth = [&](glm::vec3 P) { return meanOf(light, spheres, P, 0).x; };
        for (const bool isAlong : {false, true})
        {
            Runner runner(nrd::Denoiser::SIGMA_SHADOW);
            options::Setup setup = makeSetup(nrd::Denoiser::SIGMA_SHADOW, {128, 72}, light, spheres);
            if (isAlong) lookAlong(setup);
            const Errors errors = measureErrors(options::runFrames(runner, setup, kFrames), truth);
            std::printf("FIGURE spheres under %s, %s: error %.4f, noisy %.4f\n", light.isLocal ? "a lamp" : "the sun",
                        isAlong ? "along the floor" : "from above", errors.denoised, errors.noisy);
            CHECK(errors.denoised < 0.35 * errors.noisy);
        }
    }
}
