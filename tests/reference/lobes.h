// Lobes of the front end and of the passes, from the formulas.
#pragma once
#include "vectors.h"

namespace nrdtest
{
double lobeSpread(double roughness, double power);
double lobeTangent(double roughness, double share); // of the half angle that holds the share

double dominantFactor(double NoV, double roughness); // 1: mirror direction, 0: normal
Vec3d dominantDirection(const Vec3d& N, const Vec3d& V, double roughness);

// Of a lobe whose mean cosine is |c1| / c0.
double measuredSharpness(double c0, const Vec3d& c1);

double burley(double NoL, double NoV, double VoH, double roughness);
double visibility(double NoL, double NoV, double m2); // m2: roughness^4

// Of unit axes; sharpness up to about 1e7, where doubles still hold the exponent.
double sgIntegral(const Vec3d& u1, double s1, const Vec3d& u2, double s2, double amplitude);
double sgDiffuse(double c0, const Vec3d& L, const Vec3d& N, const Vec3d& V, double roughness);
double sgSpecular(double c0, const Vec3d& L, const Vec3d& N, const Vec3d& V, double roughness);
} // namespace nrdtest
