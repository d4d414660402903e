// Packing of signals and guides over random input.
#include "catch.h"
#include "functions.h"
#include "sweep.h"

using namespace nrdtest;

namespace
{
Vec4d toVec4d(const Vec4& v) { return {v[0], v[1], v[2], v[3]}; }

double largest(const Vec3d& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

float anySignal(Random& random, bool isSanitized)
{
    // Unsanitised: what the front end is documented to take, and what overflows nothing.
    return isSanitized ? random.anything(1e-8, 1e6) : static_cast<float>(random.logarithmic(1e-8, 65504.0));
}

// a = radiance, hit distance; b = direction, sanitise.
Arguments drawSample(Random& random)
{
    const bool isSanitized = !random.oneIn(4);
    Arguments in;
    for (float& x : in.a) x = anySignal(random, isSanitized);
    in.b = toVec4(random.normal() * (random.oneIn(4) ? random.unit() : 1.0), isSanitized);
    if (isSanitized && random.oneIn(8)) in.b[random.below(3)] = random.anything(1e-8, 1e6);
    return in;
}

Arguments drawPacked(Random& random) // b.x sanitise
{
    Arguments in = drawSample(random);
    in.b[0] = in.b[3];
    return in;
}

Arguments drawDirectional(Random& random)
{
    const Arguments in = drawSample(random);
    return {{in.b[0], in.b[1], in.b[2], in.a[3]}, {in.b[3], 0, 0, 0}};
}

// What rounding is relative to: the largest radiance after sanitising.
double radianceOf(const Arguments& in) { return largest(Vec3d(packRelax(toVec4d(in.a), in.b[3] != 0.0f))); }

double packedShError(const Arguments& in, const Results& out, const Vec4d& sh0, double luma)
{
    const bool isSanitized = in.b[3] != 0.0f;
    const double magnitude = radianceOf(in);
    const Vec3d sh1 = packDirection(toDouble(in.b), luma, isSanitized);
    const double valueError = std::max(ulps(out.first, sh0, magnitude, 3), ulps(out.first[3], sh0.w));
    return std::max(valueError, ulps(out.second, Vec4d(sh1, 0.0), magnitude, 4));
}

// From 1e-12 to 1e12 long, or zero.
Arguments drawNormal(Random& random)
{
    Arguments in;
    const int encoding = random.below(5);
    const double length = random.coin() ? 1.0 : random.oneIn(8) ? 0.0 : random.logarithmic(1e-12, 1e12);
    in.a = toVec4(random.normal() * length, random.roughness());
    in.b = toVec4(random.below(4), encoding, random.below(3));
    const NormalFormat& format = kNormalFormats[encoding];
    in.c = toVec4(format.steps, format.materialSteps, format.isSigned);
    if (encoding != 2) in.c[1] = in.c[0];
    return in;
}

Vec4d packedNormal(const Arguments& in)
{
    return packNormal(toDouble(in.a), in.a[3], in.b[0], static_cast<int>(in.b[1]), static_cast<int>(in.b[2]));
}

// Of the error that shaders allow for in the guide's format.
double storedAngleError(const Arguments& in, const Results& out)
{
    const Vec3d normal = toDouble(in.a);
    if (normal == Vec3d(0.0)) return std::isfinite(out.first[0] + out.first[1] + out.first[2]) ? 0.0 : 1e9;
    return angleBetween(normal, toDouble(out.first)) / kNormalFormats[static_cast<int>(in.b[1])].angleError;
}

// In the stored domain, where steps are equal.
double storedRoughnessError(const Arguments& in, const Results& out)
{
    const bool isTenBit = in.b[1] == 2.0f;
    if (isTenBit && out.second[0] != in.b[0]) return 1e9; // the material
    const int encoding = static_cast<int>(in.b[2]);
    const double least = isTenBit ? 1.5 / 512.0 : 0.0, steps = isTenBit ? 1023.0 / 2.0 : double{in.c[0]};
    return std::abs(encodeRoughness(out.first[3], encoding) - std::max(encodeRoughness(in.a[3], encoding), least)) *
           steps;
}

// Texels that storing packed normals gives, and zero.
Arguments drawTexel(Random& random)
{
    const Arguments normal = drawNormal(random);
    Arguments in = {{}, normal.b};
    const Vec4d packed = packedNormal(normal);
    if (random.oneIn(64)) return in;
    for (int i = 0; i < 4; i++)
        in.a[i] = static_cast<float>(
            quantized(packed[i], i < 3 ? double{normal.c[0]} : double{normal.c[1]}, normal.c[2] != 0.0f));
    return in;
}

Vec3d storedVector(const Arguments& in)
{
    if (in.b[1] == 2.0f) return Vec3d(1.0);
    return kNormalFormats[static_cast<int>(in.b[1])].isSigned ? toDouble(in.a) : 2.0 * toDouble(in.a) - 1.0;
}

double unpackedAngle(const Arguments& in, const Results& out)
{
    const Vec4d expected = unpackNormal(toVec4d(in.a), static_cast<int>(in.b[1]), static_cast<int>(in.b[2]));
    const Vec3d got = toDouble(out.first);
    // Of no normal: none has a length below 1, on the cube or on the diamond's 3^-1/2.
    if (glm::length(storedVector(in)) < 0.5) return std::max(glm::length(got) - 1.0, 0.0);
    return angleBetween(got, Vec3d(expected)) + std::abs(glm::length(got) - 1.0);
}

const Sweep kSweeps[] = {
    {"RGB to YCoCg", "ulp of the largest channel", 1.0, "two sums of half an ulp", FN_YCOCG,
     [](Random& random) {
         return Arguments{{anySignal(random, false), anySignal(random, false), anySignal(random, false)}};
     },
     [](const Arguments& in, const Results& out)
     { return ulps(out.first, Vec4d(toYCoCg(toDouble(in.a)), 0.0), largest(toDouble(in.a)), 3); }},
    {"YCoCg to RGB, never negative", "ulp of the sum of magnitudes", 1.0, "two sums of half an ulp", FN_FROM_YCOCG,
     [](Random& random) {
         return Arguments{{random.signal(1e-8, 1e5), random.signal(1e-8, 1e5), random.signal(1e-8, 1e5)}};
     },
     [](const Arguments& in, const Results& out)
     {
         const Vec3d c = toDouble(in.a);
         if (std::min({out.first[0], out.first[1], out.first[2]}) < 0.0f) return 1e9;
         return ulps(out.first, Vec4d(fromYCoCg(c), 0.0), std::abs(c.x) + std::abs(c.y) + std::abs(c.z), 3);
     }},
    {"REBLUR's packed radiance and hit distance, of anything", "ulp of the largest channel", 1.0,
     "two sums of half an ulp; the hit distance exact", FN_PACK_RADIANCE, drawPacked,
     [](const Arguments& in, const Results& out)
     {
         const Vec4d expected = packReblur(toVec4d(in.a), in.b[0] != 0.0f);
         Arguments sample = in;
         sample.b[3] = in.b[0];
         if (ulps(out.first[3], expected.w) > 0.0) return 1e9;
         return ulps(out.first, expected, radianceOf(sample), 3);
     }},
    {"RELAX's packed radiance and hit distance, of anything", "ulp", 0.0, "copied or clamped", FN_PACK_RELAX,
     drawPacked,
     [](const Arguments& in, const Results& out)
     {
         const Vec4d expected = packRelax(toVec4d(in.a), in.b[0] != 0.0f);
         return std::max(ulps(out.first, expected, largest(Vec3d(expected)), 3), ulps(out.first[3], expected.w));
     }},
    {"REBLUR's packed SH, of anything", "ulp of the largest channel", 1.5, "luma, and one product", FN_PACK_SH,
     drawSample,
     [](const Arguments& in, const Results& out)
     {
         const Vec4d sh0 = packReblur(toVec4d(in.a), in.b[3] != 0.0f);
         return packedShError(in, out, sh0, sh0.x);
     }},
    {"RELAX's packed SH, of anything", "ulp of the largest channel", 1.5, "luma, and one product", FN_PACK_RELAX_SH,
     drawSample,
     [](const Arguments& in, const Results& out)
     {
         const Vec4d sh0 = packRelax(toVec4d(in.a), in.b[3] != 0.0f);
         return packedShError(in, out, sh0, toYCoCg(Vec3d(sh0)).x);
     }},
    {"packed directional occlusion, of anything", "ulp", 0.5, "one product", FN_PACK_DIRECTIONAL, drawDirectional,
     [](const Arguments& in, const Results& out)
     {
         const Vec4d expected = packDirectional(toDouble(in.a), in.a[3], in.b[0] != 0.0f);
         double worst = 0.0;
         for (int i = 0; i < 4; i++) worst = std::max(worst, ulps(out.first[i], expected[i]));
         return worst;
     }},
    {"radiance as RELAX reads it, of anything", "ulp of the largest channel", 1.0, "two sums of half an ulp",
     FN_SANITIZE, drawSample,
     [](const Arguments& in, const Results& out)
     {
         const Vec4d expected = sanitizedInput(toVec4d(in.a));
         return ulps(out.first, expected, std::max(largest(glm::clamp(toDouble(in.a), 0.0, 65504.0)), expected.w), 4);
     }},
    {"axes as they are read, of anything", "ulp of the luma and the axis", 8.0,
     "a dot product under a root of 2 ulp, two products", FN_SANITIZE, drawSample,
     [](const Arguments& in, const Results& out)
     {
         const Vec3d expected = sanitizedAxis(toDouble(in.b), out.first[0]);
         return ulps(out.second, Vec4d(expected, 0.0), glm::length(expected), 3);
     }},
    {"rounding to half floats, of anything finite", "ulp of a float", 0.0, "exact", FN_ROUND_TO_HALF,
     [](Random& random) {
         return Arguments{{random.signal(1e-9, 1e6), random.signal(1e-6, 1e-4)}};
     },
     [](const Arguments& in, const Results& out)
     { return std::max(ulps(out.first[0], nearestHalf(in.a[0])), ulps(out.first[1], nearestHalf(in.a[1]))); }},
    {"packed normals and roughness before they are stored", "of a step of 16 bits", 0.02,
     "2.5 ulp of a division, 4.5 of a root, half a one of a sum, 2^-24 each", FN_PACK_NORMAL, drawNormal,
     [](const Arguments& in, const Results& out)
     { return ulps(out.first, packedNormal(in), 0.5, 4) * 65535.0 * 0x1p-24; }},
    {"stored normals, five formats", "of the error that shaders allow for", 1.0, "normalEncodingError()",
     FN_NORMAL_ROUND_TRIP, drawNormal, storedAngleError},
    {"stored roughness, and material, five formats, three encodings", "steps", 0.55,
     "half a step, and ten roundings of 2^-24 in steps of 16 bits", FN_NORMAL_ROUND_TRIP, drawNormal,
     storedRoughnessError},
    {"unpacked normals, off their direction and length", "radians", 10.0 * 0x1p-24,
     "three roundings on a diamond that is 3^-1/2 near, 2 ulp of a root, one product", FN_UNPACK_NORMAL, drawTexel,
     unpackedAngle},
};
} // namespace

TEST_CASE("packing over random input, ugly and not, agrees with double precision", "[gpu][sweep]")
{
    for (const Sweep& sweep : kSweeps) check(sweep);
}
