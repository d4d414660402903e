// The lobes of the front end in double precision, written from the formulas, for comparison.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace nrdtest
{
using Vec3d = std::array<double, 3>;
constexpr double kPi = 3.14159265358979323846;

inline double dot(Vec3d a, Vec3d b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline double length(Vec3d a) { return std::sqrt(dot(a, a)); }
inline Vec3d scaled(Vec3d a, double s) { return {a[0] * s, a[1] * s, a[2] * s}; }
inline Vec3d sum(Vec3d a, Vec3d b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Vec3d difference(Vec3d a, Vec3d b) { return sum(a, scaled(b, -1.0)); }
inline Vec3d normalized(Vec3d a) { return scaled(a, 1.0 / length(a)); }
inline Vec3d cross(Vec3d a, Vec3d b)
{
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double lerp(double a, double b, double t) { return a + (b - a) * t; }
inline double saturated(double x) { return std::clamp(x, 0.0, 1.0); }

inline Vec3d randomDirection(std::mt19937& rng)
{
    std::normal_distribution<double> normal;
    return normalized({normal(rng), normal(rng), normal(rng)});
}

// On the cone of the given angle about the axis.
inline Vec3d tilted(std::mt19937& rng, Vec3d axis, double degrees)
{
    const Vec3d v = randomDirection(rng);
    const Vec3d side = normalized(difference(v, scaled(axis, dot(v, axis))));
    const double angle = degrees * kPi / 180.0;
    return sum(scaled(axis, std::cos(angle)), scaled(side, std::sin(angle)));
}

inline double lobeSpread(double r, double p)
{
    return r > 0.0 ? (1.0 - std::exp2(-200.0 * r * r)) * std::pow(r, p) : 0.0;
}

inline Vec3d dominantDirection(Vec3d n, Vec3d v, double r)
{
    const double nov = std::abs(dot(n, v)), a = 0.298475 * std::log(39.4115 - 39.0029 * r);
    const double g = saturated(a + (1.0 - a) * std::pow(1.0 - nov, 10.8649));
    const Vec3d reflected = difference(scaled(n, 2.0 * dot(n, v)), v);
    return normalized(sum(scaled(n, 1.0 - g), scaled(reflected, g)));
}

inline double burley(double nol, double nov, double voh, double r)
{
    const double e = 2.0 * voh * voh * r - 0.5;
    return (1.0 + e * std::pow(1.0 - nol, 5)) * (1.0 + e * std::pow(1.0 - nov, 5)) / kPi;
}

inline double visibility(double nol, double nov, double m2)
{
    return 0.5 / (nov * std::sqrt(nol * nol * (1 - m2) + m2) + nol * std::sqrt(nov * nov * (1 - m2) + m2));
}

// Of unit axes; sharpness up to about 1e7, where doubles still hold the exponent.
inline double sgIntegral(Vec3d u1, double s1, Vec3d u2, double s2, double amplitude)
{
    const double d = length(sum(scaled(u1, s1), scaled(u2, s2)));
    const double factor = d > 1e-9 ? -std::expm1(-2.0 * d) / d : 2.0;
    return 2.0 * kPi * amplitude * std::exp(d - s1 - s2) * factor;
}

inline double sgDiffuse(double c0, Vec3d l, Vec3d n, Vec3d v, double r)
{
    const double nol = saturated(dot(n, l)), nov = saturated(std::abs(dot(n, v)));
    const double voh = saturated(dot(v, normalized(sum(l, v))));
    const double edge = lerp(1.0, lerp(1.5, 0.6, r), std::pow(1.0 - nov, 5));
    return std::max(sgIntegral(l, 2, n, 2, 2 * c0) * burley(nol, nov, voh, r) * edge, c0 / kPi);
}

inline double sgSpecular(double c0, Vec3d l, Vec3d n, Vec3d v, double roughness)
{
    const double m2 = std::pow(std::max(roughness, 0.05), 4), s = 2.0 / m2;
    const double nol = saturated(dot(n, l)), nov = lerp(0.02, 1.0, saturated(std::abs(dot(n, v))));
    const double voh = saturated(dot(v, normalized(sum(l, v))));
    // Equal axes: the exponent is 0.
    const double d = s + 0.5 / std::max(m2 * voh, 1e-8), integral = 2.0 * kPi * c0 * s * -std::expm1(-2.0 * d) / d;
    const double fit = lerp(lerp(0.1, 0.4, m2), 0.8, nov);
    return std::max(integral * visibility(nol, nov, m2) * nol * fit, c0 / kPi);
}
} // namespace nrdtest
