#include "scene_cornell.h"
#include "scene_shapes.h"

#include <cmath>

namespace sample
{
namespace
{
constexpr float kHalfWidth = 2.6f; // of the room, metres
constexpr float kHeight = 3.4f;
constexpr float kHalfDepth = 3.4f;
constexpr float kDuration = 8.0f;

enum MaterialIndex
{
    White,
    Red,
    Green,
    Floor,
    Metal,
    Plastic,
    Lamp
};

std::vector<Material> makeMaterials()
{
    std::vector<Material> materials = {
        makeMaterial("white", glm::vec3(0.73f), 0.0f, 0.9f),
        makeMaterial("red", glm::vec3(0.63f, 0.06f, 0.05f), 0.0f, 0.9f),
        makeMaterial("green", glm::vec3(0.12f, 0.45f, 0.09f), 0.0f, 0.9f),
        makeMaterial("floor", glm::vec3(0.55f, 0.52f, 0.48f), 0.0f, 0.35f),
        makeMaterial("metal", glm::vec3(0.95f, 0.78f, 0.55f), 1.0f, 0.35f),
        makeMaterial("plastic", glm::vec3(0.15f, 0.3f, 0.65f), 0.0f, 0.15f),
        makeMaterial("lamp", glm::vec3(0.8f), 0.0f, 1.0f),
    };
    materials[Lamp].emission = glm::vec3(6.6f, 5.3f, 3.8f);
    return materials;
}

Mesh makeRoom()
{
    const glm::vec3 low(-kHalfWidth, 0.0f, -kHalfDepth), high(kHalfWidth, kHeight, kHalfDepth);
    const glm::vec3 x(2 * kHalfWidth, 0, 0), y(0, kHeight, 0), z(0, 0, 2 * kHalfDepth);
    Mesh mesh;
    mesh.primitives.push_back(makeQuad(Floor, low, z, x));
    mesh.primitives.push_back(makeQuad(White, high, -x, -z)); // ceiling
    mesh.primitives.push_back(makeQuad(White, low, x, y));    // back
    mesh.primitives.push_back(makeQuad(White, high, -y, -x)); // behind the camera
    mesh.primitives.push_back(makeQuad(Red, low, y, z));
    mesh.primitives.push_back(makeQuad(Green, high, -z, -y));
    const glm::vec3 corner(-1.5f, kHeight - 0.02f, -1.9f);
    mesh.primitives.push_back(makeQuad(Lamp, corner, glm::vec3(3.0f, 0, 0), glm::vec3(0, 0, 2.4f)));
    return mesh;
}

} // namespace

Scene makeCornellBox()
{
    Scene scene;
    scene.name = "cornell box";
    scene.materials = makeMaterials();
    scene.meshes.push_back(makeRoom());
    scene.meshes.push_back({{makeBlock(Metal, glm::vec3(1.15f, 2.1f, 1.15f))}, {}});
    scene.meshes.push_back({{makeBlock(Plastic, glm::vec3(1.0f, 1.0f, 1.0f))}, {}});
    scene.nodes.push_back(makeNode("room", 0, glm::vec3(0.0f), 0.0f));
    scene.nodes.push_back(makeNode("metal block", 1, glm::vec3(-0.95f, 0.0f, -1.5f), 0.35f));
    scene.nodes.push_back(makeNode("plastic block", 2, glm::vec3(0.95f, 0.0f, -0.5f), -0.3f));
    scene.nodes.push_back(makeNode("camera", kNone, glm::vec3(0.0f, 1.6f, 3.2f), 0.0f));
    scene.nodes.back().camera = 0;
    scene.cameras.push_back({0.9f, 0.05f});
    scene.channels.push_back(makeChannel(2, AnimationPath::Translation, 3, kDuration,
                                         [](float phase) {
                                             return glm::vec3(0.95f + 0.45f * std::sin(phase), 0.0f,
                                                              -0.5f + 0.3f * (1.0f - std::cos(phase)));
                                         }));
    scene.channels.push_back(makeChannel(2, AnimationPath::Rotation, 4, kDuration,
                                         [](float phase) { return turnAboutY(-0.3f + 0.5f * std::sin(phase)); }));
    scene.channels.push_back(makeChannel(3, AnimationPath::Translation, 3, kDuration,
                                         [](float phase)
                                         {
                                             return glm::vec3(0.55f * std::sin(phase), 1.6f + 0.1f * std::sin(phase),
                                                              3.2f - 0.25f * (1.0f - std::cos(phase)));
                                         }));
    scene.channels.push_back(makeChannel(3, AnimationPath::Rotation, 4, kDuration,
                                         [](float phase) { return turnAndTilt(0.12f * std::sin(phase), -0.08f); }));
    scene.duration = kDuration;
    return scene;
}
} // namespace sample
