// The camera of a frame: right-handed view space (X right, Y up, looking along -Z), clip depth in [0; 1].
#pragma once
#include "scene_pose.h"

namespace sample
{
struct Camera
{
    glm::mat4 worldToView = glm::mat4(1.0f); // rigid
    glm::mat4 viewToClip = glm::mat4(1.0f);  // without jitter
    float tanHalfFovX = 1.0f;
    float tanHalfFovY = 1.0f;
};

/// The scene's first camera, as its node stands in the pose; nullopt when no node has one.
/// `aspect` is width / height.
std::optional<Camera> findCamera(const Scene& scene, const ScenePose& pose, float aspect);

/// A camera that sees the whole of `bounds` from the front, slightly from above.
Camera frameBounds(const Bounds& bounds, float aspect);

/// Looks from `eye` to `target` with Y up. `verticalFov` in radians.
Camera lookAt(const glm::vec3& eye, const glm::vec3& target, float verticalFov, float aspect, float nearPlane);

/// Sub-pixel offset of frame `frameIndex` in pixels, in [-0.5; 0.5]: Halton (2, 3), period 16.
glm::vec2 jitterOf(uint32_t frameIndex);
} // namespace sample
