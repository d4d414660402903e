#include "packing.h"

namespace nrdtest
{
namespace
{
constexpr double kHalfMax = 65504.0;
constexpr double kMinEncodedRoughness = 1.5 / 512.0; // carries the sign of the normal's z

bool isFinite(const Vec3d& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
bool isTenBit(int encoding) { return encoding == 2; }
} // namespace

Vec3d toYCoCg(const Vec3d& c)
{
    return {0.25 * c.r + 0.5 * c.g + 0.25 * c.b, 0.5 * c.r - 0.5 * c.b, -0.25 * c.r + 0.5 * c.g - 0.25 * c.b};
}

Vec3d fromYCoCg(const Vec3d& c) { return glm::max(Vec3d{c.x + c.y - c.z, c.x + c.z, c.x - c.y - c.z}, 0.0); }

Vec4d packReblur(const Vec4d& signal, bool sanitize)
{
    Vec3d radiance = Vec3d(signal);
    double hitDist = signal.w;
    if (sanitize && !(isFinite(radiance) && std::isfinite(hitDist))) return Vec4d(0.0);
    if (sanitize)
    {
        radiance = glm::clamp(radiance, 0.0, kHalfMax);
        hitDist = saturated(hitDist);
    }
    return Vec4d(toYCoCg(radiance), hitDist);
}

Vec4d packRelax(const Vec4d& signal, bool sanitize)
{
    if (sanitize && !(isFinite(Vec3d(signal)) && !std::isnan(signal.w))) return Vec4d(0.0);
    const double hitDist = std::isnan(signal.w) ? 0.0 : std::clamp(signal.w, 0.0, kHalfMax);
    return Vec4d(sanitize ? glm::clamp(Vec3d(signal), 0.0, kHalfMax) : Vec3d(signal), hitDist);
}

Vec3d packDirection(const Vec3d& direction, double luma, bool sanitize)
{
    if (sanitize && !isFinite(direction)) return Vec3d(0.0);
    return (sanitize ? glm::clamp(direction, -1.0, 1.0) : direction) * luma;
}

Vec4d packDirectional(const Vec3d& direction, double normHitDist, bool sanitize)
{
    if (sanitize) normHitDist = std::isfinite(normHitDist) ? saturated(normHitDist) : 0.0;
    return Vec4d(packDirection(direction, normHitDist, sanitize), normHitDist);
}

Vec4d sanitizedInput(const Vec4d& signal)
{
    if (!isFinite(Vec3d(signal)) || !std::isfinite(signal.w)) return Vec4d(0.0);
    return Vec4d(toYCoCg(glm::clamp(Vec3d(signal), 0.0, kHalfMax)), std::clamp(signal.w, 0.0, kHalfMax));
}

Vec3d sanitizedAxis(const Vec3d& sh1, double luma)
{
    if (!isFinite(sh1)) return Vec3d(0.0);
    const Vec3d axis = glm::clamp(sh1, -kHalfMax, kHalfMax);
    return axis * std::min(1.0, luma / std::max(glm::length(axis), 1e-10));
}

double encodeRoughness(double roughness, int roughnessEncoding)
{
    const double r = saturated(roughness);
    return roughnessEncoding == 0 ? r * r : roughnessEncoding == 2 ? std::sqrt(r) : r;
}

Vec4d packNormal(const Vec3d& normal, double roughness, double material, int normalEncoding, int roughnessEncoding)
{
    const double r = encodeRoughness(roughness, roughnessEncoding);
    const Vec3d size = glm::abs(normal);
    if (isTenBit(normalEncoding))
    {
        const Vec3d n = normal / std::max(size.x + size.y + size.z, 1e-15);
        const double signedRoughness = std::max(r, kMinEncodedRoughness) * (n.z < 0.0 ? -1.0 : 1.0);
        return {0.5 + 0.5 * (n.x + n.y), 0.5 + 0.5 * (n.y - n.x), 0.5 + 0.5 * signedRoughness,
                saturated(material / 3.0)};
    }
    const Vec3d cube = normal / std::max({size.x, size.y, size.z, 1e-15});
    return Vec4d(kNormalFormats[normalEncoding].isSigned ? cube : 0.5 * cube + 0.5, r);
}

Vec4d unpackNormal(const Vec4d& packed, int normalEncoding, int roughnessEncoding)
{
    Vec3d n = kNormalFormats[normalEncoding].isSigned ? Vec3d(packed) : 2.0 * Vec3d(packed) - 1.0;
    double r = packed.w;
    if (isTenBit(normalEncoding))
    {
        n = {packed.x - packed.y, packed.x + packed.y - 1.0, 0.0};
        n.z = (1.0 - std::abs(n.x) - std::abs(n.y)) * (packed.z < 0.5 ? -1.0 : 1.0);
        r = std::abs(2.0 * packed.z - 1.0);
    }
    r = roughnessEncoding == 0 ? std::sqrt(saturated(r)) : roughnessEncoding == 2 ? r * r : r;
    return Vec4d(normalizedOrZero(n), r);
}

double quantized(double value, double steps, bool isSigned)
{
    return std::round(std::clamp(value, isSigned ? -1.0 : 0.0, 1.0) * steps) / steps;
}

double nearestHalf(double value)
{
    const double v = std::clamp(value, -kHalfMax, kHalfMax);
    const double step = std::ldexp(1.0, std::max(v == 0.0 ? -14 : std::ilogb(v), -14) - 10); // subnormals: fixed steps
    return std::nearbyint(v / step) * step;
}
} // namespace nrdtest
