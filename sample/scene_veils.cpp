#include "scene_veils.h"
#include "scene_shapes.h"

#include <cmath>

namespace sample
{
namespace
{
constexpr float kDuration = 4.0f;
constexpr float kSway = 0.25f; // metres to either side
constexpr float kWall = -1.2f; // its z; the things move at z = 0
constexpr float kRoof = 1.7f;  // its height; it leaves the wall in the dark
constexpr int kTextureSize = 128;
constexpr int kHoles = 4; // of the grille, per side
constexpr float kStalkHeight = 1.4f;
constexpr float kStalkRadius = 0.14f;
constexpr int kRings = 12, kSides = 16;

enum MaterialIndex
{
    Wall,
    Floor,
    Glass,
    Pane,
    Grille,
    Stalk
};

enum TextureIndex
{
    Chequers,
    Holes
};

enum NodeIndex
{
    Stage,
    Ball,
    Sheet,
    Grid,
    Plant,
    Root,
    Joint,
    Eye
};

template <class F> Texture makeTexture(F rgba)
{
    Texture texture;
    texture.width = texture.height = kTextureSize;
    for (int y = 0; y < kTextureSize; ++y)
        for (int x = 0; x < kTextureSize; ++x)
        {
            const glm::vec4 color = rgba((float(x) + 0.5f) / kTextureSize, (float(y) + 0.5f) / kTextureSize);
            for (int c = 0; c < 4; ++c) texture.rgba.push_back(static_cast<uint8_t>(std::lround(color[c] * 255.0f)));
        }
    return texture;
}

std::vector<Texture> makeTextures()
{
    const auto chequers = [](float u, float v)
    {
        const bool isFirst = (int(u * 4.0f) ^ int(v * 4.0f)) & 1;
        return glm::vec4(isFirst ? glm::vec3(0.9f, 0.75f, 0.4f) : glm::vec3(0.25f, 0.3f, 0.5f), 1.0f);
    };
    const auto holes = [](float u, float v)
    {
        const glm::vec2 p = glm::fract(glm::vec2(u, v) * float(kHoles)) - 0.5f;
        return glm::vec4(0.8f, 0.85f, 0.9f, glm::length(p) > 0.34f ? 1.0f : 0.0f);
    };
    return {makeTexture(chequers), makeTexture(holes)};
}

std::vector<Material> makeMaterials()
{
    std::vector<Material> materials = {
        makeMaterial("wall", glm::vec3(1.0f), 0.0f, 0.8f),
        makeMaterial("floor", glm::vec3(0.55f, 0.5f, 0.45f), 0.0f, 0.5f),
        makeMaterial("glass", glm::vec3(0.95f, 1.0f, 0.97f), 0.0f, 0.0f),
        makeMaterial("pane", glm::vec3(0.9f, 0.25f, 0.15f), 0.0f, 0.2f),
        makeMaterial("grille", glm::vec3(1.0f), 0.0f, 0.6f),
        makeMaterial("stalk", glm::vec3(0.3f, 0.6f, 0.2f), 0.0f, 0.6f),
    };
    materials[Wall].baseColorTexture.texture = Chequers;
    materials[Grille].baseColorTexture.texture = Holes;
    materials[Grille].baseColorTexture.scale = glm::vec2(1.0f / 0.8f);
    materials[Grille].alphaCutoff = 0.5f;
    materials[Grille].isDoubleSided = true;
    materials[Glass].isGlass = true;
    materials[Pane].isBlended = true;
    materials[Pane].baseColor.a = 0.4f;
    materials[Pane].alphaCutoff = 0.5f;
    materials[Pane].isDoubleSided = true;
    return materials;
}

// Standing on the origin, its upper half on the second joint.
Primitive makeStalk()
{
    Primitive p;
    p.material = Stalk;
    for (int ring = 0; ring <= kRings; ++ring)
        for (int side = 0; side < kSides; ++side)
        {
            const float height = kStalkHeight * float(ring) / float(kRings);
            const float angle = 6.28318531f * float(side) / float(kSides);
            const glm::vec3 out(std::cos(angle), 0.0f, std::sin(angle));
            const float bend = glm::smoothstep(0.3f, 0.7f, height / kStalkHeight);
            p.positions.push_back(out * kStalkRadius + glm::vec3(0, height, 0));
            p.normals.push_back(out);
            p.joints.emplace_back(0, 1, 0, 0);
            p.weights.emplace_back(1.0f - bend, bend, 0.0f, 0.0f);
        }
    for (int ring = 0; ring < kRings; ++ring)
        for (int side = 0; side < kSides; ++side)
        {
            const uint32_t a = uint32_t(ring * kSides + side), b = uint32_t(ring * kSides + (side + 1) % kSides);
            for (uint32_t i : {a, a + kSides, b, b, a + kSides, b + kSides}) p.indices.push_back(i);
        }
    return p;
}

std::vector<Mesh> makeMeshes()
{
    const auto upright = [](int material)
    { return makeQuad(material, glm::vec3(-0.4f, 0, 0), glm::vec3(0.8f, 0, 0), glm::vec3(0, 0.8f, 0)); };
    return {{{makeQuad(Wall, glm::vec3(-6, 0, kWall), glm::vec3(12, 0, 0), glm::vec3(0, kRoof, 0)),
              makeQuad(Floor, glm::vec3(-6, 0, kWall), glm::vec3(0, 0, 8), glm::vec3(12, 0, 0)),
              makeQuad(Floor, glm::vec3(-6, kRoof, kWall), glm::vec3(12, 0, 0), glm::vec3(0, 0, 0.9f))},
             {}},
            {{makeSphere(glm::vec3(0.0f), 0.42f, Glass)}, {}},
            {{upright(Pane)}, {}},
            {{upright(Grille)}, {}},
            {{makeStalk()}, {}}};
}

void addStalk(Scene& scene)
{
    Skin skin;
    skin.joints = {Root, Joint};
    skin.inverseBind = {glm::mat4(1.0f), glm::mat4(1.0f)};
    skin.inverseBind[1][3] = glm::vec4(0.0f, -0.5f * kStalkHeight, 0.0f, 1.0f);
    scene.skins.push_back(skin);
    scene.nodes.push_back(makeNode("stalk", 4, glm::vec3(0.0f), 0.0f));
    scene.nodes[Plant].skin = 0;
    scene.nodes.push_back(makeNode("root", kNone, glm::vec3(kVeilPlaces[3], 0.0f, 0.0f), 0.0f));
    scene.nodes.push_back(makeNode("joint", kNone, glm::vec3(0.0f, 0.5f * kStalkHeight, 0.0f), 0.0f));
    scene.nodes[Joint].parent = Root;
    const auto lean = [](float phase)
    {
        const glm::quat q = glm::angleAxis(0.7f * std::sin(phase), glm::vec3(0, 0, 1));
        return glm::vec4(q.x, q.y, q.z, q.w);
    };
    scene.channels.push_back(makeChannel(Joint, AnimationPath::Rotation, 4, kDuration, lean));
}

void addThing(Scene& scene, const char* name, int mesh, float height)
{
    const float place = kVeilPlaces[mesh - 1];
    const int node = static_cast<int>(scene.nodes.size());
    scene.nodes.push_back(makeNode(name, mesh, glm::vec3(0.0f), 0.0f));
    scene.channels.push_back(makeChannel(node, AnimationPath::Translation, 3, kDuration,
                                         [=](float phase)
                                         { return glm::vec3(place + kSway * std::sin(phase), height, 0.0f); }));
}
} // namespace

Scene makeVeils()
{
    Scene scene;
    scene.name = "veils";
    scene.textures = makeTextures();
    scene.materials = makeMaterials();
    scene.meshes = makeMeshes();
    scene.nodes.push_back(makeNode("stage", 0, glm::vec3(0.0f), 0.0f));
    addThing(scene, "glass ball", 1, 0.7f);
    addThing(scene, "pane", 2, 0.35f);
    addThing(scene, "grille", 3, 0.35f);
    addStalk(scene);
    scene.nodes.push_back(makeNode("camera", kNone, glm::vec3(0.0f, 0.85f, 4.6f), 0.0f));
    scene.nodes[Eye].camera = 0;
    scene.cameras.push_back({0.42f, 0.05f});
    scene.duration = kDuration;
    return scene;
}
} // namespace sample
