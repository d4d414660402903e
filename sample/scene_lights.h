// The lights next-event estimation chooses from: emissive triangles, punctual lights and the environment.
#pragma once
#include "alias_table.h"
#include "environment.h"
#include "scene_pose.h"

namespace sample
{
/// As kTriangleLight and so on in lights.glsl.
enum class LightKind : uint32_t
{
    Triangle,
    Point,
    Spot,
    Directional,
    Environment
};

struct SceneLight
{
    LightKind kind = LightKind::Triangle;
    uint32_t triangle = 0; // index in ScenePose::triangles
    glm::vec3 position = glm::vec3(0.0f);
    glm::vec3 direction = glm::vec3(0.0f, 0.0f, -1.0f); // of travel
    PunctualLight source;                               // of the punctual kinds
};

struct SceneLights
{
    std::vector<SceneLight> lights;
    std::vector<AliasEntry> table; // one entry per light, by estimated power with a floor
    // The light whose shadow can be a signal of its own: the strongest directional one, else the strongest spot; kNone
    // without either.
    int shadowLight = kNone;
    std::vector<AliasEntry> primaryTable; // as `table`, but never that light
};

/// All lights of the pose. `environment` may be null.
SceneLights collectLights(const Scene& scene, const ScenePose& pose, const Environment* environment);

/// True when the scene has a light whose shadow can be a signal of its own.
bool hasShadowLight(const Scene& scene);

/// True when a material of the scene emits or a node carries a punctual light.
bool hasLights(const Scene& scene);
} // namespace sample
