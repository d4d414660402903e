// IN_SPEC_MV: a panel slides along under a ceiling, seen only in a glossy floor. Its stripes are the known mean.
#include "catch.h"
#include "harness.h"
#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>
#include <nrd/nrd.h>
#include <optional>
#include <random>
#include <string>

using namespace quality;

namespace
{
constexpr int kWidth = 96, kHeight = 56;
constexpr size_t kCount = kWidth * kHeight;
constexpr int kFrames = 40, kFirstMeasured = 32;
constexpr float kRoughness = 0.07f;
constexpr float kCeiling = 3.0f, kPanel = 2.5f, kPanelHalfWidth = 2.0f;

struct Run
{
    nrd::Denoiser denoiser;
    float panelSpeed;  // world units a frame along x
    float cameraSpeed; // along z
};

bool isRelax(nrd::Denoiser denoiser) { return denoiser >= nrd::Denoiser::RELAX_DIFFUSE; }

Camera cameraOf(const Run& run, int frame)
{
    Camera camera;
    camera.position = {0.0f, 1.6f, run.cameraSpeed * static_cast<float>(frame)};
    camera.worldToView = glm::lookAtLH(camera.position, camera.position + glm::vec3(0.0f, -0.8f, 1.0f), {0, 1, 0});
    camera.viewToClip = glm::perspectiveLH_ZO(0.8f, float(kWidth) / float(kHeight), 0.05f, 500.0f);
    return camera;
}

// What a ray upwards sees, and the world motion of it.
struct Reflected
{
    float radiance;
    float distance;
    glm::vec3 motion;
};

// `centre`: of the panel.
Reflected reflect(glm::vec3 origin, glm::vec3 direction, float centre, float speed)
{
    const float toPanel = (kPanel - origin.y) / direction.y, toCeiling = (kCeiling - origin.y) / direction.y;
    const glm::vec3 onPanel = origin + direction * toPanel, onCeiling = origin + direction * toCeiling;
    if (std::abs(onPanel.x - centre) < kPanelHalfWidth)
        return {1.0f + 0.9f * std::sin(8.0f * (onPanel.x - centre)), toPanel, {-speed, 0.0f, 0.0f}};
    return {0.6f + 0.4f * std::sin(3.0f * onCeiling.x), toCeiling, {0.0f, 0.0f, 0.0f}};
}

struct Scene
{
    Frame frame;
    std::vector<float> mean;
};

// Radiance is 0 or twice what is seen, with equal chance; the lobe scatters the directions.
Scene render(const Run& run, int index)
{
    Scene scene;
    scene.frame.guides = {cameraOf(run, index), std::vector<float>(kCount), std::vector<glm::vec3>(kCount, {0, 1, 0}),
                          std::vector<float>(kCount, kRoughness)};
    scene.frame.diffuse.assign(kCount, glm::vec4(0.0f));
    const Camera& camera = scene.frame.guides.camera;
    const glm::mat4 clipToWorld = glm::inverse(camera.viewToClip * camera.worldToView);
    const float centre = run.panelSpeed * (static_cast<float>(index) - 0.5f * kFrames);
    std::mt19937 rng(static_cast<unsigned>(index));
    std::normal_distribution<float> lobe(0.0f, kRoughness * kRoughness);
    for (size_t i = 0; i < kCount; i++)
    {
        const glm::vec2 uv = (glm::vec2(i % kWidth, i / kWidth) + 0.5f) / glm::vec2(kWidth, kHeight);
        const glm::vec4 far = clipToWorld * glm::vec4(2.0f * uv.x - 1.0f, 1.0f - 2.0f * uv.y, 1.0f, 1.0f);
        const glm::vec3 ray = glm::normalize(glm::vec3(far) / far.w - camera.position);
        const glm::vec3 X = camera.position - ray * (camera.position.y / ray.y);
        const glm::vec3 mirrored(ray.x, -ray.y, ray.z);
        const float viewZ = (camera.worldToView * glm::vec4(X, 1.0f)).z;
        scene.frame.guides.viewZ[i] = viewZ;
        scene.mean.push_back(reflect(X, mirrored, centre, run.panelSpeed).radiance);
        const Reflected seen =
            reflect(X, glm::normalize(mirrored + glm::vec3(lobe(rng), lobe(rng), lobe(rng))), centre, run.panelSpeed);
        const float radiance = rng() & 1u ? 2.0f * seen.radiance : 0.0f;
        const bool isWorld = isRelax(run.denoiser);
        scene.frame.specular.push_back(
            isWorld ? glm::vec4(glm::vec3(radiance), seen.distance)
                    : glm::vec4(radiance, 0.0f, 0.0f, normalizeHitDist(seen.distance, viewZ, kRoughness)));
        scene.frame.specularMotion.emplace_back(seen.motion, 1.0f);
    }
    return scene;
}

// With a pre-pass, so that what motion does wrong is not lost in noise.
Settings calmSettings(nrd::Denoiser denoiser)
{
    Settings settings = nrd::ReblurSettings();
    if (denoiser == nrd::Denoiser::RELAX_SPECULAR) settings = nrd::RelaxSettings();
    std::visit([](auto& chosen) { chosen.prePassMode = nrd::PrePassMode::SIMPLE; }, settings);
    return settings;
}

// Mean absolute error of the last frames, relative to the mean.
double errorOf(const Run& run, bool isGiven)
{
    Harness harness(kWidth, kHeight, calmSettings(run.denoiser), run.denoiser);
    double error = 0.0, mean = 0.0;
    for (int frame = 0; frame < kFrames; frame++)
    {
        Scene scene = render(run, frame);
        if (!isGiven) scene.frame.specularMotion.clear();
        harness.denoise(scene.frame);
        for (size_t i = 0; i < kCount && frame >= kFirstMeasured; i++)
        {
            error += std::abs(harness.specular()[i].x - scene.mean[i]);
            mean += scene.mean[i];
        }
    }
    return error / mean;
}

// Texels that differ between a run with IN_SPEC_MV and one without; `motion`: what it holds, nothing: the truth.
size_t differenceOf(const Run& run, std::optional<glm::vec4> motion)
{
    Harness with(kWidth, kHeight, run.denoiser), without(kWidth, kHeight, run.denoiser);
    size_t different = 0;
    for (int frame = 0; frame < 10; frame++)
    {
        Scene scene = render(run, frame);
        if (motion) scene.frame.specularMotion.assign(kCount, *motion);
        with.denoise(scene.frame);
        scene.frame.specularMotion.clear();
        without.denoise(scene.frame);
        for (size_t i = 0; i < kCount; i++) different += with.specular()[i] != without.specular()[i];
    }
    return different;
}

constexpr nrd::Denoiser kDenoisers[] = {nrd::Denoiser::REBLUR_SPECULAR, nrd::Denoiser::RELAX_SPECULAR};
} // namespace

TEST_CASE("what moves in a reflection keeps its stripes when its motion is given", "[gpu]")
{
    for (const nrd::Denoiser denoiser : kDenoisers)
    {
        for (const float cameraSpeed : {0.0f, 0.03f})
        {
            const Run run = {denoiser, 0.06f, cameraSpeed};
            const double without = errorOf(run, false), with = errorOf(run, true);
            std::printf("FIGURE %s, object moving in a reflection, camera %s: relative error %.3f, with IN_SPEC_MV "
                        "%.3f\n",
                        nrd::toString(denoiser), cameraSpeed > 0.0f ? "moving" : "at rest", without, with);
            INFO(nrd::toString(denoiser) << ", camera speed " << cameraSpeed);
            CHECK(with < 0.65 * without); // what is left is mostly noise
        }
    }
}

TEST_CASE("no motion in reflections changes no bit, and neither does motion of pixels without a sample", "[gpu]")
{
    for (const nrd::Denoiser denoiser : kDenoisers)
    {
        INFO(nrd::toString(denoiser));
        CHECK(differenceOf({denoiser, 0.06f, 0.03f}, glm::vec4(0, 0, 0, 1)) == 0);
        CHECK(differenceOf({denoiser, 0.06f, 0.03f}, glm::vec4(1, 2, 3, 0)) == 0);
        CHECK(differenceOf({denoiser, 0.06f, 0.03f}, glm::vec4(NAN, NAN, NAN, 1)) == 0);
        CHECK(differenceOf({denoiser, 0.0f, 0.0f}, {}) == 0); // a static scene
        CHECK(differenceOf({denoiser, 0.06f, 0.0f}, {}) > 0);
    }
}
