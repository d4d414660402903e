// How likely a microfacet normal is under GGX, when directions are drawn from the visible normals and those that end
// below the surface are dropped.
#pragma once
#include <array>

namespace nrd::doctor
{
struct HalfVector
{
    double cosView = 0.0;  // normal and camera, > 0
    double cosHalf = 0.0;  // normal and microfacet normal
    double sin2Half = 0.0; // squared sine of that angle, which near 0 a cosine does not tell
};

class Ggx
{
public:
    static const Ggx& get(); // made at its first use

    /// Logarithm of the density, but for what does not depend on roughness (linear).
    double logDensity(const HalfVector& half, double roughness) const;

private:
    Ggx();
    double shareAbove(double alpha, double cosView) const;

    static constexpr int kAlphas = 24;
    static constexpr int kCosines = 16;
    std::array<std::array<double, kCosines>, kAlphas> m_above; // at the middles of equal steps from 0 to 1
};
} // namespace nrd::doctor
