// One scene said in two ways: projections, handedness, depths, units, motion, places. What differs only by factors that
// floats hold exactly must come out bit for bit the same.
#include "catch.h"
#include "measures.h"
#include "options.h"
#include <cmath>
#include <cstdio>
#include <string>

using namespace options;

namespace
{
constexpr glm::ivec2 kSize{64, 32};
constexpr int kFrames = 4;

struct Pair
{
    const char* name;
    void (*applyFirst)(Setup& setup);
    void (*applySecond)(Setup& setup);
    bool isOfDiffuse = false; // reflections are right to differ
};

bool hasSpecular(nrd::Denoiser denoiser)
{
    return std::string(nrd::toString(denoiser)).find("SPECULAR") != std::string::npos;
}

void leave(Setup&) {}
void take2D(Setup& s) { s.motion = MotionKind::Screen; }
void take25D(Setup& s) { s.motion = MotionKind::Screen25; }
void takeStatic(Setup& s) { s.speed = 0.0f; }

const Pair kExact[] = {
    {"rectangle with and without origin",
     [](Setup& s) {
         s.rect = {48, 24};
     },
     [](Setup& s)
     {
         s.rect = {48, 24};
         s.origin = {13, 5};
     }},
    {"left- and right-handed", leave, [](Setup& s) { s.isRightHanded = true; }},
    {"depths of the other sign", leave, [](Setup& s) { s.viewZFactor = -1.0f; }},
    {"scaled depths", leave, [](Setup& s) { s.viewZFactor = 0.125f; }},
    {"reversed depth", leave, [](Setup& s) { s.projection = Projection::Reversed; }},
    {"infinite depth", leave, [](Setup& s) { s.projection = Projection::Infinite; }},
    {"reversed infinite depth", leave, [](Setup& s) { s.projection = Projection::ReversedInfinite; }},
    {"orthographic, either hand", [](Setup& s) { s.projection = Projection::Orthographic; },
     [](Setup& s)
     {
         s.projection = Projection::Orthographic;
         s.isRightHanded = true;
     }},
    {"2.5D motion, either hand", take25D,
     [](Setup& s)
     {
         take25D(s);
         s.isRightHanded = true;
     }},
    {"2.5D motion of scaled depths", take25D,
     [](Setup& s)
     {
         take25D(s);
         s.isRightHanded = true;
         s.viewZFactor = 0.5f;
     }},
    {"2.5D motion of depths whose sign is not the view space's", take25D,
     [](Setup& s)
     {
         take25D(s);
         s.viewZFactor = -1.0f;
     }},
    {"half the resolution, and half the size", leave,
     [](Setup& s)
     {
         s.size = s.rect = 2 * kSize;
         s.resolutionDivisor = 2;
     }},
};

// These round.
const Pair kClose[] = {
    {"metres and centimetres", leave, [](Setup& s) { s.unitsPerMeter = 100.0f; }},
    {"3D and 2D motion, static", takeStatic,
     [](Setup& s)
     {
         takeStatic(s);
         take2D(s);
     }},
    {"3D and 2.5D motion, static", takeStatic,
     [](Setup& s)
     {
         takeStatic(s);
         take25D(s);
     }},
    {"3D and 2D motion", leave, take2D},
    {"3D and 2.5D motion", leave, take25D},
    {"a world that travels with the camera", leave,
     [](Setup& s)
     {
         s.motionFactor = 128.0f;
         s.sceneVelocity = {0.25f, 0.0f, 0.125f};
     },
     true},
    {"half-float depths", leave,
     [](Setup& s)
     {
         s.viewZFactor = -0.125f;
         s.hasHalfViewZ = true;
     }},
};

// Runs of one denoiser; the first of a pair often is that of another pair.
struct Runs
{
    const Result& operator()(void (*apply)(Setup& setup))
    {
        const auto found = results.find(apply);
        if (found != results.end()) return found->second;
        Setup setup = makeSetup(denoiser, kSize);
        setup.hasLargeFormats = true;
        apply(setup);
        return results[apply] = runFrames(runner, setup, kFrames);
    }

    nrd::Denoiser denoiser;
    Runner runner{denoiser};
    std::map<void (*)(Setup& setup), Result> results = {};
};

// Root mean square over all outputs' channels but history lengths, which are no signal.
double rmsDifference(const Result& a, const Result& b, bool hasLength)
{
    double sum = 0.0, count = 0.0;
    for (const auto& [slot, plane] : a.outputs)
    {
        const Plane& other = b.outputs.at(slot);
        const glm::vec4 mask(1.0f, 1.0f, 1.0f, hasLength ? 0.0f : 1.0f);
        forEachPixel(a.frame,
                     [&, &plane = plane](size_t, size_t texel)
                     {
                         const glm::vec4 d = (plane[texel] - other[texel]) * mask;
                         sum += static_cast<double>(glm::dot(d, d));
                         count += 1.0;
                     });
    }
    return std::sqrt(sum / count);
}
} // namespace

TEST_CASE("one scene said in two ways gives the same bits, or nearly", "[gpu]")
{
    std::vector<double> worst(std::size(kClose), 0.0);
    for (const nrd::Denoiser denoiser : testedDenoisers())
    {
        if (!isRepresentative(denoiser)) continue;
        Runs run{denoiser};
        for (const Pair& pair : kExact)
        {
            INFO(nrd::toString(denoiser) << ", " << pair.name);
            const Result &first = run(pair.applyFirst), &second = run(pair.applySecond);
            INFO("worst difference " << worstDifference(first, second));
            CHECK(countDifferent(first, second) == 0);
        }
        for (size_t i = 0; i < std::size(kClose); i++)
        {
            if (denoiser == nrd::Denoiser::REFERENCE) break; // reads none of it
            if (kClose[i].isOfDiffuse && hasSpecular(denoiser)) continue;
            INFO(nrd::toString(denoiser) << ", " << kClose[i].name);
            const double difference =
                rmsDifference(run(kClose[i].applyFirst), run(kClose[i].applySecond), isRelax(denoiser));
            worst[i] = std::max(worst[i], difference);
            CHECK(difference < 0.02); // signals have a mean of 1, their noise a deviation of 1
        }
    }
    for (size_t i = 0; i < std::size(kClose); i++)
        std::printf("FIGURE %s: difference %.5f at most\n", kClose[i].name, worst[i]);
}
