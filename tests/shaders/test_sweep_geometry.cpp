// Positions, planes and depths over random input.
#include "catch.h"
#include "frames.h"
#include "functions.h"
#include "geometry.h"
#include "sweep.h"

using namespace nrdtest;

namespace
{
float toFloat(double x) { return static_cast<float>(x); }

const Sweep kSweeps[] = {
    {"view position of a pixel", "ulp of the frustum's slope times depth", 2.0, "a product, a sum, a product",
     FN_RECONSTRUCT,
     [](Random& random)
     {
         const double slope = std::tan(random.uniform(0.5, 85.0) * kPi / 180.0),
                      y = slope * random.logarithmic(0.1, 10.0);
         return Arguments{toVec4(random.unit(), random.unit(), random.logarithmic(1e-3, 1e6), random.oneIn(4)),
                          toVec4(-slope, y, 2.0 * slope, -2.0 * y)};
     },
     [](const Arguments& in, const Results& out)
     {
         const glm::dvec4 frustum(in.b[0], in.b[1], in.b[2], in.b[3]);
         const Vec3d expected = viewPosition({in.a[0], in.a[1]}, frustum, in.a[2], in.a[3] != 0.0f);
         const double depth = in.a[3] != 0.0f ? 1.0 : double{in.a[2]};
         return std::max({ulps(out.first[0], expected.x, frustum.z * depth),
                          ulps(out.first[1], expected.y, frustum.w * depth), ulps(out.first[2], expected.z)});
     }},
    {"coordinate folded at the screen's borders", "ulp of the coordinate", 2.0, "three sums", FN_MIRROR_UV,
     [](Random& random) { return Arguments{toVec4(random.uniform(-1.0, 2.0), random.uniform(-100.0, 100.0))}; },
     [](const Arguments& in, const Results& out)
     {
         const glm::dvec2 expected = mirroredUv({in.a[0], in.a[1]});
         if (!(out.first[0] >= 0.0f && out.first[0] < 1.0f)) return 1e9;
         return std::max(ulps(out.first[0], expected.x, std::max(std::abs(double{in.a[0]}), 1.0)),
                         ulps(out.first[1], expected.y, std::max(std::abs(double{in.a[1]}), 1.0)));
     }},
    {"curvature of an edge", "ulp of positions and normals over the edge", 8.0,
     "differences of positions, six products and sums, 2.5 ulp of a division", FN_CURVATURE,
     [](Random& random)
     {
         const Vec3d X = random.direction() * random.logarithmic(1e-2, 1e5), N = random.normal();
         const double step = glm::length(X) * random.logarithmic(1e-4, 1e-1);
         const Vec3d otherN = glm::normalize(N + random.direction() * random.logarithmic(1e-4, 1.0));
         return Arguments{toVec4(X), toVec4(N), toVec4(X + random.direction() * step), toVec4(otherN)};
     },
     [](const Arguments& in, const Results& out)
     {
         const Vec3d X = toDouble(in.a), N = toDouble(in.b), otherX = toDouble(in.c), otherN = toDouble(in.d);
         return ulps(out.first[0], curvature(X, N, otherX, otherN), 2.0 / glm::distance(X, otherX));
     }},
    {"allowed depth of a disocclusion test", "ulp", 5.0, "2.5 ulp of a division and another, a mix, a product",
     FN_DISOCCLUSION,
     [](Random& random)
     {
         const double NoV = random.coin() ? random.unit() : random.logarithmic(1e-7, 1.0);
         return Arguments{toVec4(NoV, random.logarithmic(1e-5, 1e7),
                                 random.oneIn(8) ? 0.0 : random.logarithmic(1e-4, 1.0),
                                 random.coin() ? 0.0 : random.logarithmic(1e-3, 1e3))};
     },
     [](const Arguments& in, const Results& out)
     { return ulps(out.first[0], disocclusionDistance(in.a[0], in.a[1], in.a[2], in.a[3])); }},
};

// A code's range of depths and its width, see depth_code.glsl.
constexpr double kNearestCode = 0x1p-14, kFarthestCode = 0x1p20, kCodeWidth = 3.6e-4;

// 0 if the decision is right: what lies within the threshold passes, what misses it by a code's width does not. Depths
// closer to the threshold than the test is rounded may be refused.
double depthTestError(const Arguments& in, const Results& out)
{
    const double expected = in.b[0], threshold = in.b[1];
    const auto coded = [](double x) { return std::clamp(x, kNearestCode, kFarthestCode); };
    const double low = coded(expected - threshold), high = coded(expected + threshold);
    double worst = 0.0;
    for (int i = 0; i < 4; i++)
    {
        const bool isThere = threshold >= 0.0 && std::abs(double{in.a[i]}) < 1e7; // NaN is not
        const double depth = coded(std::max(std::abs(double{in.a[i]}), 1e-4));    // as decodeViewZ() reads it
        if (out.first[i] == 0.0f)
        {
            if (isThere && depth >= low && depth <= high)
                worst = std::max(worst, ulps(std::min(depth - low, high - depth), 0.0, depth));
        }
        else if (!isThere || depth < low * (1.0 - kCodeWidth) || depth > high * (1.0 + kCodeWidth))
            worst = 1e9;
    }
    return worst;
}

double planeError(const Frames& frames, const Arguments& in, const Results& out)
{
    const size_t frame = frameOf(in);
    const nrd::shared::DenoiserConstants& g = frames.constants[frame];
    const TrueCamera& camera = frames.now[frame];
    const Vec3d N = camera.worldToView * toDouble(in.b);
    const double distance = planeDistance(N, viewOfPixel(frames, frame, in.a), viewOfPixel(frames, frame, in.c));
    const double height = 2.0 / camera.scale.y * extentScale(frames, frame, in.a[2]), size = sizeOf(frames, in);
    const double frustumSize = height * std::min(g.rectSize.x, g.rectSize.y) / g.rectSize.y;
    const double scale = 1.0 / (0.02 * frustumSize);
    return std::max({std::abs(out.first[0] - distance * scale) / (size * scale),
                     std::abs(out.first[1] - distance) / size, std::abs(out.first[2] - frustumSize) / frustumSize}) /
           0x1p-24;
}
} // namespace

TEST_CASE("geometry over random input agrees with double precision", "[gpu][sweep]")
{
    for (const Sweep& sweep : kSweeps) check(sweep);
}

TEST_CASE("planes and depths over random cameras agree with double precision", "[gpu][sweep]")
{
    const Frames frames = drawFrames({.hasOrtho = true}, MotionKind::World);
    const auto drawDepths = [](Random& random)
    {
        const double expected = random.logarithmic(1e-3, 1e6), threshold = expected * random.logarithmic(1e-4, 1.0);
        Arguments in = {{}, toVec4(expected, random.oneIn(8) ? -1e-6 : threshold)};
        for (float& x : in.a)
            x = random.oneIn(8) ? random.anything(1e-3, 1e8)
                                : toFloat(expected + threshold * random.uniform(-2.0, 2.0));
        in.h[3] = toFloat(random.below(1024));
        return in;
    };
    check({"plane distances of REBLUR and RELAX", "roundings of the distance and the frustum's size", 16.0,
           "a normal by a rounded matrix, two positions of three roundings each, a division, a dot product",
           FN_PLANE_DISTANCE,
           [&](Random& random)
           {
               Arguments in = drawNeighbours(random, frames);
               in.b = toVec4(random.normal());
               return in;
           },
           [&](const Arguments& in, const Results& out) { return planeError(frames, in, out); }},
          frames.constants);
    check({"depths a disocclusion test refuses wrongly", "ulp of the depth from the threshold at most", 24.0,
           "a sum, and the code's rounding, of a logarithm of some ulp", FN_DEPTH_TEST, drawDepths, depthTestError},
          frames.constants);
}
