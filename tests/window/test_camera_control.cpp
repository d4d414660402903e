// The camera under the user's hand, and the sun.
#include "catch.h"
#include "window/camera_control.h"
#include "window/sun.h"

using namespace sample;

namespace
{
Camera someCamera() { return lookAt({1.0f, 2.0f, 5.0f}, {0.0f, 1.5f, 0.0f}, 0.7f, 1.5f, 0.02f); }

float largestDifference(const glm::mat4& a, const glm::mat4& b)
{
    float largest = 0.0f;
    for (int i = 0; i < 16; ++i) largest = std::max(largest, std::abs(a[i / 4][i % 4] - b[i / 4][i % 4]));
    return largest;
}
} // namespace

TEST_CASE("a camera that is taken over stays where it is", "[unit]")
{
    CameraControl control;
    control.start(someCamera(), 5.0f);
    const Camera camera = control.camera(1.5f);
    CHECK(largestDifference(camera.worldToView, someCamera().worldToView) < 1e-5f);
    CHECK(largestDifference(camera.viewToClip, someCamera().viewToClip) < 1e-5f);
}

TEST_CASE("orbiting keeps the target and its distance, the wheel brings it nearer", "[unit]")
{
    CameraControl control;
    control.start(someCamera(), 5.0f);
    const glm::vec3 target = control.target(), eye = control.eye();
    CameraInput input;
    input.turn = {1.0f, -0.4f};
    control.apply(CameraMode::Orbit, input);
    CHECK(glm::length(control.target() - target) < 1e-4f);
    CHECK(glm::length(control.eye() - target) == Approx(5.0f).epsilon(1e-4));
    CHECK(glm::length(control.eye() - eye) > 1.0f);
    input = {};
    input.zoom = 4.0f;
    control.apply(CameraMode::Orbit, input);
    CHECK(glm::length(control.eye() - target) == Approx(2.5f).epsilon(1e-4));
}

TEST_CASE("flying goes where the camera looks, faster where it is asked to", "[unit]")
{
    CameraControl slow, fast;
    slow.start(someCamera(), 4.0f);
    fast.start(someCamera(), 4.0f);
    const glm::vec3 eye = slow.eye(), ahead = glm::normalize(slow.target() - eye);
    CameraInput input;
    input.move.z = 1.0f;
    input.seconds = 0.5f;
    slow.apply(CameraMode::Fly, input);
    CHECK(glm::length(slow.eye() - eye - ahead) < 1e-4f); // half of the distance in a second
    input.isFast = true;
    fast.apply(CameraMode::Fly, input);
    CHECK(glm::length(fast.eye() - eye) > 4.0f);
}

TEST_CASE("no turn goes past the pole", "[unit]")
{
    CameraControl control;
    control.start(someCamera(), 5.0f);
    CameraInput input;
    input.turn.y = -10.0f;
    control.apply(CameraMode::Fly, input);
    const Camera camera = control.camera(1.0f);
    CHECK(std::isfinite(camera.worldToView[0][0]));
    CHECK(glm::normalize(control.target() - control.eye()).y > 0.99f);
}

TEST_CASE("the sun stands where its angles say, under turned parents too", "[unit]")
{
    Scene scene;
    scene.lights.push_back({LightType::Directional});
    Node parent, node;
    parent.rotation = glm::angleAxis(0.8f, glm::normalize(glm::vec3(0.2f, 1.0f, 0.4f)));
    node.parent = 0;
    node.light = 0;
    scene.nodes = {parent, node};
    CHECK(turnSun(scene, {35.0f, 20.0f}));
    const std::optional<SunAngles> sun = sunOf(scene);
    REQUIRE(sun);
    CHECK(sun->azimuth == Approx(35.0f).margin(0.01));
    CHECK(sun->elevation == Approx(20.0f).margin(0.01));
    CHECK(turnSun(scene, {0.0f, 90.0f})); // straight above, where there is no up
    CHECK(sunOf(scene)->elevation == Approx(90.0f).margin(0.1));
    scene.nodes.pop_back();
    CHECK_FALSE(turnSun(scene, {}));
    CHECK_FALSE(sunOf(scene));
}
