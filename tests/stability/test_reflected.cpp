// A panel that slides along under a ceiling and is seen only in a glossy floor: what is left of it where it was.
#include "catch.h"
#include "figures.h"
#include "levels.h"
#include "runners.h"
#include "scenes.h"

using namespace stability;

namespace
{
constexpr float kCeiling = 3.0f, kPanel = 2.5f; // heights, metres
constexpr float kHalfWidth = 1.0f, kSpeed = 0.15f;
constexpr float kDark = 0.25f, kLit = 1.0f; // of the ceiling, and the panel
constexpr int kFrames = 28, kFirstMeasured = 18, kFramesLater = 8;
// %: half of what was there. Without any reaction a history of 30 frames would still show 77 %.
constexpr double kMostLeft = 50.0;

const glm::vec3 kEye(0.0f, 1.6f, 0.0f);

float centreAt(int frame) { return kSpeed * (float(frame) - 0.5f * kFrames); }

struct Reflected
{
    float x;        // where the ray meets the panel's height
    float distance; // from the floor to what it meets
    bool isPanel;
};

Reflected reflect(glm::vec3 P, int frame)
{
    const glm::vec3 ray = glm::normalize(P - kEye), mirrored(ray.x, -ray.y, ray.z);
    const float toPanel = kPanel / mirrored.y, x = P.x + toPanel * mirrored.x;
    const bool isPanel = std::abs(x - centreAt(frame)) < kHalfWidth;
    return {x, isPanel ? toPanel : kCeiling / mirrored.y, isPanel};
}

options::Setup makePanel(nrd::Denoiser denoiser, bool isMotionGiven)
{
    options::Setup setup = makeSetup(denoiser);
    setup.fovY = 0.8f;
    setup.camera = [](int) { return lookFrom(kEye, {0.0f, -0.8f, 1.0f}); };
    showBoards(setup, {Board{{0, 0, 0}, {0, 0, 100}, {100, 0, 0}, 0.07f}});
    setup.meanAt = [](glm::vec3 P, glm::ivec2, int frame) { return reflect(P, frame).isPanel ? kLit : kDark; };
    setup.hitDistAt = [](glm::vec3 P, glm::ivec2, int frame) { return reflect(P, frame).distance; };
    if (isMotionGiven)
        setup.reflectionMotionAt = [](glm::vec3 P, glm::ivec2, int frame)
        { return glm::vec3(reflect(P, frame).isPanel ? -kSpeed : 0.0f, 0.0f, 0.0f); };
    return setup;
}

bool isSpecular(nrd::ResourceType output)
{
    return output == nrd::ResourceType::OUT_SPEC_RADIANCE_HITDIST || output == nrd::ResourceType::OUT_SPEC_HITDIST ||
           output == nrd::ResourceType::OUT_SPEC_SH0;
}

// Light where the panel was until `kFramesLater` frames ago, beyond the ceiling's, as a share of the panel's.
double ghostOf(nrd::Denoiser denoiser, bool isMotionGiven)
{
    Statistician left;
    run(makePanel(denoiser, isMotionGiven), kFrames,
        [&](int frame, const options::Result& result)
        {
            if (frame < kFirstMeasured) return;
            const float edge = centreAt(frame - kFramesLater) - kHalfWidth;
            left.add(levelsOf(result, denoiser),
                     [&](const Level& l)
                     {
                         const float x = reflect(l.position, frame).x;
                         return isSpecular(l.output) && x >= edge && x < edge + kSpeed;
                     });
        });
    const Statistics s = left.statistics();
    CHECK(s.count > 200);
    return 100.0 * std::abs(s.denoised - s.truth) / (kLit - kDark);
}
} // namespace

TEST_CASE("an object that moves in a reflection leaves no ghost", "[gpu]")
{
    for (const bool isMotionGiven : {false, true})
    {
        Figure figure(std::string("object moving in a reflection, ") + (isMotionGiven ? "with" : "without") +
                          " IN_SPEC_MV: ghost after 8 frames",
                      "% of its light", kMostLeft);
        for (const nrd::Denoiser denoiser : someThat(hasSpecular))
            figure.add(denoiser, ghostOf(denoiser, isMotionGiven));
    }
}
