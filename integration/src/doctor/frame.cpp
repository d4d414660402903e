#include "frame.h"
#include <algorithm>

namespace nrd::doctor
{
Frame::Frame(const DoctorFrame& input)
    : m_input(input), m_camera(input.common.viewToClipMatrix, input.common.worldToViewMatrix, {}),
      m_width(input.common.rectSize[0]), m_height(input.common.rectSize[1])
{
    m_depth.reserve(size_t(m_width) * size_t(m_height));
    for (int y = 0; y < m_height; y++)
        for (int x = 0; x < m_width; x++)
            m_depth.push_back(std::abs(*guide(m_input.viewZ, x, y) * m_input.common.viewZScale));
}

Vec3 Frame::normal(int x, int y) const
{
    return normalize(decodeNormal(guide(m_input.normalRoughness, x, y), m_input.normalEncoding));
}

double Frame::roughness(int x, int y) const
{
    return decodeRoughness(guide(m_input.normalRoughness, x, y), m_input.normalEncoding, m_input.roughnessEncoding);
}

Camera Frame::cameraOf(const Frame& other) const
{
    const Vec3 delta = cameraPosition(other.common().worldToViewMatrix) - cameraPosition(common().worldToViewMatrix);
    return {other.common().viewToClipMatrix, other.common().worldToViewMatrix, delta};
}

double Frame::depthMismatch(const Camera::Pixel& point) const
{
    const double x = point.u * m_width - 0.5 - double(common().cameraJitter[0]);
    const double y = point.v * m_height - 0.5 - double(common().cameraJitter[1]);
    if (!(x >= 0.0 && y >= 0.0 && x < m_width - 1 && y < m_height - 1)) return 1.0;
    const int left = static_cast<int>(x), top = static_cast<int>(y);
    double nearest = viewZ(left, top), farthest = nearest;
    for (int i = 1; i < 4; i++)
    {
        const double z = viewZ(left + i % 2, top + i / 2);
        nearest = std::min(nearest, z);
        farthest = std::max(farthest, z);
    }
    const double outside = std::max({nearest - point.z, point.z - farthest, 0.0});
    return std::isfinite(outside) ? std::min(outside / std::max(point.z, 1e-30), 1.0) : 1.0;
}

void Frame::dropImages()
{
    DoctorFrame rest;
    rest.common = m_input.common;
    m_input = rest;
}
} // namespace nrd::doctor
