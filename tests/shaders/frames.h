// Pairs of cameras at random, as an application describes them and as the constants of a pass have them.
#pragma once
#include "denoiser_constants.h"
#include "random.h"
#include "reprojection.h"
#include <vector>

namespace nrdtest
{
// What the application's single-precision matrices are made of.
struct TrueCamera
{
    glm::dmat3 worldToView; // left-handed
    Vec3d position;
    glm::dvec2 scale; // of the projection
    bool isOrtho;

    Vec3d viewOf(const Vec3d& world) const { return worldToView * (world - position); }
    Vec3d rayOf(const glm::dvec2& uv) const // view space, at depth 1
    {
        return {(2.0 * uv.x - 1.0) / scale.x, (1.0 - 2.0 * uv.y) / scale.y, 1.0};
    }
    glm::dvec2 uvOf(const Vec3d& view) const
    {
        const double w = isOrtho ? 1.0 : view.z;
        return {0.5 + 0.5 * scale.x * view.x / w, 0.5 - 0.5 * scale.y * view.y / w};
    }
};

struct Frames
{
    std::vector<nrd::shared::DenoiserConstants> constants;
    std::vector<TrueCamera> now, before;
};

struct FrameRange
{
    double minFov = 1.0, maxFov = 170.0; // degrees, of the larger axis
    int maxSize = 16384;                 // pixels
    bool hasOrtho = false;
};

// Up to 1e6 units from the origin, one in four static, else up to 1e3 units and 90 degrees per frame.
Frames drawFrames(const FrameRange& range, MotionKind motion);

inline size_t frameOf(const Arguments& in) { return static_cast<size_t>(in.h[3]); }

// a, c = pixel and viewZ of a pixel and of one nearby, at the same depth or another.
Arguments drawNeighbours(Random& random, const Frames& frames);

// View space, of (pixel, viewZ).
double extentScale(const Frames& frames, size_t frame, double viewZ); // of the frustum at a depth
Vec3d viewOfPixel(const Frames& frames, size_t frame, const Vec4& pixel);

// Lengths that the positions of two pixels are sums of.
double sizeOf(const Frames& frames, const Arguments& neighbours);

ReprojectionFrame reprojectionOf(const nrd::shared::DenoiserConstants& g);
glm::dvec4 toDouble(const nrd::shared::vec4& v);
glm::dmat4 toDouble(const nrd::shared::mat4& m);
} // namespace nrdtest
