// What primary surface replacement is for: a mirror looks, denoised, like the scene that it shows.
#include "catch.h"
#include "render_fixture.h"
#include "scene_mirror.h"

#include <cstdio>

using namespace sample;

namespace
{
constexpr uint32_t kFrames = 32; // the camera, a ball and a block move in all of them
constexpr uint32_t kSamples = 128;
constexpr int kMirror = 6; // material

// As bright behind the mirror as before it.
Environment evenSky() { return makeUniformEnvironment(glm::vec3(0.9f, 1.0f, 1.1f)); }

test::Run render(const char* denoiser, bool hasPsr, Scene (*make)())
{
    return test::Run(make(), evenSky(), test::renderOptions(denoiser, hasPsr));
}
} // namespace

TEST_CASE("a denoised mirror looks like the mirrored scene seen directly", "[quality]")
{
    constexpr const char* kDenoiser = "REBLUR_DIFFUSE_SPECULAR";
    test::Run noisy = render("NONE", false, makeMirrorYard), twin = render(kDenoiser, false, makeMirrorTwin);
    test::Run with = render(kDenoiser, true, makeMirrorYard), without = render(kDenoiser, false, makeMirrorYard);
    for (test::Run* run : {&twin, &with, &without}) run->renderFrames(kFrames);
    noisy.renderAt((kFrames - 1) / 60.0); // has no history
    const Mask mirror = noisy.maskOf(kMirror);
    const Picture seen = twin.reference(kSamples);
    const auto error = [&](test::Run& run) { return test::flipOf(run.shown(), seen, mirror); };
    const double followed = error(with), unfollowed = error(without), direct = error(twin);
    std::printf("FLIP against the mirrored scene seen directly: with PSR %.4f, without %.4f, noisy %.4f; that scene "
                "itself, denoised: %.4f\n",
                followed, unfollowed, error(noisy), direct);
    CHECK(followed < 0.05);
    CHECK(unfollowed > 1.5 * followed);
    CHECK(followed < 1.1 * direct); // as good as without a mirror
}
