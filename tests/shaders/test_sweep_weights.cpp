// Weights of taps over random input.
#include "catch.h"
#include "frames.h"
#include "functions.h"
#include "geometry.h"
#include "sweep.h"
#include "weights.h"

using namespace nrdtest;

namespace
{
float toFloat(double x) { return static_cast<float>(x); }

std::array<double, 4> toArray(const Vec4& v) { return {v[0], v[1], v[2], v[3]}; }

// Apart by far less than a pixel of a normal map up to any angle.
Arguments drawNormals(Random& random)
{
    const Vec3d a = random.direction();
    const Vec3d b = random.oneIn(8) ? a : glm::normalize(a + random.direction() * random.logarithmic(1e-6, 2.0));
    return {toVec4(a), toVec4(b)};
}

// What shaders take for the angle: the chord.
double chord(const Arguments& in)
{
    return glm::distance(glm::normalize(toDouble(in.a)), glm::normalize(toDouble(in.b)));
}

Arguments drawPosition(Random& random) { return {toVec4(random.uniform(-2.0, 16384.0), random.uniform(-2.0, 64.0))}; }

const Sweep kSweeps[] = {
    {"falloffs", "ulp of 1", 6.0, "four products and sums, 2.5 ulp of a division", FN_FALLOFFS,
     [](Random& random) { return Arguments{{toFloat(random.coin() ? random.unit() : random.logarithmic(1e-9, 1e9))}}; },
     [](const Arguments& in, const Results& out)
     {
         const double x = in.a[0];
         return std::max({ulps(out.first[0], soft(x), 1.0), ulps(out.first[1], heavy(x), 1.0),
                          ulps(out.first[2], smooth01(x), 1.0)});
     }},
    {"ramps, also of no width", "ulp of what is subtracted, over the width", 4.0,
     "2.5 ulp of a division, two differences", FN_RAMP,
     [](Random& random)
     {
         const double a = random.uniform(-10.0, 10.0), b = random.oneIn(16) ? a : random.uniform(-10.0, 10.0);
         return Arguments{toVec4(a, b, random.uniform(-12.0, 12.0))};
     },
     [](const Arguments& in, const Results& out)
     {
         const double expected = ramp(in.a[0], in.a[1], in.a[2]), width = std::abs(double{in.a[1]} - in.a[0]);
         return width == 0.0 ? ulps(out.first[0], expected, 1.0)
                             : ulps(out.first[0], expected, std::max(20.0 / width, 1.0));
     }},
    {"angle between two normals", "radians", 8.0 * 0x1p-24, "normals rounded to floats, 4.5 ulp of a root",
     FN_NORMAL_ANGLE, drawNormals,
     [](const Arguments& in, const Results& out) { return std::abs(out.first[0] - chord(in)); }},
    {"bilinear weights", "ulp of 1", 2.0,
     "a position of up to 2 less 0.5, where it is not exact, a difference, a product", FN_FOOTPRINT, drawPosition,
     [](const Arguments& in, const Results& out)
     {
         const std::array<double, 4> expected = bilinearWeights(glm::dvec2(toDouble(in.a)));
         double worst = 0.0;
         for (int i = 0; i < 4; i++) worst = std::max(worst, ulps(out.first[i], expected[i], 1.0));
         return worst;
     }},
    {"Catmull-Rom weights", "ulp of 1", 10.0, "a dozen products and sums, 2.5 ulp of a division",
     FN_CATMULL_ROM_WEIGHTS, drawPosition,
     [](const Arguments& in, const Results& out)
     {
         const CatmullRom expected = catmullRom(glm::dvec2(toDouble(in.a)));
         double worst = ulps(out.second[0], expected.weights[4], 1.0);
         for (int i = 0; i < 4; i++) worst = std::max(worst, ulps(out.first[i], expected.weights[i], 1.0));
         for (int i = 0; i < 2; i++) // the place is as fine as its size allows
             worst = std::max(worst,
                              ulps(out.second[1 + i], expected.middle[i], std::max(std::abs(expected.middle[i]), 1.0)));
         return worst;
     }},
    {"custom bilinear mean, of none too", "ulp of the largest value", 8.0, "7 products and sums, 2.5 ulp of a division",
     FN_CUSTOM_BILINEAR,
     [](Random& random)
     {
         Arguments in;
         for (float& x : in.a) x = toFloat(random.uniform(0.0, 63.0));
         for (float& x : in.b) x = random.coin() ? 0.0f : toFloat(random.logarithmic(1e-6, 1.0));
         return in;
     },
     [](const Arguments& in, const Results& out)
     {
         const std::array<double, 4> weights = toArray(in.b);
         const double sum = weights[0] + weights[1] + weights[2] + weights[3];
         if (std::abs(sum - 1e-4) < 1e-10) return 0.0; // either side of the threshold
         return ulps(out.first[0], customBilinear(toArray(in.a), weights), 63.0);
     }},
    {"weight of a roughness, reprojection", "ulp of 1 at a weight's steepest", 8.0, "ten products and sums over 0.003",
     FN_ROUGHNESS_WEIGHT,
     [](Random& random)
     {
         const double roughness = random.roughness();
         const double other = random.coin() ? saturated(roughness + random.uniform(-0.1, 0.1)) : random.roughness();
         return Arguments{toVec4(roughness, other, random.unit(), 0.003)};
     },
     [](const Arguments& in, const Results& out)
     {
         const double m = double{in.a[0]} * in.a[0], width = lerp(in.a[3], 1.0, lerp(m * m, m, in.a[2]));
         const double steepest = std::max(1.0, 1.5 * std::max(m, double{in.a[1]} * in.a[1]) / width);
         return ulps(out.first[0], roughnessWeight(in.a[0], in.a[1], in.a[2], in.a[3]), steepest);
     }},
    {"confidence of an angle, reprojection", "", 6e-4,
     "1.5 x 1.67 of ten roundings of 2^-24 over the least angle, 0.003", FN_ANGLE_CONFIDENCE,
     [](Random& random)
     {
         Arguments in = drawNormals(random);
         in.c = toVec4(random.coin() ? 0.0 : random.logarithmic(1e-6, 1.0), random.logarithmic(0.75 / 255, 1.5));
         return in;
     },
     [](const Arguments& in, const Results& out)
     { return std::abs(out.first[0] - angleConfidence(chord(in), in.c[0], in.c[1])); }},
    {"weight of a hit distance, RELAX", "ulp of 1", 8.0, "eight products and sums, twice 2.5 ulp of a division",
     FN_HIT_DIST_WEIGHT,
     [](Random& random)
     {
         return Arguments{toVec4(random.oneIn(8) ? 0.0 : random.logarithmic(1e-6, 65504.0),
                                 random.oneIn(8) ? 0.0 : random.logarithmic(1e-6, 65504.0), random.uniform(1.0, 64.0),
                                 0.1)};
     },
     [](const Arguments& in, const Results& out)
     { return ulps(out.first[0], hitDistWeight(in.a[0], in.a[1], in.a[2], in.a[3]), 1.0); }},
    {"stop of a luma", "ulp of 1", 8.0, "3 + 2 x 1 ulp of exp where it is not small, three roundings of its exponent",
     FN_LUMA_STOP,
     [](Random& random)
     {
         const double centre = random.logarithmic(1e-6, 65504.0), width = centre * random.logarithmic(1e-4, 10.0);
         return Arguments{toVec4(centre, random.coin() ? centre : centre + width * random.uniform(-0.1, 10.0),
                                 1.0 / width, random.coin() ? 1e4 : 2.0),
                          toVec4(random.unit())};
     },
     [](const Arguments& in, const Results& out)
     { return ulps(out.first[0], lumaStop(in.a[0], in.a[1], in.a[2], in.a[3], in.b[0]), 1.0); }},
};

StopSettings stopSettingsOf(const nrd::shared::DenoiserConstants& g)
{
    return {g.relaxLobeAngle,        g.relaxLobeAngleSlack,        g.relaxDepthThreshold,    g.roughnessFraction,
            g.relaxEdgeRelaxation.y, g.relaxEdgeRelaxation.x,      g.relaxDoubt.z,           g.relaxDoubt.y,
            g.relaxMaxLumaStop.y,    kNormalFormats[2].angleError, g.relaxRoughnessStop != 0};
}

// a, c = pixel, viewZ, roughness of the centre and of a tap; b, d = their normals; e = frames, confidence, doubt, lobe.
Arguments drawTap(Random& random, const Frames& frames)
{
    const Arguments normals = drawNormals(random);
    Arguments in = drawNeighbours(random, frames);
    in.a[3] = random.roughness();
    in.b = normals.a;
    in.c[3] = random.coin() ? in.a[3] : random.roughness();
    in.d = normals.b;
    in.e = toVec4(random.below(256) * 0.25, random.unit(), random.coin() ? 0.0 : random.unit(), random.below(2));
    return in;
}

// In roundings at the weight's steepest, which is 1.5 times the sum of what differences are multiplied by.
double tapError(const Frames& frames, const Arguments& in, const Results& out)
{
    const size_t frame = frameOf(in);
    const nrd::shared::DenoiserConstants& g = frames.constants[frame];
    const bool isSpecular = in.e[3] != 0.0f;
    const EdgeStops stops = edgeStops(stopSettingsOf(g), {in.a[2], in.a[3], in.e[0], in.e[1], in.e[2], isSpecular, 0});
    const Vec3d X = viewOfPixel(frames, frame, in.a), other = viewOfPixel(frames, frame, in.c);
    const Vec3d N = frames.now[frame].worldToView * toDouble(in.b);
    const double seen = glm::distance(glm::normalize(X), glm::normalize(other + double{g.relaxViewRelaxation} * X));
    const double angle = isSpecular ? std::max(chord({in.b, in.d}), seen) : chord({in.b, in.d});
    const double difference = std::abs(double{in.a[3]} - in.c[3]);
    const double expected = edgeWeight(stops, planeDistance(N, X, other), angle, difference);
    const double direction = 1.0 + glm::length(toDouble(g.frustum));
    const double steepest = 1.5 * (sizeOf(frames, in) * stops.plane + direction * stops.normal + stops.roughness + 2.0);
    return std::abs(out.first[0] - expected) / (steepest * 0x1p-24);
}
} // namespace

TEST_CASE("weights over random input agree with double precision", "[gpu][sweep]")
{
    for (const Sweep& sweep : kSweeps) check(sweep);
}

TEST_CASE("the wavelet's stops and weights over random input agree with double precision", "[gpu][sweep]")
{
    const Frames frames = drawFrames({}, MotionKind::Screen);
    const auto settings = [&](const Arguments& in) { return stopSettingsOf(frames.constants[frameOf(in)]); };
    const auto drawStops = [](Random& random)
    {
        Arguments in = {
            toVec4(random.logarithmic(1e-3, 1e6), random.roughness(), random.below(256) * 0.25, random.unit())};
        in.b = toVec4(random.coin() ? 0.0 : random.unit(), random.below(2), random.below(5));
        in.h[3] = toFloat(random.below(1024));
        return in;
    };
    const auto stopError = [&](const Arguments& in, const Results& out)
    {
        const bool isSpecular = in.b[1] != 0.0f;
        const EdgeStops s = edgeStops(
            settings(in), {in.a[0], in.a[1], in.a[2], in.a[3], in.b[0], isSpecular, static_cast<int>(in.b[2])});
        return std::max({ulps(out.first[0], s.normal), ulps(out.first[1], s.roughness), ulps(out.first[2], s.plane),
                         ulps(out.second[0], s.relax, 1.0)});
    };
    check({"stops of the wavelet", "ulp", 4096.0, "an arc tangent", FN_EDGE_STOPS, drawStops, stopError},
          frames.constants);
    check({"weights of the wavelet's taps", "roundings of depth, normal and roughness at their steepest", 24.0,
           "two positions of three, a normal of three, a dot product of three, an arc tangent", FN_EDGE_WEIGHT,
           [&](Random& random) { return drawTap(random, frames); },
           [&](const Arguments& in, const Results& out) { return tapError(frames, in, out); }},
          frames.constants);
    check({"least angle between normals that differ, blur", "ulp", 4096.0, "an arc tangent", FN_NORMAL_CUTOFF,
           [](Random& random)
           {
               Arguments in = {toVec4(random.roughness(), random.unit())};
               in.h[3] = toFloat(random.below(1024));
               return in;
           },
           [&](const Arguments& in, const Results& out)
           {
               const double fraction = frames.constants[frameOf(in)].lobeAngleFraction;
               const double share = 0.75 * lerp(fraction, 1.0, in.a[1]);
               return ulps(out.first[0], normalCutoff(in.a[0], share, kNormalFormats[2].angleError));
           }},
          frames.constants);
}
