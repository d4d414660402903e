#include "window/camera_control.h"

#include <algorithm>
#include <cmath>

namespace sample
{
namespace
{
constexpr float kMaxPitch = 1.55f; // short of the pole, where up has no direction
constexpr float kFast = 5.0f;
} // namespace

void CameraControl::start(const Camera& camera, float distance)
{
    const glm::mat4 viewToWorld = glm::inverse(camera.worldToView);
    const glm::vec3 ahead = -glm::vec3(viewToWorld[2]);
    m_eye = glm::vec3(viewToWorld[3]);
    m_yaw = std::atan2(ahead.x, -ahead.z);
    m_pitch = std::clamp(std::asin(std::clamp(ahead.y, -1.0f, 1.0f)), -kMaxPitch, kMaxPitch);
    m_distance = distance;
    m_speed = 0.5f * distance;
    m_verticalFov = 2.0f * std::atan(camera.tanHalfFovY);
    m_nearPlane = -camera.viewToClip[3][2];
}

glm::vec3 CameraControl::ahead() const
{
    return {std::sin(m_yaw) * std::cos(m_pitch), std::sin(m_pitch), -std::cos(m_yaw) * std::cos(m_pitch)};
}

void CameraControl::apply(CameraMode mode, const CameraInput& input)
{
    const glm::vec3 center = target();
    m_yaw += input.turn.x;
    m_pitch = std::clamp(m_pitch - input.turn.y, -kMaxPitch, kMaxPitch);
    const float factor = std::exp2(0.25f * input.zoom);
    if (mode == CameraMode::Orbit)
    {
        m_distance /= factor;
        m_eye = center - m_distance * ahead();
    }
    else
        m_speed *= factor;
    const glm::vec3 right(std::cos(m_yaw), 0.0f, std::sin(m_yaw));
    const glm::vec3 way = input.move.x * right + input.move.y * glm::vec3(0.0f, 1.0f, 0.0f) + input.move.z * ahead();
    m_eye += way * (m_speed * input.seconds * (input.isFast ? kFast : 1.0f));
}

void CameraControl::setTarget(const glm::vec3& target)
{
    m_distance = std::max(glm::length(target - m_eye), 10.0f * m_nearPlane);
    m_eye = target - m_distance * ahead();
}

Camera CameraControl::camera(float aspect) const
{
    return lookAt(m_eye, m_eye + ahead(), m_verticalFov, aspect, m_nearPlane);
}
} // namespace sample
