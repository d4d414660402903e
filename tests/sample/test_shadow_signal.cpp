// The light that is traced apart: its shadow against closed forms, and the whole against paths that know no such thing.
#include "catch.h"
#include "scene_panes.h"
#include "tracer_fixture.h"

#include <cmath>

using namespace sample;
using test::Traced;
using test::TraceRequest;

namespace
{
constexpr float kPi = 3.14159265f;
constexpr float kLit = 65504.0f;
enum
{
    Floor,
    Opaque,
    Glass,
    Tinted
};

Material makeGlass(const glm::vec3& color, float alpha)
{
    Material glass = test::makeMaterial(color, 0.0f, 0.5f);
    glass.baseColor.a = alpha;
    glass.alphaCutoff = 0.5f;
    glass.isBlended = true;
    return glass;
}

// A half plane x > 0, as far as anything sees, facing up.
Primitive makeHalf(float height, int material)
{
    return makeQuad(material, glm::vec3(0, height, 50), glm::vec3(50, 0, 0), glm::vec3(0, 0, -100));
}

// A floor under a light right above the origin.
Scene underLight(std::vector<Primitive> others, LightType type, float height)
{
    std::vector<Primitive> all = {test::makeFloor(50.0f, Floor)};
    all.insert(all.end(), others.begin(), others.end());
    Scene scene = test::makeScene(all, {test::makeMaterial(glm::vec3(0.8f), 0.0f, 1.0f),
                                        test::makeMaterial(glm::vec3(0.5f), 0.0f, 1.0f), makeGlass(glm::vec3(1), 0.4f),
                                        makeGlass(glm::vec3(0.5f, 1.0f, 0.25f), 0.25f)});
    scene.nodes.emplace_back();
    scene.nodes[1].light = 0;
    scene.nodes[1].translation = glm::vec3(0, height, 0);
    scene.nodes[1].rotation = glm::angleAxis(-0.5f * kPi, glm::vec3(1, 0, 0)); // -Z down
    PunctualLight light;
    light.type = type;
    light.intensity = glm::vec3(10.0f);
    light.tanAngularRadius = 0.1f;
    light.radius = 0.2f;
    light.outerCosine = std::cos(0.6f);
    light.innerCosine = std::cos(0.5f);
    scene.lights.push_back(light);
    return scene;
}

// Sees the floor around (x, 0, 0), from under the occluders.
TraceRequest lookingAt(float x, uint32_t samples)
{
    TraceRequest r;
    r.desc.width = r.desc.height = 2;
    r.desc.hasShadowSignal = true;
    r.samples = samples;
    r.view.camera = lookAt(glm::vec3(x, 0.3f, 0.6f), glm::vec3(x, 0, 0), 0.001f, 1.0f, 0.01f);
    return r;
}

// Of a disc of radius 1, left of a straight edge at `u` of its middle.
float visibleShare(float u)
{
    if (u <= -1.0f) return 0.0f;
    return u >= 1.0f ? 1.0f : 1.0f - (std::acos(u) - u * std::sqrt(1.0f - u * u)) / kPi;
}
} // namespace

TEST_CASE("a sun's penumbra behind an edge is that of its disc", "[gpu]")
{
    const float height = 2.0f, halfWidth = height * 0.1f;
    const Scene scene = underLight({makeHalf(height, Opaque)}, LightType::Directional, 5.0f);
    for (const float u : {-1.2f, -0.7f, -0.2f, 0.4f, 0.9f, 1.2f})
    {
        const Traced t = test::trace(scene, nullptr, lookingAt(-u * halfWidth, 1024));
        INFO("at " << u << " of the half-width");
        CHECK(t.shadowMean[0].w == Approx(visibleShare(u)).margin(0.01));
        CHECK(t.shadowMean[0].g == t.shadowMean[0].w);
    }
}

TEST_CASE("a spot's penumbra follows similar triangles", "[gpu]")
{
    const float height = 2.0f, lamp = 5.0f, halfWidth = 0.2f * height / (lamp - height);
    const Scene scene = underLight({makeHalf(height, Opaque)}, LightType::Spot, lamp);
    for (const float u : {-0.7f, 0.4f})
    {
        const Traced t = test::trace(scene, nullptr, lookingAt(-u * halfWidth, 1024));
        INFO("at " << u << " of the half-width");
        CHECK(t.shadowMean[0].w == Approx(visibleShare(u)).margin(0.02));
    }
    const Traced outside = test::trace(scene, nullptr, lookingAt(-4.0f, 1)); // of the cone
    CHECK(outside.shadow[0] == glm::vec4(0.0f));
    CHECK(outside.sun[0].g == 0.0f);
}

TEST_CASE("a shadow has the distance to what casts it, and the colour that comes through", "[gpu]")
{
    struct Row
    {
        const char* what;
        std::vector<Primitive> others;
        glm::vec3 color;
        float low, high; // of the distance: rays are up to 6 degrees oblique
    };
    const glm::vec3 clear(0.6f), tinted = 0.75f * glm::vec3(0.5f, 1.0f, 0.25f);
    const Row rows[] = {
        {"nothing", {}, glm::vec3(1.0f), kLit, kLit},
        {"an opaque surface", {makeHalf(2, Opaque)}, glm::vec3(0.0f), 2.0f, 2.02f},
        {"the nearer of two", {makeHalf(3, Opaque), makeHalf(2, Opaque)}, glm::vec3(0.0f), 2.0f, 2.02f},
        {"a pane", {makeHalf(2, Glass)}, clear, 2.0f, 2.02f},
        {"a coloured pane", {makeHalf(1, Tinted)}, tinted, 1.0f, 1.01f},
        {"three panes",
         {makeHalf(3, Glass), makeHalf(1, Tinted), makeHalf(2, Glass)},
         tinted * clear * clear,
         1.0f,
         1.01f},
        {"a pane over an opaque surface", {makeHalf(3, Glass), makeHalf(2, Opaque)}, glm::vec3(0.0f), 2.0f, 2.02f},
        {"a pane under an opaque surface", {makeHalf(1, Glass), makeHalf(2, Opaque)}, glm::vec3(0.0f), 2.0f, 2.02f},
    };
    for (const Row& row : rows)
    {
        const Traced t = test::trace(underLight(row.others, LightType::Directional, 5.0f), nullptr, lookingAt(3.0f, 0));
        INFO(row.what);
        for (int c = 0; c < 3; ++c) CHECK(t.shadow[0][c] == Approx(row.color[c]).margin(1e-5));
        CHECK((t.shadow[0].w >= row.low - 1e-3f && t.shadow[0].w <= row.high));
    }
}

TEST_CASE("a surface that faces away from the light has no shadow, and the sky is lit", "[gpu]")
{
    Scene scene = underLight({makeHalf(2, Opaque)}, LightType::Directional, 5.0f);
    TraceRequest r = lookingAt(0.0f, 16);
    r.view.camera = lookAt(glm::vec3(3, 1, 0.5f), glm::vec3(3, 2, 0), 0.001f, 1.0f, 0.01f); // from below
    const Traced below = test::trace(scene, nullptr, r);
    CHECK(below.shadow[0] == glm::vec4(0.0f));
    CHECK(below.shadowMean[0] == glm::vec4(0.0f));
    CHECK(below.sun[0].g == 0.0f);
    r.view.camera = lookAt(glm::vec3(-3, 1, 0), glm::vec3(-4, 3, 0), 0.001f, 1.0f, 0.01f);
    const Traced sky = test::trace(scene, nullptr, r);
    CHECK(sky.shadow[0] == glm::vec4(1.0f, 1.0f, 1.0f, kLit));
    CHECK(sky.shadowMean[0] == glm::vec4(1.0f));
    CHECK(sky.sun[0].g == 0.0f);
}

TEST_CASE("the light is in its own signal, or in those of the lobes, but never in both", "[gpu]")
{
    const Scene scene = underLight({}, LightType::Directional, 5.0f);
    TraceRequest r = lookingAt(0.0f, 256);
    r.desc.maxBounces = 1;
    const Traced apart = test::trace(scene, nullptr, r);
    CHECK(apart.diffuseMean[0].g == 0.0f);
    CHECK(apart.specularMean[0].g == 0.0f);
    r.desc.hasShadowSignal = false;
    const Traced inLobes = test::trace(scene, nullptr, r);
    CHECK(inLobes.composed(0).g == Approx(apart.composed(0).g).epsilon(0.005));
    CHECK(apart.sun[0].g == Approx(apart.composed(0).g));
}

TEST_CASE("however the light is split into signals, panes give the picture that plain paths give", "[gpu]")
{
    const Scene scene = makePanes();
    TraceRequest r;
    r.desc.width = 48;
    r.desc.height = 27;
    r.desc.roughening = 0.0f;
    r.desc.hasShadowSignal = GENERATE(true, false);
    r.desc.lobes = r.desc.hasShadowSignal ? GENERATE(Lobes::Both, Lobes::Merged) : Lobes::Both;
    r.samples = r.plain = 512;
    ScenePose pose(scene);
    r.view.camera = findCamera(scene, pose, 16.0f / 9.0f).value();
    const Traced traced = test::trace(scene, nullptr, r);
    for (size_t strip = 0; strip < 6; ++strip)
    {
        const auto isInside = [&](size_t i) { return i % 48 / 8 == strip; };
        const glm::vec3 split =
            test::meanOf(traced.viewZ.size(), isInside, [&](size_t i) { return traced.composed(i); });
        const glm::vec3 plain = test::meanOf(
            traced.viewZ.size(), isInside, [&](size_t i) { return glm::vec3(traced.plainMean[i] + traced.direct[i]); });
        INFO("strip " << strip << ", apart " << r.desc.hasShadowSignal << ", lobes " << int(r.desc.lobes));
        for (int c = 0; c < 3; ++c) CHECK(split[c] == Approx(plain[c]).epsilon(0.005));
    }
}
