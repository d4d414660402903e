// Primary surface replacement: a mirror has the guides and the light of the unfolded scene, which is built for
// comparison.
#include "catch.h"
#include "scene_mirror.h"
#include "tracer_fixture.h"

#include <algorithm>
#include <cmath>

using namespace sample;
using test::Traced;
using test::TraceRequest;

namespace
{
constexpr float kDuration = 4.0f;

TraceRequest request(const Scene& scene, bool hasPsr)
{
    TraceRequest r;
    r.desc.width = 96;
    r.desc.height = 64;
    r.desc.mirrorRoughness = hasPsr ? kMirrorRoughness : 0.0f;
    r.samples = 0;
    r.time = 0.6;
    r.previousTime = 0.55;
    ScenePose pose(scene);
    pose.update(r.time);
    r.view.camera = *findCamera(scene, pose, 1.5f);
    return r;
}

std::vector<bool> pixelsOf(const Traced& traced, int material)
{
    std::vector<bool> pixels(traced.motion.size());
    for (size_t i = 0; i < pixels.size(); ++i) pixels[i] = int(traced.motion[i].w) == material;
    return pixels;
}

struct Differences
{
    size_t pixelCount = 0;
    size_t otherSurface = 0; // an edge falls to either side
    size_t otherDepth = 0, otherNormal = 0, otherMotion = 0, otherLight = 0;
    size_t movingCount = 0;
};

// `mirror`: pixels in which the mirror itself is the first surface.
Differences compare(const Traced& mirrored, const Traced& unfolded, const std::vector<bool>& mirror)
{
    Differences d;
    for (size_t i = 0; i < mirror.size(); ++i)
    {
        if (!mirror[i]) continue;
        ++d.pixelCount;
        const bool isSame = mirrored.motion[i].w == unfolded.motion[i].w &&
                            std::abs(mirrored.viewZ[i] - unfolded.viewZ[i]) < 0.05f * std::abs(unfolded.viewZ[i]);
        d.otherSurface += !isSame;
        if (!isSame) continue;
        const glm::vec4 n = mirrored.normalRoughness[i], m = unfolded.normalRoughness[i];
        const glm::vec3 a(mirrored.motion[i]), b(unfolded.motion[i]);
        d.otherDepth += std::abs(mirrored.viewZ[i] - unfolded.viewZ[i]) > 1e-4f * std::abs(unfolded.viewZ[i]);
        d.otherNormal += glm::distance(n, m) > 1e-3f;
        d.otherMotion += glm::distance(a, b) > 1e-4f + 1e-3f * glm::length(b);
        d.movingCount += glm::length(b) > 1e-3f;
        const auto isOther = [&](const test::Pixels& p, const test::Pixels& q)
        { return glm::distance(glm::vec3(p[i]), glm::vec3(q[i])) > 0.02f * (0.1f + glm::length(glm::vec3(q[i]))); };
        d.otherLight += isOther(mirrored.diffuseFactor, unfolded.diffuseFactor) ||
                        isOther(mirrored.specularFactor, unfolded.specularFactor) ||
                        isOther(mirrored.direct, unfolded.direct);
    }
    return d;
}

void checkAlike(const Differences& d)
{
    INFO(d.pixelCount << " pixels; other surface " << d.otherSurface << ", depth " << d.otherDepth << ", normal "
                      << d.otherNormal << ", motion " << d.otherMotion << ", light " << d.otherLight);
    CHECK(d.pixelCount > 400);
    CHECK(d.movingCount > 50);
    CHECK(d.otherSurface < d.pixelCount / 50);
    CHECK(d.otherDepth + d.otherNormal + d.otherMotion == 0);
    CHECK(d.otherLight < d.pixelCount / 20); // mips may fall to either side of a texture's level
}

// A ball on a plate before a mirror that turns and comes nearer; or the same behind it, as such a mirror shows it.
Scene makeMovingMirror(bool isUnfolded)
{
    Scene scene;
    scene.name = "moving mirror";
    scene.materials = {test::makeMaterial(glm::vec3(0.6f), 0.0f, 0.5f), test::makeMaterial(glm::vec3(1.0f), 1.0f, 0.0f),
                       test::makeMaterial(glm::vec3(0.7f, 0.3f, 0.2f), 0.0f, 0.3f)};
    scene.meshes = {{{makeQuad(0, {-3, 0, 5}, {6, 0, 0}, {0, 0, -6}), makeSphere({0.3f, 0.7f, 0}, 0.6f, 2)}, {}},
                    {{makeQuad(1, {-2.2f, -0.5f, 0}, {4.4f, 0, 0}, {0, 2.6f, 0})}, {}}};
    scene.nodes = {makeNode("things", 0, glm::vec3(0.0f), 0.0f), makeNode("mirror", 1, glm::vec3(0.0f), 0.0f)};
    scene.duration = kDuration;
    const auto place = [](float phase) { return glm::vec3(0, 0, -1.6f + 0.2f * std::sin(phase)); };
    const float turns = isUnfolded ? 2.0f : 1.0f; // what is seen turns twice as far as the mirror
    scene.channels = {makeChannel(1, AnimationPath::Translation, 3, kDuration, place),
                      makeChannel(1, AnimationPath::Rotation, 4, kDuration,
                                  [=](float phase) { return turnAboutY(turns * 0.2f * std::sin(phase + 0.4f)); })};
    if (!isUnfolded) return scene;
    // T R(2 angle) S T^-1, where T places the mirror and S swaps front and back, is its reflection.
    scene.nodes[1].mesh = kNone;
    scene.nodes[1].scale = glm::vec3(1, 1, -1);
    scene.nodes.push_back(makeNode("seen", 0, glm::vec3(0.0f), 0.0f));
    scene.nodes[2].parent = 1;
    scene.channels.push_back(
        makeChannel(2, AnimationPath::Translation, 3, kDuration, [=](float phase) { return -place(phase); }));
    return scene;
}

const Environment& evenSky()
{
    static const Environment sky = makeUniformEnvironment(glm::vec3(0.9f, 1.0f, 1.1f));
    return sky;
}
} // namespace

TEST_CASE("a mirror has the guides, motion and materials of the unfolded scene", "[gpu]")
{
    const Scene yard = makeMirrorYard(), twin = makeMirrorTwin();
    const Traced plain = test::trace(yard, &evenSky(), request(yard, false));
    const Traced mirrored = test::trace(yard, &evenSky(), request(yard, true));
    const Traced unfolded = test::trace(twin, &evenSky(), request(twin, false));
    const std::vector<bool> mirror = pixelsOf(plain, 6);
    checkAlike(compare(mirrored, unfolded, mirror));
    // Elsewhere nothing changes.
    for (size_t i = 0; i < mirror.size(); ++i)
        if (!mirror[i])
        {
            CHECK(mirrored.viewZ[i] == Approx(plain.viewZ[i]));
            CHECK(glm::distance(mirrored.normalRoughness[i], plain.normalRoughness[i]) < 1e-4f);
            CHECK(glm::distance(mirrored.motion[i], plain.motion[i]) < 1e-5f);
        }
}

TEST_CASE("a mirror that moves and turns has the motion of the unfolded scene", "[gpu]")
{
    const Scene scene = makeMovingMirror(false), twin = makeMovingMirror(true);
    TraceRequest r = request(makeMirrorYard(), false);
    r.view.camera = lookAt(glm::vec3(0.4f, 1.6f, 2.6f), glm::vec3(0, 0.3f, -1.6f), 0.9f, 1.5f, 0.01f);
    const Traced plain = test::trace(scene, &evenSky(), r), unfolded = test::trace(twin, &evenSky(), r);
    r.desc.mirrorRoughness = kMirrorRoughness;
    const Traced mirrored = test::trace(scene, &evenSky(), r);
    std::vector<bool> mirror = pixelsOf(plain, 1);
    // The sky in it is at no place that could move.
    for (size_t i = 0; i < mirror.size(); ++i) mirror[i] = mirror[i] && unfolded.viewZ[i] > -1000.0f;
    checkAlike(compare(mirrored, unfolded, mirror));
}

TEST_CASE("followed mirrors show what paths show that know nothing of them", "[gpu]")
{
    Scene scene = makeMirrorYard();
    scene.materials[6].baseColor = glm::vec4(0.9f, 0.6f, 0.4f, 1.0f); // a tinted one
    TraceRequest r = request(scene, true);
    r.desc.width = 48;
    r.desc.height = 32;
    r.samples = 96;
    r.plain = 96;
    r.desc.roughening = 0.0f;
    r.desc.maxBounces = 16; // a mirror takes one
    const Traced traced = test::trace(scene, &evenSky(), r);
    r.desc.mirrorRoughness = 0.0f;
    r.samples = r.plain = 0;
    const std::vector<bool> mirror = pixelsOf(test::trace(scene, &evenSky(), r), 6);
    const auto mean = [&](auto value)
    {
        return test::meanOf(
            mirror.size(), [&](size_t i) { return bool(mirror[i]); }, value);
    };
    const glm::vec3 followed = mean([&](size_t i) { return traced.composed(i); });
    const glm::vec3 plain = mean([&](size_t i) { return glm::vec3(traced.plainMean[i]); });
    for (int c = 0; c < 3; ++c) CHECK(followed[c] == Approx(plain[c]).epsilon(0.03));
}

TEST_CASE("a pane of glass shows what lies behind it, dimmed by both its sides", "[gpu]")
{
    std::vector<Material> materials = {test::makeMaterial(glm::vec3(0.5f), 0.0f, 0.6f),
                                       test::makeMaterial(glm::vec3(0.5f, 0.8f, 1.0f), 0.0f, 0.0f)};
    const Primitive wall = makeQuad(0, {-9, -9, -3}, {18, 0, 0}, {0, 18, 0});
    const Primitive pane = makeQuad(1, {-9, -9, 0}, {18, 0, 0}, {0, 18, 0});
    TraceRequest r = request(makeMirrorYard(), false);
    r.view.camera = lookAt(glm::vec3(0, 0, 5), glm::vec3(0), 0.01f, 1.5f, 0.01f);
    const Traced bare = test::trace(test::makeScene({wall}, materials), &evenSky(), r);
    materials[1].isGlass = true;
    materials[1].isSolidGlass = false;
    const Traced behind = test::trace(test::makeScene({wall, pane}, materials), &evenSky(), r);
    const size_t i = bare.center();
    CHECK(behind.viewZ[i] == Approx(bare.viewZ[i]));
    CHECK(behind.motion[i].w == 0.0f);
    const float reflected = 2.0f * 0.04f / 1.04f; // index 1.5, straight on
    for (int c = 0; c < 3; ++c)
    {
        const float tint = (1.0f - reflected) * materials[1].baseColor[c];
        CHECK(behind.diffuseFactor[i][c] == Approx(tint * bare.diffuseFactor[i][c]).epsilon(1e-3));
        CHECK(behind.direct[i][c] == Approx(reflected * evenSky().mean[c]).epsilon(0.01)); // of the sky
    }
}

TEST_CASE("solid glass bends the camera's ray, and what it shows lies on the ray as if it were straight", "[gpu]")
{
    std::vector<Material> materials = {test::makeMaterial(glm::vec3(0.5f), 0.0f, 0.6f),
                                       test::makeMaterial(glm::vec3(1.0f), 0.0f, 0.0f)};
    materials[1].isGlass = true;
    const Primitive wall = makeQuad(0, {-20, -20, -3}, {40, 0, 0}, {0, 40, 0});
    const Primitive front = makeQuad(1, {-20, -20, 1}, {40, 0, 0}, {0, 40, 0});
    const Primitive back = makeQuad(1, {-20, -20, 0}, {0, 40, 0}, {40, 0, 0}); // its other side
    TraceRequest r = request(makeMirrorYard(), false);
    // 30 degrees off the slab's normal: in glass of index 1.5 the sine is a third.
    r.view.camera = lookAt(glm::vec3(0, 0, 5), glm::vec3(4.0f * std::tan(0.5235988f), 0, 1), 0.001f, 1.5f, 0.01f);
    const Traced traced = test::trace(test::makeScene({wall, front, back}, materials), &evenSky(), r);
    const size_t i = traced.center();
    const float length = 7.0f / std::cos(0.5235988f) + 1.0f / std::sqrt(1.0f - 1.0f / 9.0f);
    CHECK(-traced.viewZ[i] == Approx(length).epsilon(1e-3));
    CHECK(glm::distance(glm::vec3(traced.normalRoughness[i]), glm::vec3(0, 0, 1)) < 1e-3f); // bent back again
    CHECK(glm::vec3(traced.motion[i]) == glm::vec3(0.0f));
}
