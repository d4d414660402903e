// One frame as the checks see it. World positions are relative to the frame's own camera: far from the origin, two
// cameras differ by less than a float's last bit.
#pragma once
#include "camera.h"
#include "decode.h"
#include <nrd/doctor.h>
#include <algorithm>
#include <vector>

namespace nrd::doctor
{
class Frame
{
public:
    explicit Frame(const DoctorFrame& input);

    const CommonSettings& common() const { return m_input.common; }
    const DoctorFrame& input() const { return m_input; }
    const Camera& camera() const { return m_camera; }
    int width() const { return m_width; } // of the rectangle; all pixels below are counted from its corner
    int height() const { return m_height; }
    bool contains(int x, int y) const { return x >= 0 && y >= 0 && x < m_width && y < m_height; }

    /// Texel of an image that rectOrigin moves, or does not. The image must be there.
    const float* guide(const float* image, int x, int y) const
    {
        return signal(image, x + common().rectOrigin[0], y + common().rectOrigin[1]);
    }
    const float* signal(const float* image, int x, int y) const
    {
        return image + 4 * (size_t(y) * common().resourceSize[0] + size_t(x));
    }

    double viewZ(int x, int y) const { return double(m_depth[size_t(y) * size_t(m_width) + size_t(x)]); } // positive
    /// Finite, in front of the camera, and within denoisingRange.
    bool isSurface(int x, int y) const
    {
        const double z = viewZ(x, y);
        return z > 0.0 && z <= double(common().denoisingRange);
    }
    /// Where the pixel's sample lies, in [0; 1].
    double sampleU(int x) const { return (x + 0.5 + double(common().cameraJitter[0])) / m_width; }
    double sampleV(int y) const { return (y + 0.5 + double(common().cameraJitter[1])) / m_height; }
    Vec3 position(int x, int y) const { return positionAt(x, y, viewZ(x, y)); }
    Vec3 positionAt(int x, int y, double z) const { return m_camera.unproject(sampleU(x), sampleV(y), z); }

    /// Pixels to neighbours between which depths differ by more than half floats round.
    int reach() const { return std::max(1, m_height / 180); }

    Vec3 normal(int x, int y) const; // unit; needs normalRoughness
    double roughness(int x, int y) const;

    /// Camera of another frame in the world of this one.
    Camera cameraOf(const Frame& other) const;
    /// How far a depth lies outside of those around a point of the screen, as a fraction of it; 0 inside, 1 off screen.
    double depthMismatch(const Camera::Pixel& point) const;

    /// Forgets the images, which live no longer than the call that brought them.
    void dropImages();

private:
    DoctorFrame m_input;
    Camera m_camera;
    int m_width;
    int m_height;
    std::vector<float> m_depth;
};

/// Calls look(x, y) for some thousand surface pixels, spread evenly, with room for neighbours on all sides.
template <class Look> void forSamples(const Frame& frame, Look&& look)
{
    constexpr double kSamples = 12000.0;
    const int step = std::max(1, static_cast<int>(std::sqrt(double(frame.width()) * frame.height() / kSamples)));
    const int margin = frame.reach();
    for (int y = margin; y + margin < frame.height(); y += step)
        for (int x = margin; x + margin < frame.width(); x += step)
            if (frame.isSurface(x, y)) look(x, y);
}
} // namespace nrd::doctor
