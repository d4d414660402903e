#include "scene_panes.h"
#include "scene_shapes.h"

#include <cmath>

namespace sample
{
namespace
{
constexpr float kHalfWidth = 7.5f; // of the floor, metres
constexpr float kBack = -2.4f;     // of the floor, where the wall stands
constexpr float kFront = 7.0f;
constexpr float kHeight = 4.2f;
constexpr float kDuration = 8.0f;
constexpr float kPaneWidth = 0.62f;
constexpr float kPaneHeight = 1.5f;
constexpr float kBarGap = 0.3f;

enum MaterialIndex
{
    Plaster,
    Stone,
    Wood,
    Brass,
    Rubber,
    Sky,
    RedGlass,
    GreenGlass,
    BlueGlass
};

enum NodeIndex
{
    Room,
    Sun,
    Ball,
    Eye
};

Material makeGlass(const char* name, const glm::vec3& color)
{
    Material glass = makeMaterial(name, color, 0.0f, 0.2f);
    glass.baseColor.a = 0.3f;
    glass.alphaCutoff = 0.5f;
    glass.isBlended = true;
    glass.isDoubleSided = true;
    return glass;
}

std::vector<Material> makeMaterials()
{
    std::vector<Material> materials = {
        makeMaterial("plaster", glm::vec3(0.72f, 0.7f, 0.66f), 0.0f, 0.9f),
        makeMaterial("stone", glm::vec3(0.5f, 0.48f, 0.45f), 0.0f, 0.6f),
        makeMaterial("wood", glm::vec3(0.24f, 0.15f, 0.09f), 0.0f, 0.5f),
        makeMaterial("brass", glm::vec3(0.9f, 0.7f, 0.4f), 1.0f, 0.3f),
        makeMaterial("rubber", glm::vec3(0.15f, 0.3f, 0.6f), 0.0f, 0.7f),
        makeMaterial("sky", glm::vec3(0.0f), 0.0f, 1.0f),
        makeGlass("red glass", glm::vec3(0.95f, 0.16f, 0.1f)),
        makeGlass("green glass", glm::vec3(0.15f, 0.85f, 0.25f)),
        makeGlass("blue glass", glm::vec3(0.15f, 0.35f, 0.95f)),
    };
    materials[Sky].emission = glm::vec3(0.4f, 0.52f, 0.72f);
    return materials;
}

void moveTo(Primitive& p, const glm::vec3& place)
{
    for (glm::vec3& position : p.positions) position += place;
}

// Three panes in a frame, the middle one half behind the first: there the light crosses both.
void addPanes(Mesh& mesh)
{
    const glm::vec3 low(-2.3f, 0.35f, 0.0f), x(kPaneWidth, 0, 0), y(0, kPaneHeight, 0);
    mesh.primitives.push_back(makeQuad(RedGlass, low, x, y));
    mesh.primitives.push_back(makeQuad(GreenGlass, low + glm::vec3(0.5f * kPaneWidth, 0.3f, -0.3f), x, y));
    mesh.primitives.push_back(makeQuad(BlueGlass, low + glm::vec3(1.6f * kPaneWidth, 0, 0), x, y));
    for (float at : {0.0f, 1.55f, 2.65f})
    {
        mesh.primitives.push_back(makeBlock(Wood, glm::vec3(0.06f, kPaneHeight + 0.5f, 0.06f)));
        moveTo(mesh.primitives.back(), glm::vec3(low.x + at * kPaneWidth, 0.0f, 0.05f));
    }
}

// Their shadows soften with the height.
void addBars(Mesh& mesh)
{
    for (int i = 0; i < 5; ++i)
    {
        mesh.primitives.push_back(makeBlock(Wood, glm::vec3(0.07f, 2.4f, 0.07f)));
        moveTo(mesh.primitives.back(), glm::vec3(0.3f + kBarGap * float(i), 0.0f, -0.9f));
    }
}

Mesh makeRoom()
{
    const glm::vec3 low(-kHalfWidth, 0.0f, kBack), x(2 * kHalfWidth, 0, 0), z(0, 0, kFront - kBack);
    Mesh mesh;
    mesh.primitives.push_back(makeQuad(Stone, low, z, x));
    mesh.primitives.push_back(makeQuad(Plaster, low, x, glm::vec3(0, kHeight, 0)));
    // Behind the camera and facing the wall, or shadows would be black; too low to be in the sun's way.
    mesh.primitives.push_back(makeQuad(Sky, glm::vec3(kHalfWidth, 0, kFront), -x, glm::vec3(0, 2.8f, 0)));
    addPanes(mesh);
    addBars(mesh);
    mesh.primitives.push_back(makeSphere(glm::vec3(1.35f, 0.42f, 0.9f), 0.42f, Brass));
    return mesh;
}

AnimationChannel makeBallMotion()
{
    return makeChannel(Ball, AnimationPath::Translation, 3, kDuration,
                       [](float phase)
                       { return glm::vec3(-0.2f + 0.9f * std::sin(phase), 1.15f + 0.45f * std::cos(phase), 1.2f); });
}

void addCamera(Scene& scene)
{
    scene.cameras.push_back({0.8f, 0.05f});
    scene.channels.push_back(makeChannel(Eye, AnimationPath::Translation, 3, kDuration,
                                         [](float phase) { return glm::vec3(0.3f * std::sin(phase), 2.1f, 5.2f); }));
    scene.channels.push_back(makeChannel(Eye, AnimationPath::Rotation, 4, kDuration,
                                         [](float phase) { return turnAndTilt(0.05f * std::sin(phase), -0.24f); }));
}
} // namespace

Scene makePanes()
{
    Scene scene;
    scene.name = "panes";
    scene.materials = makeMaterials();
    scene.meshes.push_back(makeRoom());
    scene.meshes.push_back({{makeSphere(glm::vec3(0.0f), 0.28f, Rubber)}, {}});
    PunctualLight sun;
    sun.type = LightType::Directional;
    sun.intensity = glm::vec3(7.5f, 6.8f, 5.7f);
    sun.tanAngularRadius = 0.0262f; // 1.5 degrees, as through haze: penumbrae of several pixels at small sizes
    scene.lights.push_back(sun);
    scene.nodes.push_back(makeNode("room", 0, glm::vec3(0.0f), 0.0f));
    scene.nodes.push_back(makeNode("sun", kNone, glm::vec3(0.0f), 0.0f));
    scene.nodes[Sun].light = 0;
    // Travels along -Z: to the right, down and away from the camera.
    const glm::vec4 q = turnAndTilt(-0.8f, -0.5f);
    scene.nodes[Sun].rotation = glm::quat(q.w, q.x, q.y, q.z);
    scene.nodes.push_back(makeNode("ball", 1, glm::vec3(0.0f), 0.0f));
    scene.nodes.push_back(makeNode("eye", kNone, glm::vec3(0.0f), 0.0f));
    scene.nodes[Eye].camera = 0;
    scene.channels.push_back(makeBallMotion());
    addCamera(scene);
    scene.duration = kDuration;
    return scene;
}
} // namespace sample
