#include "ggx.h"
#include "vector.h"
#include <algorithm>

namespace nrd::doctor
{
namespace
{
constexpr double kLeastAlpha = 4e-3; // below it the rounding of normals decides
constexpr int kSamplesU = 24;        // in azimuth, over half of it: the other half mirrors it
constexpr int kSamplesV = 32;

// Of a visible normal, as drawn by Dupuy and Benyoub 2023 from two numbers in [0; 1].
bool isReflectedUp(const Vec3& view, double alpha, double u, double v)
{
    const Vec3 stretched = normalize(Vec3{alpha * view.x, 0.0, view.z});
    const double azimuth = 3.14159265358979 * u;
    const double z = (1.0 - v) * (1.0 + stretched.z) - stretched.z;
    const double sine = std::sqrt(std::max(1.0 - z * z, 0.0));
    const Vec3 cap = Vec3{sine * std::cos(azimuth), sine * std::sin(azimuth), z} + stretched;
    const Vec3 half = normalize(Vec3{alpha * cap.x, alpha * cap.y, cap.z});
    return 2.0 * dot(view, half) * half.z > view.z;
}

double integrate(double alpha, double cosView)
{
    const Vec3 view = {std::sqrt(1.0 - cosView * cosView), 0.0, cosView};
    int count = 0;
    for (int i = 0; i < kSamplesU; i++)
        for (int j = 0; j < kSamplesV; j++)
            count += isReflectedUp(view, alpha, (i + 0.5) / kSamplesU, (j + 0.5) / kSamplesV);
    return std::max(count, 1) / double(kSamplesU * kSamplesV);
}
} // namespace

const Ggx& Ggx::get()
{
    static const Ggx kGgx;
    return kGgx;
}

Ggx::Ggx()
{
    for (int a = 0; a < kAlphas; a++)
        for (int c = 0; c < kCosines; c++)
            m_above[size_t(a)][size_t(c)] = integrate((a + 0.5) / kAlphas, (c + 0.5) / kCosines);
}

double Ggx::shareAbove(double alpha, double cosView) const
{
    const double x = std::clamp(alpha * kAlphas - 0.5, 0.0, kAlphas - 1.001);
    const double y = std::clamp(cosView * kCosines - 0.5, 0.0, kCosines - 1.001);
    const size_t i = static_cast<size_t>(x), j = static_cast<size_t>(y);
    const double s = x - double(i), t = y - double(j);
    const auto row = [&](size_t k) { return m_above[k][j] + (m_above[k][j + 1] - m_above[k][j]) * t; };
    return row(i) + (row(i + 1) - row(i)) * s;
}

double Ggx::logDensity(const HalfVector& half, double roughness) const
{
    const double alpha = std::max(roughness * roughness, kLeastAlpha);
    const double a2 = alpha * alpha;
    // Heitz 2014: density of visible normals, masking of Smith.
    const double spread = half.sin2Half / a2 + half.cosHalf * half.cosHalf;
    const double tan2 = 1.0 / (half.cosView * half.cosView) - 1.0;
    const double masking = 2.0 / (1.0 + std::sqrt(1.0 + a2 * tan2));
    return std::log(masking) - std::log(a2) - 2.0 * std::log(spread) - std::log(shareAbove(alpha, half.cosView));
}
} // namespace nrd::doctor
