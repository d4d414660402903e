#include "scene_lights.h"

#include <algorithm>
#include <cmath>

namespace sample
{
namespace
{
constexpr double kPi = 3.14159265358979323846;

double luminance(const glm::vec3& c) { return 0.2126 * double(c.r) + 0.7152 * double(c.g) + 0.0722 * double(c.b); }

bool isEmissive(const Material& material) { return luminance(material.emission) > 0.0; }

double triangleArea(const ScenePose& pose, const PosedTriangle& t)
{
    const glm::vec3 a = pose.positions[t.vertices[0]];
    const glm::vec3 cross = glm::cross(pose.positions[t.vertices[1]] - a, pose.positions[t.vertices[2]] - a);
    return 0.5 * double(glm::length(cross));
}

LightKind kindOf(LightType type)
{
    switch (type)
    {
    case LightType::Directional:
        return LightKind::Directional;
    case LightType::Point:
        return LightKind::Point;
    case LightType::Spot:
        return LightKind::Spot;
    }
    return LightKind::Point;
}

// What a light may bring into a scene of that radius; only the order of magnitude matters.
double powerOf(const SceneLight& light, double radius)
{
    const double intensity = luminance(light.source.intensity);
    switch (light.kind)
    {
    case LightKind::Directional:
        return intensity * kPi * radius * radius;
    case LightKind::Point:
        return intensity * 4.0 * kPi;
    case LightKind::Spot:
        return intensity * 2.0 * kPi * (1.0 - double(light.source.outerCosine));
    case LightKind::Triangle:
    case LightKind::Environment:
        break;
    }
    return 0.0;
}

void addTriangles(const Scene& scene, const ScenePose& pose, SceneLights& out, std::vector<double>& powers)
{
    for (size_t i = 0; i < pose.triangles.size(); ++i)
    {
        const Material& material = scene.materials[pose.triangles[i].material];
        const double area = triangleArea(pose, pose.triangles[i]);
        if (!isEmissive(material) || !(area > 0.0)) continue;
        SceneLight light;
        light.triangle = static_cast<uint32_t>(i);
        out.lights.push_back(light);
        powers.push_back(luminance(material.emission) * area * kPi * (material.isDoubleSided ? 2.0 : 1.0));
    }
}

void addPunctual(const Scene& scene, const ScenePose& pose, SceneLights& out, std::vector<double>& powers)
{
    for (size_t n = 0; n < scene.nodes.size(); ++n)
    {
        if (scene.nodes[n].light == kNone) continue;
        SceneLight light;
        light.source = scene.lights[size_t(scene.nodes[n].light)];
        light.kind = kindOf(light.source.type);
        const glm::mat4& toWorld = pose.nodeToWorld()[n];
        light.position = glm::vec3(toWorld[3]);
        const glm::vec3 along = -glm::vec3(toWorld[2]);
        if (glm::length(along) > 0.0f) light.direction = glm::normalize(along);
        // One that is off keeps its place: it may be the shadow's, and come back.
        out.lights.push_back(light);
        powers.push_back(std::max(0.0, powerOf(light, double(pose.bounds().radius()))));
    }
}

// A tenth of all power is spread evenly over the lights that shine, so that a weak one that is near is found often
// enough. Returns the sum before.
double addFloor(std::vector<double>& powers)
{
    double sum = 0.0, count = 0.0;
    for (double power : powers) sum += power;
    for (double power : powers) count += power > 0.0;
    for (double& power : powers)
        if (power > 0.0) power += 0.1 * sum / count;
    return sum;
}

int findShadowLight(const std::vector<SceneLight>& lights)
{
    for (LightKind kind : {LightKind::Directional, LightKind::Spot})
    {
        int best = kNone;
        for (size_t i = 0; i < lights.size(); ++i)
            if (lights[i].kind == kind && (best == kNone || luminance(lights[i].source.intensity) >
                                                                luminance(lights[size_t(best)].source.intensity)))
                best = static_cast<int>(i);
        if (best != kNone) return best;
    }
    return kNone;
}
} // namespace

SceneLights collectLights(const Scene& scene, const ScenePose& pose, const Environment* environment)
{
    SceneLights out;
    std::vector<double> powers;
    addTriangles(scene, pose, out, powers);
    addPunctual(scene, pose, out, powers);
    const double sum = addFloor(powers);
    if (environment)
    {
        const double radius = double(pose.bounds().radius());
        const double sky = luminance(environment->mean) * kPi * kPi * radius * radius;
        SceneLight light;
        light.kind = LightKind::Environment;
        out.lights.push_back(light);
        const double others = 1.1 * sum;
        powers.push_back(others > 0.0 ? std::clamp(sky, 0.25 * others, 4.0 * others) : 1.0);
    }
    out.table = buildAliasTable(powers);
    out.shadowLight = findShadowLight(out.lights);
    if (out.shadowLight != kNone) powers[size_t(out.shadowLight)] = 0.0;
    out.primaryTable = buildAliasTable(powers);
    return out;
}

bool hasShadowLight(const Scene& scene)
{
    return std::any_of(scene.nodes.begin(), scene.nodes.end(),
                       [&](const Node& node)
                       {
                           if (node.light == kNone) return false;
                           const PunctualLight& light = scene.lights[size_t(node.light)];
                           return light.type != LightType::Point && luminance(light.intensity) > 0.0;
                       });
}

bool hasLights(const Scene& scene)
{
    return std::any_of(scene.materials.begin(), scene.materials.end(), isEmissive) ||
           std::any_of(scene.nodes.begin(), scene.nodes.end(), [](const Node& node) { return node.light != kNone; });
}
} // namespace sample
