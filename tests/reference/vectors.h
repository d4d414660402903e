// Vectors of the references.
#pragma once
#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <random>

namespace nrdtest
{
using Vec3d = glm::dvec3;
constexpr double kPi = 3.14159265358979323846;

inline Vec3d scaled(const Vec3d& a, double s) { return a * s; }
inline Vec3d sum(const Vec3d& a, const Vec3d& b) { return a + b; }
inline Vec3d difference(const Vec3d& a, const Vec3d& b) { return a - b; }
inline Vec3d normalized(const Vec3d& a) { return glm::normalize(a); }
inline Vec3d normalizedOrZero(const Vec3d& a) { return a == Vec3d(0.0) ? a : glm::normalize(a); }
inline double lerp(double a, double b, double t) { return a + (b - a) * t; }
inline double saturated(double x) { return std::clamp(x, 0.0, 1.0); }

// Accurate at every angle, whatever the lengths.
inline double angleBetween(const Vec3d& a, const Vec3d& b)
{
    const Vec3d u = glm::normalize(a), v = glm::normalize(b);
    return std::atan2(glm::length(glm::cross(u, v)), glm::dot(u, v));
}

inline Vec3d randomDirection(std::mt19937& rng)
{
    std::normal_distribution<double> normal;
    return normalized({normal(rng), normal(rng), normal(rng)});
}

// On the cone of the given angle about the axis.
inline Vec3d tilted(std::mt19937& rng, const Vec3d& axis, double degrees)
{
    const Vec3d v = randomDirection(rng);
    const Vec3d side = normalized(v - axis * glm::dot(v, axis));
    const double angle = degrees * kPi / 180.0;
    return axis * std::cos(angle) + side * std::sin(angle);
}
} // namespace nrdtest
