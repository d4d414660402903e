// What NRD_FrontEnd_PackNormalAndRoughness and REBLUR's packing keep, on the host.
#pragma once
#include "vector.h"
#include <nrd/settings.h>

namespace nrd::doctor
{
/// Not normalised: an octahedral one has |x| + |y| + |z| = 1 when it was encoded so.
Vec3 decodeNormal(const float* texel, NormalEncoding encoding);
double decodeRoughness(const float* texel, NormalEncoding normals, RoughnessEncoding encoding);

inline double lumaOfRgb(const float* rgb)
{
    return 0.25 * double(rgb[0]) + 0.5 * double(rgb[1]) + 0.25 * double(rgb[2]);
}

/// Distance of which the stored one is a fraction; roughness 1 for diffuse.
double hitDistanceRange(double z, const HitDistanceParameters& parameters, double roughness);
} // namespace nrd::doctor
