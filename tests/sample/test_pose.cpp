// Animation, skinning and what is remembered of the frame before.
#include "camera.h"
#include "catch.h"
#include "scene_cornell.h"
#include "scene_pose.h"

#include <glm/gtc/matrix_transform.hpp>

using namespace sample;

namespace
{
Primitive makeTriangle()
{
    Primitive p;
    p.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    p.normals.assign(3, glm::vec3(0, 0, 1));
    p.indices = {0, 1, 2};
    return p;
}

Scene makeScene(Primitive primitive)
{
    Scene scene;
    scene.materials.emplace_back();
    scene.meshes.push_back({{std::move(primitive)}, {}});
    scene.nodes.emplace_back();
    scene.nodes[0].mesh = 0;
    return scene;
}

AnimationChannel translationOf(int node, Interpolation interpolation, std::vector<float> times,
                               std::vector<float> values)
{
    AnimationChannel channel;
    channel.node = node;
    channel.interpolation = interpolation;
    channel.times = std::move(times);
    channel.values = std::move(values);
    return channel;
}

float xAt(Scene scene, const AnimationChannel& channel, double time)
{
    scene.channels = {channel};
    scene.duration = 10.0f;
    ScenePose pose(scene);
    pose.update(time);
    return pose.positions[0].x;
}
} // namespace

TEST_CASE("keys are interpolated linearly, in steps and as cubic splines", "[unit]")
{
    const Scene scene = makeScene(makeTriangle());
    const auto linear = translationOf(0, Interpolation::Linear, {1, 3}, {0, 0, 0, 4, 0, 0});
    CHECK(xAt(scene, linear, 0.5) == 0.0f); // before the first key
    CHECK(xAt(scene, linear, 1.5) == Approx(1.0));
    CHECK(xAt(scene, linear, 5.0) == 4.0f); // after the last
    const auto step = translationOf(0, Interpolation::Step, {1, 3}, {0, 0, 0, 4, 0, 0});
    CHECK(xAt(scene, step, 2.9) == 0.0f);
    CHECK(xAt(scene, step, 3.0) == 4.0f);
    // x = t^2 on [0; 2]: tangents 0 and 4.
    const auto cubic =
        translationOf(0, Interpolation::Cubic, {0, 2}, {0, 0, 0, 0, 0, 0, 0, 0, 0, 4, 0, 0, 4, 0, 0, 0, 0, 0});
    CHECK(xAt(scene, cubic, 1.0) == Approx(1.0));
    CHECK(xAt(scene, cubic, 1.5) == Approx(2.25));
}

TEST_CASE("a skinned vertex follows its joints and remembers where it was", "[unit]")
{
    Primitive p = makeTriangle();
    p.joints.assign(3, glm::uvec4(0, 1, 0, 0));
    p.weights = {glm::vec4(1, 0, 0, 0), glm::vec4(0.5f, 0.5f, 0, 0), glm::vec4(0, 1, 0, 0)};
    Scene scene = makeScene(p);
    scene.nodes[0].skin = 0;
    scene.nodes[0].translation = glm::vec3(100, 0, 0); // a skinned mesh ignores its own node
    scene.nodes.resize(3);
    scene.skins.push_back({{1, 2}, {glm::mat4(1.0f), glm::translate(glm::mat4(1.0f), glm::vec3(0, -1, 0))}});
    scene.nodes[2].translation = glm::vec3(0, 1, 0); // at rest: inverse bind undoes it
    scene.channels = {translationOf(2, Interpolation::Linear, {0, 1}, {0, 1, 0, 0, 1, 2})};
    scene.duration = 1.0f;
    ScenePose pose(scene);
    CHECK(pose.positions[2] == glm::vec3(0, 1, 0));
    pose.update(0.5); // joint 1 is now one unit along z
    CHECK(pose.positions[0] == glm::vec3(0, 0, 0));
    CHECK(pose.positions[1].z == Approx(0.5));
    CHECK(pose.positions[2].z == Approx(1.0));
    CHECK(pose.previous[2] == glm::vec3(0, 1, 0));
    pose.update(0.75);
    CHECK(pose.previous[2].z == Approx(1.0));
    pose.forgetPrevious();
    CHECK(pose.previous == pose.positions);
}

TEST_CASE("morph targets are added by weight", "[unit]")
{
    Primitive p = makeTriangle();
    p.targets.push_back({{{0, 0, 1}, {0, 0, 1}, {0, 0, 1}}, {}});
    Scene scene = makeScene(p);
    scene.meshes[0].weights = {0.25f};
    CHECK(ScenePose(scene).positions[0].z == Approx(0.25));
    scene.nodes[0].weights = {0.5f};
    CHECK(ScenePose(scene).positions[0].z == Approx(0.5));
}

TEST_CASE("a mirrored node keeps its faces outside", "[unit]")
{
    Scene scene = makeScene(makeTriangle());
    scene.nodes[0].scale = glm::vec3(-1, 1, 1);
    const ScenePose pose(scene);
    const PosedTriangle& t = pose.triangles[0];
    const glm::vec3 a = pose.positions[t.vertices[0]], b = pose.positions[t.vertices[1]],
                    c = pose.positions[t.vertices[2]];
    CHECK(glm::cross(b - a, c - a).z > 0.0f);
    CHECK(pose.normals[0].z == Approx(1.0));
}

TEST_CASE("geometry that leaves the range of floats is refused", "[unit]")
{
    Scene scene = makeScene(makeTriangle());
    scene.nodes[0].scale = glm::vec3(1e30f);
    scene.nodes.emplace_back(scene.nodes[0]);
    scene.nodes[1].parent = 0;
    CHECK_THROWS_AS(ScenePose(scene), SceneError);
}

TEST_CASE("the default scene moves a block and the camera, and closes its loop", "[unit]")
{
    const Scene scene = makeCornellBox();
    ScenePose pose(scene);
    const auto start = pose.positions;
    const Camera first = findCamera(scene, pose, 16.0f / 9.0f).value();
    pose.update(1.0);
    CHECK(pose.positions != start);
    CHECK(findCamera(scene, pose, 16.0f / 9.0f)->worldToView != first.worldToView);
    // The room stands still.
    CHECK(pose.positions[0] == start[0]);
    pose.update(8.0);
    for (size_t i = 0; i < start.size(); ++i) CHECK(glm::distance(pose.positions[i], start[i]) < 1e-4f);
    const glm::mat4 view = first.worldToView;
    CHECK(glm::determinant(glm::mat3(view)) == Approx(1.0).margin(1e-5));
}

TEST_CASE("framing shows every corner of the scene", "[unit]")
{
    for (const float aspect : {0.4f, 1.0f, 2.5f})
    {
        const Bounds bounds = {glm::vec3(-3, 7, 2), glm::vec3(5, 8, 9)};
        const Camera camera = frameBounds(bounds, aspect);
        for (int i = 0; i < 8; ++i)
        {
            const glm::vec3 corner(i & 1 ? bounds.upper.x : bounds.lower.x, i & 2 ? bounds.upper.y : bounds.lower.y,
                                   i & 4 ? bounds.upper.z : bounds.lower.z);
            const glm::vec4 clip = camera.viewToClip * camera.worldToView * glm::vec4(corner, 1.0f);
            CHECK(clip.w > 0.0f);
            CHECK(std::abs(clip.x) <= clip.w);
            CHECK(std::abs(clip.y) <= clip.w);
            CHECK((clip.z >= 0.0f && clip.z <= clip.w));
        }
    }
}
