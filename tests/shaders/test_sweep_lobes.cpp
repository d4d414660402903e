// Directions and widths of lobes over random input.
#include "catch.h"
#include "functions.h"
#include "lobes.h"
#include "sweep.h"

using namespace nrdtest;

namespace
{
// In front of the surface, one in four within a degree of its plane.
Vec3d drawView(Random& random, const Vec3d& N)
{
    Vec3d V = random.normal();
    if (random.oneIn(4)) V = glm::normalize(V - N * glm::dot(V, N) * (1.0 - random.logarithmic(1e-7, 1e-2)));
    return Vec3d(glm::vec3(glm::dot(N, V) < 0.0 ? -V : V));
}

Arguments drawDirection(Random& random)
{
    const Vec3d N = random.normal();
    return {toVec4(N, random.roughness()), toVec4(drawView(random, N))};
}

// Behind the surface too; normals of any length and none, as a texel of zeros is decoded.
Arguments drawAnyDirection(Random& random)
{
    const Vec3d N = random.normal(), V = random.oneIn(8) ? (random.coin() ? N : -N) : random.normal();
    const double length = random.oneIn(8) ? 0.0 : random.oneIn(4) ? random.logarithmic(1e-3, 1e3) : 1.0;
    return {toVec4(N * length, random.roughness()), toVec4(V)};
}

double directionError(const Vec3d& N, const Vec3d& V, double roughness, const Vec4& out)
{
    return angleBetween(toDouble(out), dominantDirection(N, V, roughness));
}

// Of a lobe record: a = luma; b = its vector, up to a little longer than the luma.
Arguments drawRecord(Random& random)
{
    const double luma = random.oneIn(16) ? 0.0 : random.logarithmic(1e-4, 65504.0);
    return {toVec4(luma, 0.0, 0.0, 0.5), toVec4(random.normal() * luma * random.uniform(0.0, 1.01))};
}

// Three roundings of half an ulp of 39 in a logarithm's argument of 0.41, times 0.3: 4.2e-6; its own 2^-21 times 0.3.
constexpr double kFactorBound = 4.5e-6, kDirectionBound = kFactorBound + 12 * 0x1p-24;
const char* const kFactorReason = "39.4 - 39.0 r, rounded, in a logarithm, and 2^-21 of that";
const char* const kDirectionReason = "the factor's error, and twelve roundings";

const Sweep kSweeps[] = {
    {"how far a lobe leans to the mirror direction", "", kFactorBound, kFactorReason, FN_DOMINANT_FACTOR,
     [](Random& random)
     {
         return Arguments{
             {static_cast<float>(random.coin() ? random.unit() : random.logarithmic(1e-9, 1.0)), random.roughness()}};
     },
     [](const Arguments& in, const Results& out) { return std::abs(out.first[0] - dominantFactor(in.a[0], in.a[1])); }},
    {"dominant direction, passes", "radians", kDirectionBound, kDirectionReason, FN_DOMINANT_DIRECTION, drawDirection,
     [](const Arguments& in, const Results& out)
     { return directionError(toDouble(in.a), toDouble(in.b), in.a[3], out.first); }},
    {"dominant direction, front end", "radians", kDirectionBound, kDirectionReason, FN_DOMINANT,
     [](Random& random)
     {
         const Arguments drawn = drawDirection(random);
         Arguments in;
         in.c = drawn.a;
         in.d = drawn.b;
         return in;
     },
     [](const Arguments& in, const Results& out)
     { return directionError(toDouble(in.c), toDouble(in.d), in.c[3], out.first); }},
    {"dominant direction of any normal and view, off unit length", "", 8.0 * 0x1p-24, "2 ulp of a root, three products",
     FN_DOMINANT_DIRECTION, drawAnyDirection,
     [](const Arguments&, const Results& out) { return std::abs(glm::length(toDouble(out.first)) - 1.0); }},
    {"tangent of a lobe's half angle", "ulp", 8.0, "2.5 ulp of a division, 4.5 of a root, one product", FN_LOBE_TANGENT,
     [](Random& random) {
         return Arguments{{random.roughness(), static_cast<float>(random.oneIn(8) ? 1.0 : random.unit())}};
     },
     [](const Arguments& in, const Results& out)
     {
         // 1 - share + 1e-6 is rounded to steps of 2^-24 where the share is more than half.
         const double rounding = 0x1p-25 / (1.0 - in.a[1] + 1e-6), expected = lobeTangent(in.a[0], in.a[1]);
         return ulps(out.first[0], expected, expected * (1.0 + rounding * 0x1p22));
     }},
    {"measured sharpness of a lobe", "ulp", 3500.0,
     "7 ulp of a root and a division in a cosine of 0.999, where 1 - mu^2 is 1 / 500", FN_UNPACK_SH, drawRecord,
     [](const Arguments& in, const Results& out)
     {
         return ulps(out.second[3], measuredSharpness(in.a[0], toDouble(in.b)),
                     2.0 + measuredSharpness(in.a[0], toDouble(in.b)));
     }},
    {"extracted direction of a lobe", "radians", 4.0 * 0x1p-24,
     "2 ulp of a root act on the length, a product on each axis", FN_EXTRACT, drawRecord,
     [](const Arguments& in, const Results& out)
     {
         const Vec3d expected = toDouble(in.b), got = toDouble(out.second);
         return glm::length(expected) < 1e-14 ? glm::length(got) : angleBetween(got, expected);
     }},
    {"tangent basis, off orthonormal", "", 6.0 * 0x1p-24, "four roundings of up to 2", FN_TANGENT_BASIS,
     [](Random& random) { return Arguments{toVec4(random.normal())}; },
     [](const Arguments& in, const Results& out)
     {
         // The axis itself is only as long as floats have it.
         const Vec3d N = glm::normalize(toDouble(in.a)), T = toDouble(out.first), B = toDouble(out.second);
         return std::max({std::abs(glm::dot(T, N)), std::abs(glm::dot(B, N)), std::abs(glm::dot(T, B)),
                          std::abs(glm::length(T) - 1.0), std::abs(glm::length(B) - 1.0)});
     }},
};
} // namespace

TEST_CASE("lobes over random input agree with double precision", "[gpu][sweep]")
{
    for (const Sweep& sweep : kSweeps) check(sweep);
}
