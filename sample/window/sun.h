// The first sun of a scene as two angles. Pure.
#pragma once
#include "scene.h"

namespace sample
{
/// Degrees: azimuth 0 is towards -Z, growing towards +X; elevation above the horizon.
struct SunAngles
{
    float azimuth = 0.0f;
    float elevation = 45.0f;
    bool operator==(const SunAngles&) const = default;
};

glm::vec3 directionOf(const SunAngles& angles); // unit, towards the sun
SunAngles anglesOf(const glm::vec3& toSun);

/// Of the first node with a directional light, at rest; nullopt without one.
std::optional<SunAngles> sunOf(const Scene& scene);
/// Turns that node; false without one.
bool turnSun(Scene& scene, const SunAngles& angles);
} // namespace sample
