// What the front end packs and the back end unpacks, and what storing does to it.
#pragma once
#include "vectors.h"

namespace nrdtest
{
using Vec4d = glm::dvec4;

Vec3d toYCoCg(const Vec3d& rgb);
Vec3d fromYCoCg(const Vec3d& yCoCg);

// (radiance, hit distance). sanitize: what is not finite becomes no sample, the rest fits half floats.
Vec4d packReblur(const Vec4d& signal, bool sanitize); // normalised hit distance
Vec4d packRelax(const Vec4d& signal, bool sanitize);  // world units
Vec4d packDirectional(const Vec3d& direction, double normHitDist, bool sanitize);

// SH1 of either family.
Vec3d packDirection(const Vec3d& direction, double luma, bool sanitize);

// Of what an application hands to RELAX, however it was packed: what is not finite is no sample.
Vec4d sanitizedInput(const Vec4d& signal);
Vec3d sanitizedAxis(const Vec3d& sh1, double luma); // no longer than the luma

// A guide's format, index is NormalEncoding.
struct NormalFormat
{
    const char* name;
    double steps; // of a channel's positive range
    double materialSteps;
    bool isSigned;
    double angleError; // radians, what shaders take as the error of storing
};
constexpr NormalFormat kNormalFormats[] = {
    {"RGBA8_UNORM", 255, 255, false, 1.5 / 255},       {"RGBA8_SNORM", 127, 127, true, 1.5 / 255},
    {"R10G10B10A2_UNORM", 1023, 3, false, 0.75 / 255}, {"RGBA16_UNORM", 65535, 65535, false, 0.4 / 255},
    {"RGBA16_SNORM", 32767, 32767, true, 0.4 / 255},
};

Vec4d packNormal(const Vec3d& normal, double roughness, double material, int normalEncoding, int roughnessEncoding);
Vec4d unpackNormal(const Vec4d& packed, int normalEncoding, int roughnessEncoding); // (unit normal, roughness)
double encodeRoughness(double roughness, int roughnessEncoding);

double quantized(double value, double steps, bool isSigned);
double nearestHalf(double value); // ties to even, clamped to the largest
} // namespace nrdtest
