// What a frame hands to a denoiser: guides, motion, hit distances, and noise that averages to the reference.
#include "catch.h"
#include "engine/commands.h"
#include "engine/transfer.h"
#include "scene_cornell.h"
#include "tracer_fixture.h"

#include <cmath>

using namespace sample;
using test::Traced;
using test::TraceRequest;

namespace
{
TraceRequest cornellRequest(const Scene& scene)
{
    TraceRequest r;
    r.desc.width = 48;
    r.desc.height = 27;
    r.samples = 0;
    ScenePose pose(scene);
    pose.update(0.5);
    r.view.camera = findCamera(scene, pose, 16.0f / 9.0f).value();
    r.time = 0.5;
    r.previousTime = 0.25;
    return r;
}

glm::vec3 worldPosition(const Traced& traced, const Camera& camera, size_t pixel)
{
    const float u = (float(pixel % traced.width) + 0.5f) / float(traced.width);
    const float v = (float(pixel / traced.width) + 0.5f) / float(traced.height);
    const glm::vec3 ray((2.0f * u - 1.0f) * camera.tanHalfFovX, (1.0f - 2.0f * v) * camera.tanHalfFovY, -1.0f);
    return glm::vec3(glm::inverse(camera.worldToView) * glm::vec4(ray * -traced.viewZ[pixel], 1.0f));
}
} // namespace

TEST_CASE("guides describe the surface that is seen", "[gpu]")
{
    const Scene scene = makeCornellBox();
    const TraceRequest r = cornellRequest(scene);
    const Traced traced = test::trace(scene, nullptr, r);
    size_t floorPixels = 0;
    for (size_t i = 0; i < traced.viewZ.size(); ++i)
    {
        REQUIRE(traced.viewZ[i] < 0.0f); // looks along -Z
        const glm::vec3 position = worldPosition(traced, r.view.camera, i);
        const glm::vec3 normal(traced.normalRoughness[i]);
        CHECK(glm::length(normal) == Approx(1.0).margin(1e-3));
        const auto material = int(traced.motion[i].w);
        REQUIRE(material < int(scene.materials.size()));
        CHECK(traced.normalRoughness[i].w == Approx(scene.materials[size_t(material)].roughness).margin(1e-3));
        if (material != 3) continue; // the floor
        ++floorPixels;
        CHECK(std::abs(position.y) < 2e-4f);
        CHECK(normal.y == Approx(1.0).margin(1e-3));
        CHECK(i / traced.width > traced.height / 2); // row 0 is the top row
    }
    CHECK(floorPixels > 100);
}

TEST_CASE("motion is where the point was minus where it is, and zero for what stands still", "[gpu]")
{
    const Scene scene = makeCornellBox();
    const TraceRequest r = cornellRequest(scene);
    const Traced traced = test::trace(scene, nullptr, r);
    ScenePose now(scene), before(scene);
    now.update(r.time);
    before.update(r.previousTime);
    const glm::mat4 moved = before.nodeToWorld()[2] * glm::inverse(now.nodeToWorld()[2]); // the plastic block
    size_t movingPixels = 0;
    for (size_t i = 0; i < traced.viewZ.size(); ++i)
    {
        const glm::vec3 motion(traced.motion[i]);
        if (int(traced.motion[i].w) != 5)
        {
            CHECK(motion == glm::vec3(0.0f));
            continue;
        }
        ++movingPixels;
        const glm::vec3 position = worldPosition(traced, r.view.camera, i);
        CHECK(glm::distance(motion, glm::vec3(moved * glm::vec4(position, 1.0f)) - position) < 2e-3f);
        CHECK(glm::length(motion) > 1e-3f);
    }
    CHECK(movingPixels > 20);
}

TEST_CASE("what a specular path hits moves as it does where it is seen directly", "[gpu]")
{
    const Scene scene = makeCornellBox();
    const TraceRequest r = cornellRequest(scene);
    const Traced traced = test::trace(scene, nullptr, r);
    ScenePose now(scene), before(scene);
    now.update(r.time);
    before.update(r.previousTime);
    const glm::mat4 moved = before.nodeToWorld()[2] * glm::inverse(now.nodeToWorld()[2]); // the plastic block
    size_t sampleCount = 0, movingCount = 0;
    for (size_t i = 0; i < traced.viewZ.size(); ++i)
    {
        const glm::vec4 motion = traced.specularMotion[i];
        const float distance = traced.specular[i].w;
        CHECK(motion.w == (distance > 0.0f ? 1.0f : 0.0f));
        sampleCount += distance > 0.0f;
        if (glm::vec3(motion) == glm::vec3(0.0f)) continue;
        REQUIRE(distance > 0.0f);
        const glm::vec3 hit =
            worldPosition(traced, r.view.camera, i) + distance * glm::vec3(traced.specularDirection[i]);
        movingCount += glm::distance(glm::vec3(motion), glm::vec3(moved * glm::vec4(hit, 1.0f)) - hit) < 2e-3f;
    }
    CHECK(movingCount > 20);
    CHECK(movingCount < sampleCount / 2);
}

TEST_CASE("hit distances are those of the first bounce, and metals have no diffuse sample", "[gpu]")
{
    // A floor of metal beside one of plaster, under a ceiling one unit above: rays up travel at least one unit.
    Primitive metal = test::makeFloor(5.0f, 0), plaster = test::makeFloor(5.0f, 1), ceiling = test::makeFloor(50.0f, 1);
    for (glm::vec3& p : metal.positions) p.x += 5.0f;
    for (glm::vec3& p : plaster.positions) p.x -= 5.0f;
    for (glm::vec3& p : ceiling.positions) p.y = 1.0f;
    const Scene scene = test::makeScene({metal, plaster, ceiling}, {test::makeMaterial(glm::vec3(0.9f), 1.0f, 0.1f),
                                                                    test::makeMaterial(glm::vec3(0.5f), 0.0f, 0.9f)});
    const Environment sky = makeUniformEnvironment(glm::vec3(1.0f));
    TraceRequest r;
    r.desc.width = r.desc.height = 32;
    r.samples = 0;
    r.view.camera = lookAt(glm::vec3(0, 0.9f, 0.5f), glm::vec3(0, 0, 0), 1.2f, 1.0f, 0.01f);
    const Traced traced = test::trace(scene, &sky, r);
    for (size_t i = 0; i < traced.viewZ.size(); ++i)
    {
        const bool isMetal = traced.motion[i].w == 0.0f;
        if (isMetal)
        {
            CHECK(traced.diffuse[i] == glm::vec4(0.0f));
            CHECK(traced.specular[i].w > 0.0f);
        }
        else
            CHECK(traced.diffuse[i].w >= 0.999f);
    }
}

TEST_CASE("the sky is beyond the denoising range and wholly direct", "[gpu]")
{
    const Scene scene =
        test::makeScene({test::makeSphere(glm::vec3(0), 1.0f, 0)}, {test::makeMaterial(glm::vec3(1), 0, 1)});
    const Environment sky = makeUniformEnvironment(glm::vec3(1.0f, 2.0f, 3.0f));
    TraceRequest r;
    r.desc.width = r.desc.height = 16;
    r.samples = 0;
    r.view.camera = lookAt(glm::vec3(0, 0, 10), glm::vec3(0, 0, 0), 0.8f, 1.0f, 0.01f);
    const Traced traced = test::trace(scene, &sky, r);
    CHECK(traced.viewZ[0] == Approx(-2000.0));
    CHECK(glm::vec3(traced.direct[0]) == glm::vec3(1, 2, 3));
    CHECK(traced.diffuse[0] == glm::vec4(0.0f));
    CHECK(traced.viewZ[traced.center()] == Approx(-9.0).margin(0.1));
}

TEST_CASE("frames are noise around the reference, different in every frame", "[gpu]")
{
    const Scene scene = makeCornellBox();
    ScenePose pose(scene);
    TracerDesc desc;
    desc.width = 48;
    desc.height = 27;
    View view;
    view.camera = findCamera(scene, pose, 16.0f / 9.0f).value();
    PathTracer tracer(test::device(), scene, nullptr, desc);
    tracer.setPose(scene, pose, nullptr);
    constexpr uint32_t kFrames = 64, kSamples = 512;
    glm::dvec3 frameMean(0.0), referenceMean(0.0);
    test::Pixels last;
    for (view.frameIndex = 0; view.frameIndex < kFrames; ++view.frameIndex)
    {
        engine::submitAndWait(test::device(), [&](VkCommandBuffer cmd) { tracer.recordFrame(cmd, view); });
        const auto pixels = engine::readBackAs<glm::vec4>(test::device(), tracer.images().diffuse);
        for (const glm::vec4& p : pixels) frameMean += glm::dvec3(p) / double(kFrames * pixels.size());
        CHECK(pixels != last);
        last = pixels;
    }
    for (uint32_t first = 0; first < kSamples; first += 64)
        engine::submitAndWait(test::device(),
                              [&](VkCommandBuffer cmd) {
                                  tracer.recordReference(cmd, view, {first, 64});
                              });
    const auto sums = engine::readBackAs<glm::vec4>(test::device(), tracer.sumDiffuse());
    for (const glm::vec4& p : sums) referenceMean += glm::dvec3(p) / double(kSamples * sums.size());
    for (int c = 0; c < 3; ++c) CHECK(frameMean[c] == Approx(referenceMean[c]).epsilon(0.02));
}
