#include "scene_rooms.h"
#include "scene_shapes.h"

#include <cmath>

namespace sample
{
namespace
{
constexpr float kHalfWidth = 2.4f; // of both rooms together, metres
constexpr float kHeight = 2.6f;
constexpr float kDepth = 4.0f; // from z = 0 to the open front, which the wall between reaches too
constexpr float kWall = 0.01f;
constexpr float kDuration = 8.0f;

enum MaterialIndex
{
    Plaster,
    Wood,
    Clay,
    Brass
};

enum MeshIndex
{
    Rooms,
    Wall,
    Box,
    Ball
};

std::vector<Material> makeMaterials()
{
    return {makeMaterial("plaster", glm::vec3(0.72f, 0.7f, 0.66f), 0.0f, 0.9f),
            makeMaterial("wood", glm::vec3(0.4f, 0.28f, 0.18f), 0.0f, 0.4f),
            makeMaterial("clay", glm::vec3(0.65f, 0.25f, 0.15f), 0.0f, 0.7f),
            makeMaterial("brass", glm::vec3(0.9f, 0.7f, 0.4f), 1.0f, 0.3f)};
}

Mesh makeShell()
{
    const glm::vec3 low(-kHalfWidth, 0.0f, 0.0f), high(kHalfWidth, kHeight, kDepth);
    const glm::vec3 x(2 * kHalfWidth, 0, 0), y(0, kHeight, 0), z(0, 0, kDepth);
    return {{makeQuad(Wood, low, z, x), makeQuad(Plaster, high, -x, -z), makeQuad(Plaster, low, x, y),
             makeQuad(Plaster, low, y, z), makeQuad(Plaster, high, -z, -y)},
            {}};
}

void addLamp(Scene& scene, float x, const glm::vec3& intensity)
{
    scene.nodes.push_back(makeNode("lamp", kNone, glm::vec3(x, 2.2f, 2.0f), 0.0f));
    scene.nodes.back().light = static_cast<int>(scene.lights.size());
    PunctualLight light;
    light.intensity = intensity;
    light.radius = 0.1f;
    scene.lights.push_back(light);
}

// Sways past the wall's edge, so that each room is seen where the other was.
void addCamera(Scene& scene)
{
    const int camera = static_cast<int>(scene.nodes.size());
    scene.nodes.push_back(makeNode("camera", kNone, glm::vec3(0.0f), 0.0f));
    scene.nodes.back().camera = 0;
    scene.cameras.push_back({0.9f, 0.05f});
    scene.channels.push_back(makeChannel(camera, AnimationPath::Translation, 3, kDuration,
                                         [](float phase) { return glm::vec3(0.8f * std::sin(phase), 1.4f, 6.2f); }));
}
} // namespace

Scene makeRooms()
{
    Scene scene;
    scene.name = "rooms";
    scene.materials = makeMaterials();
    scene.meshes = {makeShell(),
                    {{makeBlock(Plaster, glm::vec3(kWall, kHeight, kDepth))}, {}},
                    {{makeBlock(Clay, glm::vec3(0.7f, 0.7f, 0.7f))}, {}},
                    {{makeSphere(glm::vec3(0.0f), 0.35f, Brass)}, {}}};
    scene.nodes = {makeNode("rooms", Rooms, glm::vec3(0.0f), 0.0f),
                   makeNode("wall", Wall, glm::vec3(0.0f, 0.0f, 0.5f * kDepth), 0.0f)};
    for (float side : {-1.0f, 1.0f})
    {
        scene.nodes.push_back(makeNode("box", Box, glm::vec3(side * 0.36f, 0.0f, 1.6f), 0.0f)); // touches the wall
        scene.nodes.push_back(makeNode("ball", Ball, glm::vec3(side * 1.4f, 0.35f, 2.2f), 0.0f));
    }
    addLamp(scene, -1.2f, glm::vec3(9.0f, 8.5f, 7.5f));
    addLamp(scene, 1.2f, glm::vec3(0.04f, 0.045f, 0.06f));
    addCamera(scene);
    scene.duration = kDuration;
    return scene;
}
} // namespace sample
