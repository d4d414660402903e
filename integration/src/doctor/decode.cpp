#include "decode.h"
#include <algorithm>

namespace nrd::doctor
{
Vec3 decodeNormal(const float* texel, NormalEncoding encoding)
{
    const Vec3 p = toVec3(texel);
    if (encoding == NormalEncoding::R10_G10_B10_A2_UNORM)
    {
        const double x = p.x - p.y;
        const double y = p.x + p.y - 1.0;
        return {x, y, (1.0 - std::abs(x) - std::abs(y)) * (p.z < 0.5 ? -1.0 : 1.0)};
    }
    const bool isSigned = encoding == NormalEncoding::RGBA8_SNORM || encoding == NormalEncoding::RGBA16_SNORM;
    return isSigned ? p : p * 2.0 - Vec3{1.0, 1.0, 1.0};
}

double decodeRoughness(const float* texel, NormalEncoding normals, RoughnessEncoding encoding)
{
    const bool isPacked10 = normals == NormalEncoding::R10_G10_B10_A2_UNORM;
    const double r = isPacked10 ? std::abs(2.0 * double(texel[2]) - 1.0) : double(texel[3]);
    if (encoding == RoughnessEncoding::SQ_LINEAR) return std::sqrt(std::clamp(r, 0.0, 1.0));
    return encoding == RoughnessEncoding::SQRT_LINEAR ? r * r : r;
}

double hitDistanceRange(double z, const HitDistanceParameters& parameters, double roughness)
{
    const double r = std::clamp(roughness, 0.0, 1.0);
    const double spread = (1.0 - std::exp2(-200.0 * r * r)) * std::sqrt(r);
    const double c = double(parameters.C);
    return (double(parameters.A) + z * double(parameters.B)) * (c + (1.0 - c) * spread);
}
} // namespace nrd::doctor
