#include "camera.h"

namespace nrd::doctor
{
namespace
{
Vec3 row(const float (&m)[16], int i) { return {double(m[i]), double(m[4 + i]), double(m[8 + i])}; }
} // namespace

Vec3 cameraPosition(const float (&worldToView)[16])
{
    const Vec3 t = toVec3(worldToView + 12);
    return -(row(worldToView, 0) * t.x + row(worldToView, 1) * t.y + row(worldToView, 2) * t.z);
}

Camera::Camera(const float (&viewToClip)[16], const float (&worldToView)[16], const Vec3& position)
    : m_position(position)
{
    for (int i = 0; i < 16; i++) m_clip[i] = double(viewToClip[i]);
    for (int i = 0; i < 3; i++) m_rows[i] = row(worldToView, i);
    if (!isOrthographic())
        m_zSign = m_clip[11] > 0.0 ? 1.0 : -1.0;
    else // the middle of the depth range lies in front of the camera
        m_zSign = (0.5 * m_clip[15] - m_clip[14]) / m_clip[10] < 0.0 ? -1.0 : 1.0;
}

Vec3 Camera::unproject(double u, double v, double z) const
{
    const double viewZ = m_zSign * z;
    const double w = m_clip[11] * viewZ + m_clip[15];
    const double x = ((2.0 * u - 1.0) * w - m_clip[8] * viewZ - m_clip[12]) / m_clip[0];
    const double y = ((1.0 - 2.0 * v) * w - m_clip[9] * viewZ - m_clip[13]) / m_clip[5];
    return viewToWorld({x, y, viewZ}) + m_position;
}

Camera::Pixel Camera::project(const Vec3& world) const
{
    const Vec3 p = world - m_position;
    const Vec3 view = {dot(m_rows[0], p), dot(m_rows[1], p), dot(m_rows[2], p)};
    const double w = m_clip[11] * view.z + m_clip[15];
    const double x = (m_clip[0] * view.x + m_clip[8] * view.z + m_clip[12]) / w;
    const double y = (m_clip[5] * view.y + m_clip[9] * view.z + m_clip[13]) / w;
    return {0.5 + 0.5 * x, 0.5 - 0.5 * y, m_zSign * view.z};
}

Vec3 Camera::viewToWorld(const Vec3& direction) const
{
    return m_rows[0] * direction.x + m_rows[1] * direction.y + m_rows[2] * direction.z;
}

Vec3 Camera::toCamera(const Vec3& world) const
{
    return isOrthographic() ? m_rows[2] * -m_zSign : normalize(m_position - world);
}

double Camera::viewZOfDepth(double depth) const
{
    // depth * w = m[10] z + m[14], with w = m[11] z + m[15]
    return m_zSign * (m_clip[14] - depth * m_clip[15]) / (depth * m_clip[11] - m_clip[10]);
}
} // namespace nrd::doctor
