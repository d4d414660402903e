// A camera of CommonSettings: between pixels with depth and the world.
#pragma once
#include "vector.h"

namespace nrd::doctor
{
/// Where a rigid world-to-view matrix puts the camera.
Vec3 cameraPosition(const float (&worldToView)[16]);

class Camera
{
public:
    Camera() = default;
    /// `position` in the world that unproject() answers in and project() takes, for example relative to another camera.
    Camera(const float (&viewToClip)[16], const float (&worldToView)[16], const Vec3& position);

    /// `z` is positive in front of the camera; uv (0; 0) is top left.
    Vec3 unproject(double u, double v, double z) const;

    struct Pixel
    {
        double u = 0.0, v = 0.0;
        double z = 0.0; // positive in front of the camera
    };
    Pixel project(const Vec3& world) const;

    Vec3 viewToWorld(const Vec3& direction) const; // z as the matrices have it
    /// From a point of the world to the camera, unit.
    Vec3 toCamera(const Vec3& world) const;
    /// The view depth that the projection turns into this depth-buffer value.
    double viewZOfDepth(double depth) const;
    double zSign() const { return m_zSign; } // of view-space z in front of the camera
    bool isOrthographic() const { return m_clip[11] == 0.0; }
    /// Where the view axis meets the screen, in [-1; 1]: 0 unless the projection is off centre.
    double principalX() const { return isOrthographic() ? m_clip[12] : m_clip[8] / m_clip[11]; }
    double principalY() const { return isOrthographic() ? m_clip[13] : m_clip[9] / m_clip[11]; }

private:
    double m_clip[16] = {}; // viewToClip, column-major
    Vec3 m_rows[3] = {};    // of the rotation to view space
    Vec3 m_position;
    double m_zSign = 1.0;
};
} // namespace nrd::doctor
