#include "lobes.h"

namespace nrdtest
{
double lobeSpread(double roughness, double power)
{
    const double r = saturated(roughness);
    return r > 0.0 ? -std::expm1(-200.0 * r * r * std::log(2.0)) * std::pow(r, power) : 0.0;
}

double lobeTangent(double roughness, double share)
{
    return saturated(roughness) * std::sqrt(share / (1.0 - share + 1e-6));
}

double dominantFactor(double NoV, double roughness)
{
    const double a = 0.298475 * std::log(39.4115 - 39.0029 * saturated(roughness));
    return saturated(a + (1.0 - a) * std::pow(saturated(1.0 - NoV), 10.8649));
}

Vec3d dominantDirection(const Vec3d& N, const Vec3d& V, double roughness)
{
    const double factor = dominantFactor(std::abs(glm::dot(N, V)), roughness);
    return normalizedOrZero(glm::mix(N, glm::reflect(-V, N), factor));
}

double measuredSharpness(double c0, const Vec3d& c1)
{
    const double mu = std::min(glm::length(c1) / std::max(c0, 1e-6), 0.999);
    return mu * (3.0 - mu * mu) / (1.0 - mu * mu);
}

double burley(double NoL, double NoV, double VoH, double roughness)
{
    const double e = 2.0 * VoH * VoH * roughness - 0.5;
    return (1.0 + e * std::pow(1.0 - NoL, 5)) * (1.0 + e * std::pow(1.0 - NoV, 5)) / kPi;
}

double visibility(double NoL, double NoV, double m2)
{
    return 0.5 / (NoV * std::sqrt(NoL * NoL * (1 - m2) + m2) + NoL * std::sqrt(NoV * NoV * (1 - m2) + m2));
}

double sgIntegral(const Vec3d& u1, double s1, const Vec3d& u2, double s2, double amplitude)
{
    const double d = glm::length(u1 * s1 + u2 * s2);
    const double factor = d > 1e-9 ? -std::expm1(-2.0 * d) / d : 2.0;
    return 2.0 * kPi * amplitude * std::exp(d - s1 - s2) * factor;
}

double sgDiffuse(double c0, const Vec3d& L, const Vec3d& N, const Vec3d& V, double roughness)
{
    const double NoL = saturated(glm::dot(N, L)), NoV = saturated(std::abs(glm::dot(N, V)));
    const double VoH = saturated(glm::dot(V, glm::normalize(L + V)));
    const double edge = lerp(1.0, lerp(1.5, 0.6, roughness), std::pow(1.0 - NoV, 5));
    return std::max(sgIntegral(L, 2, N, 2, 2 * c0) * burley(NoL, NoV, VoH, roughness) * edge, c0 / kPi);
}

double sgSpecular(double c0, const Vec3d& L, const Vec3d& N, const Vec3d& V, double roughness)
{
    const double m2 = std::pow(std::max(roughness, 0.05), 4), s = 2.0 / m2;
    const double NoL = saturated(glm::dot(N, L)), NoV = lerp(0.02, 1.0, saturated(std::abs(glm::dot(N, V))));
    const double VoH = saturated(glm::dot(V, glm::normalize(L + V)));
    // Equal axes: the exponent is 0.
    const double d = s + 0.5 / std::max(m2 * VoH, 1e-8), integral = 2.0 * kPi * c0 * s * -std::expm1(-2.0 * d) / d;
    const double fit = lerp(lerp(0.1, 0.4, m2), 0.8, NoV);
    return std::max(integral * visibility(NoL, NoV, m2) * NoL * fit, c0 / kPi);
}
} // namespace nrdtest
