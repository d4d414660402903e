#include "window/sun.h"

#include <algorithm>
#include <cmath>

namespace sample
{
namespace
{
// Index of the node, kNone without one.
int sunNode(const Scene& scene)
{
    for (size_t n = 0; n < scene.nodes.size(); ++n)
    {
        const int light = scene.nodes[n].light;
        if (light != kNone && scene.lights[size_t(light)].type == LightType::Directional) return int(n);
    }
    return kNone;
}

glm::mat3 localRotation(const Node& node)
{
    if (!node.matrix) return glm::mat3_cast(node.rotation);
    glm::mat3 m(*node.matrix);
    for (int i = 0; i < 3; ++i) m[i] = glm::normalize(m[i]);
    return m;
}

glm::mat3 rotationToWorld(const Scene& scene, int node)
{
    glm::mat3 m(1.0f);
    for (; node != kNone; node = scene.nodes[size_t(node)].parent) m = localRotation(scene.nodes[size_t(node)]) * m;
    return m;
}
} // namespace

glm::vec3 directionOf(const SunAngles& angles)
{
    const float azimuth = glm::radians(angles.azimuth), elevation = glm::radians(angles.elevation);
    return {std::sin(azimuth) * std::cos(elevation), std::sin(elevation), -std::cos(azimuth) * std::cos(elevation)};
}

SunAngles anglesOf(const glm::vec3& toSun)
{
    return {glm::degrees(std::atan2(toSun.x, -toSun.z)), glm::degrees(std::asin(std::clamp(toSun.y, -1.0f, 1.0f)))};
}

std::optional<SunAngles> sunOf(const Scene& scene)
{
    const int node = sunNode(scene);
    if (node == kNone) return std::nullopt;
    return anglesOf(glm::normalize(rotationToWorld(scene, node)[2])); // it shines along -Z
}

bool turnSun(Scene& scene, const SunAngles& angles)
{
    const int index = sunNode(scene);
    if (index == kNone) return false;
    const glm::vec3 back = directionOf(angles);
    const glm::vec3 up = std::abs(back.y) > 0.99f ? glm::vec3(1.0f, 0.0f, 0.0f) : glm::vec3(0.0f, 1.0f, 0.0f);
    const glm::vec3 right = glm::normalize(glm::cross(up, back));
    const glm::mat3 world(right, glm::cross(back, right), back);
    Node& node = scene.nodes[size_t(index)];
    node.matrix.reset();
    node.rotation = glm::quat_cast(glm::transpose(rotationToWorld(scene, node.parent)) * world);
    return true;
}
} // namespace sample
