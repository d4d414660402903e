#include "camera.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace sample
{
namespace
{
Camera fromView(const glm::mat4& worldToView, float verticalFov, float aspect, float nearPlane)
{
    Camera camera;
    camera.worldToView = worldToView;
    camera.tanHalfFovY = std::tan(0.5f * verticalFov);
    camera.tanHalfFovX = camera.tanHalfFovY * aspect;
    // Far plane at infinity: depth = 1 - near / -z, so that no far distance has to be guessed.
    glm::mat4 clip(0.0f);
    clip[0][0] = 1.0f / camera.tanHalfFovX;
    clip[1][1] = 1.0f / camera.tanHalfFovY;
    clip[2][2] = -1.0f;
    clip[2][3] = -1.0f;
    clip[3][2] = -nearPlane;
    camera.viewToClip = clip;
    return camera;
}

float radicalInverse(uint32_t index, uint32_t base)
{
    float result = 0.0f, fraction = 1.0f;
    for (; index > 0; index /= base)
    {
        fraction /= float(base);
        result += fraction * float(index % base);
    }
    return result;
}
} // namespace

std::optional<Camera> findCamera(const Scene& scene, const ScenePose& pose, float aspect)
{
    for (size_t n = 0; n < scene.nodes.size(); ++n)
    {
        if (scene.nodes[n].camera == kNone) continue;
        const PerspectiveCamera& camera = scene.cameras[size_t(scene.nodes[n].camera)];
        const glm::mat4& toWorld = pose.nodeToWorld()[n];
        // A camera has no scale: only the directions of its axes count.
        const glm::vec3 back = glm::normalize(glm::vec3(toWorld[2]));
        const glm::vec3 right = glm::normalize(glm::cross(glm::vec3(toWorld[1]), back));
        const glm::vec3 eye(toWorld[3]);
        glm::mat4 rigid(1.0f);
        rigid[0] = glm::vec4(right, 0.0f);
        rigid[1] = glm::vec4(glm::cross(back, right), 0.0f);
        rigid[2] = glm::vec4(back, 0.0f);
        rigid[3] = glm::vec4(eye, 1.0f);
        if (!std::isfinite(glm::determinant(rigid))) continue; // a collapsed node
        return fromView(glm::inverse(rigid), camera.verticalFov, aspect, camera.nearPlane);
    }
    return std::nullopt;
}

Camera lookAt(const glm::vec3& eye, const glm::vec3& target, float verticalFov, float aspect, float nearPlane)
{
    return fromView(glm::lookAtRH(eye, target, glm::vec3(0.0f, 1.0f, 0.0f)), verticalFov, aspect, nearPlane);
}

Camera frameBounds(const Bounds& bounds, float aspect)
{
    constexpr float kVerticalFov = 0.7f;
    const float halfX = std::atan(std::tan(0.5f * kVerticalFov) * aspect);
    const float radius = std::max(bounds.radius(), 1e-6f);
    const float distance = radius / std::sin(std::min(0.5f * kVerticalFov, halfX));
    const glm::vec3 direction = glm::normalize(glm::vec3(0.35f, 0.25f, 1.0f));
    return lookAt(bounds.center() + direction * distance, bounds.center(), kVerticalFov, aspect, 0.01f * radius);
}

glm::vec2 jitterOf(uint32_t frameIndex)
{
    const uint32_t index = frameIndex % 16 + 1;
    return {radicalInverse(index, 2) - 0.5f, radicalInverse(index, 3) - 0.5f};
}
} // namespace sample
