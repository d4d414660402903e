// Arguments drawn at random, ugly ones among them.
#pragma once
#include "function_runner.h"
#include "vectors.h"
#include <cstdint>
#include <limits>

namespace nrdtest
{
class Random
{
public:
    explicit Random(uint64_t seed) : m_rng(seed) {}

    double unit() { return static_cast<double>(m_rng() >> 11) * 0x1p-53; } // [0; 1)
    double uniform(double low, double high) { return lerp(low, high, unit()); }
    double logarithmic(double low, double high) { return low * std::exp2(unit() * std::log2(high / low)); }
    int below(int count) { return static_cast<int>(unit() * count); }
    bool oneIn(int count) { return below(count) == 0; }
    bool coin() { return oneIn(2); }

    Vec3d direction()
    {
        const double z = uniform(-1.0, 1.0), phi = uniform(0.0, 2.0 * kPi), r = std::sqrt(1.0 - z * z);
        return {r * std::cos(phi), r * std::sin(phi), z};
    }

    // Zero, denormal, at the limits of halves and floats.
    float extreme()
    {
        constexpr float kExtremes[] = {0.0f,      -0.0f, 1e-45f, -1e-40f,         1.17549435e-38f,
                                       1e-20f,    6e-8f, -6e-8f, 65504.0f,        65520.0f,
                                       -65504.0f, 1e9f,  1e30f,  3.402823466e+38f};
        return kExtremes[below(static_cast<int>(std::size(kExtremes)))];
    }
    float notFinite()
    {
        constexpr float kInf = std::numeric_limits<float>::infinity(), kNan = std::numeric_limits<float>::quiet_NaN();
        const float kinds[] = {kInf, -kInf, kNan, -kNan};
        return kinds[below(4)];
    }

    // Of a signal: log-uniform, one in eight extreme, one in sixteen negative.
    float signal(double low, double high)
    {
        if (oneIn(8)) return extreme();
        return static_cast<float>(logarithmic(low, high) * (oneIn(16) ? -1.0 : 1.0));
    }
    float anything(double low, double high) { return oneIn(32) ? notFinite() : signal(low, high); }

    // Roughness: the ends are as likely as the middle.
    float roughness()
    {
        if (oneIn(4)) return coin() ? 0.0f : 1.0f;
        return static_cast<float>(coin() ? unit() : logarithmic(1e-6, 1.0));
    }

    // A unit normal as an application has it, rounded to floats; one in eight along an axis, or nearly.
    Vec3d normal()
    {
        Vec3d n = direction();
        if (oneIn(8))
        {
            n = Vec3d(0.0);
            n[below(3)] = coin() ? 1.0 : -1.0;
            if (coin()) n = glm::normalize(n + direction() * logarithmic(1e-7, 1e-2));
        }
        return Vec3d(glm::vec3(n));
    }

private:
    std::mt19937_64 m_rng;
};

inline Vec4 toVec4(const Vec3d& v, double w = 0.0)
{
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), static_cast<float>(w)};
}
inline Vec4 toVec4(double x, double y = 0.0, double z = 0.0, double w = 0.0) { return toVec4(Vec3d(x, y, z), w); }
inline Vec3d toDouble(const Vec4& v) { return {v[0], v[1], v[2]}; }
} // namespace nrdtest
