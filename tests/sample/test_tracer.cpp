// The tracer against what is known in closed form. Expectations are by many samples, so the tolerances are a few
// standard errors, far below what a wrong factor (2, pi, a cosine) would change.
#include "catch.h"
#include "scene_cornell.h"
#include "tracer_fixture.h"

#include <cmath>

using namespace sample;
using test::Traced;
using test::TraceRequest;

namespace
{
constexpr float kPi = 3.14159265f;

TraceRequest request(uint32_t size, uint32_t samples, const glm::vec3& eye, const glm::vec3& target, float fov)
{
    TraceRequest r;
    r.desc.width = size;
    r.desc.height = size;
    r.desc.roughening = 0.0f;
    r.samples = samples;
    r.view.camera = lookAt(eye, target, fov, 1.0f, 0.01f);
    return r;
}

// Directional albedo of the specular lobe of a dielectric, by the same table the tracer uses.
float specularAlbedo(float cosine, float roughness)
{
    static const std::vector<glm::vec4> table = packEnergyTable();
    const auto at = [&](int x, int y) { return glm::vec2(table[size_t(std::min(y, 31) * 32 + std::min(x, 31))]); };
    const float x = cosine * 31.0f, y = roughness * 31.0f;
    const int i = int(x), j = int(y);
    const glm::vec2 e = glm::mix(glm::mix(at(i, j), at(i + 1, j), x - float(i)),
                                 glm::mix(at(i, j + 1), at(i + 1, j + 1), x - float(i)), y - float(j));
    return (e.x + 0.04f * e.y) * (1.0f + 0.04f * (1.0f / (e.x + e.y) - 1.0f));
}
} // namespace

TEST_CASE("a white object in a white furnace cannot be seen", "[gpu]")
{
    // Far apart, so that light lost between them after the last bounce doesn't count.
    std::vector<Material> materials;
    std::vector<Primitive> spheres;
    const float roughnesses[] = {0.1f, 0.3f, 0.5f, 0.75f, 1.0f};
    for (int metal = 0; metal < 2; ++metal)
        for (int i = 0; i < 5; ++i)
        {
            materials.push_back(test::makeMaterial(glm::vec3(1.0f), float(metal), roughnesses[i]));
            spheres.push_back(test::makeSphere(glm::vec3(8.0f * float(i) - 16.0f, 8.0f * float(metal) - 4.0f, 0.0f),
                                               1.8f, int(materials.size()) - 1));
        }
    const Scene scene = test::makeScene(spheres, materials);
    const Environment furnace = makeUniformEnvironment(glm::vec3(1.0f));
    TraceRequest r = request(96, 96, glm::vec3(0, 0, 120), glm::vec3(0), 0.32f);
    const Traced traced = test::trace(scene, &furnace, r);
    for (size_t m = 0; m < materials.size(); ++m)
    {
        const auto isOfMaterial = [&](size_t i) { return traced.viewZ[i] > -500.0f && traced.motion[i].w == float(m); };
        const glm::vec3 mean =
            test::meanOf(traced.viewZ.size(), isOfMaterial, [&](size_t i) { return traced.composed(i); });
        INFO("metallic " << materials[m].metallic << ", roughness " << materials[m].roughness);
        CHECK(mean.g == Approx(1.0).epsilon(0.02));
    }
}

TEST_CASE("a plane under an even sky reflects its albedo", "[gpu]")
{
    const Scene scene = test::makeScene({test::makeFloor(50.0f, 0)}, {test::makeMaterial(glm::vec3(0.5f), 0.0f, 0.6f)});
    const Environment sky = makeUniformEnvironment(glm::vec3(3.0f));
    const Traced traced = test::trace(scene, &sky, request(8, 256, glm::vec3(0, 3, 4), glm::vec3(0), 0.02f));
    const float specular = specularAlbedo(0.6f, 0.6f);
    const glm::vec3 mean = test::meanOf(
        64, [](size_t) { return true; }, [&](size_t i) { return traced.composed(i); });
    CHECK(mean.g == Approx(3.0 * (specular + (1.0f - specular) * 0.5f)).epsilon(0.01));
    // Every ray leaves the scene.
    for (size_t i = 0; i < 64; ++i) CHECK(traced.diffuse[i].w == 65504.0f);
    CHECK(traced.diffuseMean[0].w == Approx(1.0));
}

TEST_CASE("a lamp over a plane lights it by its form factor", "[gpu]")
{
    const float half = GENERATE(0.05f, 1.0f); // small: a point; large: a form factor
    const float height = 2.0f, radiance = 40.0f;
    Primitive lamp = test::makeFloor(half, 1);
    for (glm::vec3& p : lamp.positions) p.y = height;
    std::swap(lamp.indices[1], lamp.indices[2]); // faces down
    std::swap(lamp.indices[4], lamp.indices[5]);
    lamp.normals.assign(4, glm::vec3(0, -1, 0));
    Material shine = test::makeMaterial(glm::vec3(0.0f), 0.0f, 1.0f);
    shine.emission = glm::vec3(radiance);
    const Scene scene =
        test::makeScene({test::makeFloor(20.0f, 0), lamp}, {test::makeMaterial(glm::vec3(0.8f), 0.0f, 1.0f), shine});
    // From the side, under the lamp's edge, at the point right below its middle.
    TraceRequest r = request(4, 1024, glm::vec3(3, 1, 0), glm::vec3(0), 0.002f);
    r.desc.maxBounces = 1;
    const Traced traced = test::trace(scene, nullptr, r);
    const float side = std::sqrt(half * half + height * height);
    const float irradiance = radiance * 4.0f * half / side * std::atan(half / side); // four corners, both terms equal
    const float specular = specularAlbedo(1.0f / std::sqrt(10.0f), 1.0f);
    const glm::vec3 diffuse = test::meanOf(
        16, [](size_t) { return true; },
        [&](size_t i) { return glm::vec3(traced.diffuseMean[i] * traced.diffuseFactor[i]); });
    INFO("half side " << half);
    CHECK(diffuse.g == Approx((1.0f - specular) * 0.8f / kPi * irradiance).epsilon(0.01));
    CHECK(traced.direct[0].g == 0.0f);
}

TEST_CASE("punctual lights follow intensity, distance, cone and range", "[gpu]")
{
    Scene scene = test::makeScene({test::makeFloor(20.0f, 0)}, {test::makeMaterial(glm::vec3(0.8f), 0.0f, 1.0f)});
    scene.nodes.emplace_back();
    scene.nodes[1].light = 0;
    scene.nodes[1].translation = glm::vec3(0, 2, 0);
    scene.nodes[1].rotation = glm::angleAxis(-0.5f * kPi, glm::vec3(1, 0, 0)); // -Z down
    PunctualLight light;
    light.intensity = glm::vec3(10.0f, 20.0f, 40.0f);
    light.type = GENERATE(LightType::Point, LightType::Spot, LightType::Directional);
    light.outerCosine = std::cos(0.4f);
    light.innerCosine = std::cos(0.3f);
    scene.lights.push_back(light);
    for (const float x : {0.0f, 1.0f}) // 1: 27 degrees off the axis, outside the cone
    {
        TraceRequest r = request(2, 64, glm::vec3(x + 3.0f, 1, 0), glm::vec3(x, 0, 0), 0.001f);
        r.desc.maxBounces = 1;
        const Traced traced = test::trace(scene, nullptr, r);
        const float specular = specularAlbedo(1.0f / std::sqrt(10.0f), 1.0f);
        const float distance2 = 4.0f + x * x, cosine = 2.0f / std::sqrt(distance2);
        float irradiance = light.type == LightType::Directional ? 20.0f : 20.0f * cosine / distance2;
        if (light.type == LightType::Spot && x > 0.5f) irradiance = 0.0f;
        INFO("light type " << int(light.type) << ", x " << x);
        const float measured = traced.diffuseMean[0].g * traced.diffuseFactor[0].g;
        CHECK(measured == Approx((1.0f - specular) * 0.8f / kPi * irradiance).epsilon(0.005).margin(1e-5));
    }
}

TEST_CASE("split and demodulated paths add up to plain ones", "[gpu]")
{
    const Scene scene = makeCornellBox();
    TraceRequest r;
    r.desc.width = 48;
    r.desc.height = 27;
    r.desc.roughening = 0.0f;
    r.samples = r.plain = 512;
    ScenePose pose(scene);
    r.view.camera = findCamera(scene, pose, 16.0f / 9.0f).value();
    const Traced traced = test::trace(scene, nullptr, r);
    const size_t count = traced.viewZ.size();
    // In strips, so that an error in one place isn't lost in the mean.
    for (size_t strip = 0; strip < 6; ++strip)
    {
        const auto isInside = [&](size_t i) { return i % 48 / 8 == strip; };
        const glm::vec3 split = test::meanOf(count, isInside, [&](size_t i) { return traced.composed(i); });
        const glm::vec3 plain =
            test::meanOf(count, isInside, [&](size_t i) { return glm::vec3(traced.plainMean[i] + traced.direct[i]); });
        INFO("strip " << strip);
        CHECK(split.r == Approx(plain.r).epsilon(0.015));
        CHECK(split.g == Approx(plain.g).epsilon(0.015));
        CHECK(split.b == Approx(plain.b).epsilon(0.02));
    }
}
