#include "scene_mirror.h"
#include "scene_shapes.h"

#include <cmath>

namespace sample
{
namespace
{
constexpr float kHalfWidth = 2.2f; // of the yard, metres; the mirror's wall is at z = 0
constexpr float kHeight = 2.6f;
constexpr float kDepth = 4.4f;
constexpr float kDuration = 8.0f;
constexpr float kMirrorHalfWidth = 1.3f;
constexpr float kMirrorLow = 0.35f; // above the floor
constexpr float kMirrorHigh = 2.2f;
constexpr float kTile = 1.4f; // metres that one repetition of a pattern spans
constexpr int kTextureSize = 256;

enum MaterialIndex
{
    Plaster,
    Blue,
    Tiles,
    Carpet,
    Clay,
    Brass,
    Mirror
};

enum MeshIndex
{
    Yard,
    Ball,
    Block,
    Glass
};

// Chequered in two colours, with a grain that no denoiser can tell from noise.
Texture makePattern(const glm::vec3& a, const glm::vec3& b, int squares)
{
    Texture texture;
    texture.width = texture.height = kTextureSize;
    uint32_t state = 1;
    for (int y = 0; y < kTextureSize; ++y)
        for (int x = 0; x < kTextureSize; ++x)
        {
            state = state * 1664525u + 1013904223u;
            const float grain = 0.7f + 0.3f * float(state >> 24) / 255.0f;
            const bool isFirst = ((x * squares / kTextureSize) ^ (y * squares / kTextureSize)) & 1;
            for (int c = 0; c < 3; ++c)
                texture.rgba.push_back(static_cast<uint8_t>(std::lround((isFirst ? a : b)[c] * grain * 255.0f)));
            texture.rgba.push_back(255);
        }
    return texture;
}

std::vector<Material> makeMaterials()
{
    std::vector<Material> materials = {
        makeMaterial("plaster", glm::vec3(0.7f, 0.68f, 0.64f), 0.0f, 0.9f),
        makeMaterial("blue", glm::vec3(0.2f, 0.3f, 0.55f), 0.0f, 0.9f),
        makeMaterial("tiles", glm::vec3(1.0f), 0.0f, 0.4f),
        makeMaterial("carpet", glm::vec3(1.0f), 0.0f, 0.9f),
        makeMaterial("clay", glm::vec3(0.65f, 0.25f, 0.15f), 0.0f, 0.7f),
        makeMaterial("brass", glm::vec3(0.9f, 0.7f, 0.4f), 1.0f, 0.3f),
        makeMaterial("mirror", glm::vec3(1.0f), 1.0f, 0.0f),
    };
    for (MaterialIndex i : {Tiles, Carpet})
    {
        TextureUse& use = materials[i].baseColorTexture;
        use.texture = i == Tiles ? 0 : 1;
        use.scale = glm::vec2(1.0f / kTile);
    }
    return materials;
}

// Around the hole that the mirror fills.
void addMirrorWall(Mesh& mesh)
{
    const float side = kHalfWidth - kMirrorHalfWidth;
    const glm::vec3 x(2 * kMirrorHalfWidth, 0, 0), y(0, kHeight, 0), edge(side, 0, 0);
    const auto add = [&](float left, float bottom, const glm::vec3& u, const glm::vec3& v)
    { mesh.primitives.push_back(makeQuad(Blue, glm::vec3(left, bottom, 0.0f), u, v)); };
    add(-kHalfWidth, 0.0f, edge, y);
    add(kMirrorHalfWidth, 0.0f, edge, y);
    add(-kMirrorHalfWidth, 0.0f, x, glm::vec3(0, kMirrorLow, 0));
    add(-kMirrorHalfWidth, kMirrorHigh, x, glm::vec3(0, kHeight - kMirrorHigh, 0));
}

Mesh makeYard()
{
    const glm::vec3 low(-kHalfWidth, 0.0f, 0.0f), high(kHalfWidth, kHeight, kDepth);
    const glm::vec3 x(2 * kHalfWidth, 0, 0), y(0, kHeight, 0), z(0, 0, kDepth);
    Mesh mesh;
    mesh.primitives.push_back(makeQuad(Tiles, low, z, x));
    mesh.primitives.push_back(makeQuad(Carpet, high, -y, -x)); // behind the camera
    mesh.primitives.push_back(makeQuad(Plaster, low, y, z));
    mesh.primitives.push_back(makeQuad(Clay, high, -z, -y));
    addMirrorWall(mesh);
    return mesh;
}

std::vector<Mesh> makeMeshes()
{
    const Primitive mirror = makeQuad(Mirror, glm::vec3(-kMirrorHalfWidth, kMirrorLow, 0.0f),
                                      glm::vec3(2 * kMirrorHalfWidth, 0, 0), glm::vec3(0, kMirrorHigh - kMirrorLow, 0));
    return {makeYard(),
            {{makeSphere(glm::vec3(0.0f), 0.3f, Brass)}, {}},
            {{makeBlock(Carpet, glm::vec3(0.5f, 0.9f, 0.5f))}, {}},
            {{mirror}, {}}};
}

// The yard's nodes below `parent`.
void addYard(Scene& scene, int parent)
{
    const int first = static_cast<int>(scene.nodes.size());
    scene.nodes.push_back(makeNode("yard", Yard, glm::vec3(0.0f), 0.0f));
    scene.nodes.push_back(makeNode("ball", Ball, glm::vec3(0.0f), 0.0f));
    scene.nodes.push_back(makeNode("block", Block, glm::vec3(0.95f, 0.0f, 1.2f), 0.5f));
    for (size_t i = size_t(first); i < scene.nodes.size(); ++i) scene.nodes[i].parent = parent;
    scene.channels.push_back(makeChannel(first + 1, AnimationPath::Translation, 3, kDuration,
                                         [](float phase) {
                                             return glm::vec3(-0.8f + 0.5f * std::sin(phase),
                                                              0.6f + 0.25f * std::cos(2.0f * phase), 1.5f);
                                         }));
    scene.channels.push_back(makeChannel(first + 2, AnimationPath::Rotation, 4, kDuration,
                                         [](float phase) { return turnAboutY(0.5f + 0.8f * std::sin(phase)); }));
}

void addCamera(Scene& scene)
{
    const int camera = static_cast<int>(scene.nodes.size());
    scene.nodes.push_back(makeNode("camera", kNone, glm::vec3(0.0f), 0.0f));
    scene.nodes.back().camera = 0;
    scene.cameras.push_back({0.9f, 0.05f});
    scene.channels.push_back(makeChannel(camera, AnimationPath::Translation, 3, kDuration,
                                         [](float phase) { return glm::vec3(0.35f * std::sin(phase), 1.45f, 3.1f); }));
    scene.channels.push_back(makeChannel(camera, AnimationPath::Rotation, 4, kDuration,
                                         [](float phase) { return turnAndTilt(0.06f * std::sin(phase), -0.08f); }));
}

Scene makeEmpty(const char* name)
{
    Scene scene;
    scene.name = name;
    scene.textures = {makePattern(glm::vec3(0.85f), glm::vec3(0.35f, 0.4f, 0.45f), 8),
                      makePattern(glm::vec3(0.85f, 0.65f, 0.3f), glm::vec3(0.5f, 0.12f, 0.15f), 16)};
    scene.materials = makeMaterials();
    scene.meshes = makeMeshes();
    scene.duration = kDuration;
    return scene;
}
} // namespace

Scene makeMirrorYard()
{
    Scene scene = makeEmpty("mirror");
    addYard(scene, kNone);
    scene.nodes.push_back(makeNode("mirror", Glass, glm::vec3(0.0f), 0.0f));
    addCamera(scene);
    return scene;
}

Scene makeMirrorTwin()
{
    Scene scene = makeEmpty("mirror's twin");
    addYard(scene, kNone);
    scene.nodes.push_back(makeNode("mirrored", kNone, glm::vec3(0.0f), 0.0f));
    scene.nodes.back().scale = glm::vec3(1.0f, 1.0f, -1.0f);
    addYard(scene, static_cast<int>(scene.nodes.size()) - 1);
    addCamera(scene);
    return scene;
}
} // namespace sample
