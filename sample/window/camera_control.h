// The camera under the user's hand: flying freely, or round a point. Pure.
#pragma once
#include "camera.h"

namespace sample
{
enum class CameraMode : uint8_t
{
    Scene, // the scene's own camera, as it is animated
    Fly,
    Orbit
};

/// What the user did since the frame before.
struct CameraInput
{
    glm::vec2 turn = glm::vec2(0.0f); // radians to the right and down
    glm::vec3 move = glm::vec3(0.0f); // to the right, up and ahead, each in [-1; 1]
    float zoom = 0.0f;                // steps of the wheel; nearer, or faster where it flies
    float seconds = 0.0f;
    bool isFast = false;
};

class CameraControl
{
public:
    /// Starts from a camera; what it looks at is `distance` away, a second of flight covers half of that. Roll is lost.
    void start(const Camera& camera, float distance);
    void apply(CameraMode mode, const CameraInput& input);
    Camera camera(float aspect) const; // aspect: width / height

    glm::vec3 eye() const { return m_eye; }
    glm::vec3 target() const { return m_eye + m_distance * ahead(); }
    /// Looks from the same side at another point.
    void setTarget(const glm::vec3& target);

private:
    glm::vec3 ahead() const;

    glm::vec3 m_eye = glm::vec3(0.0f);
    float m_yaw = 0.0f;   // radians, 0 looks along -Z, growing to the right
    float m_pitch = 0.0f; // radians, growing upwards
    float m_distance = 1.0f;
    float m_speed = 1.0f; // world units per second
    float m_verticalFov = 0.8f;
    float m_nearPlane = 0.01f;
};
} // namespace sample
