#include "scene_bumps.h"
#include "scene_shapes.h"

#include <cmath>

namespace sample
{
namespace
{
constexpr float kHalfWidth = 2.4f; // of the room, metres
constexpr float kHeight = 2.6f;
constexpr float kHalfDepth = 2.4f;
constexpr float kDuration = 8.0f;
constexpr float kTile = 0.4f; // metres that one repetition of the relief spans
constexpr int kTextureSize = 256;
constexpr int kStuds = 4; // per tile and side

enum MaterialIndex
{
    White,
    Rubber,
    Metal,
    Lamp
};

// Height in tiles, at (u, v) in tiles: studs with flat gaps between them.
float height(float u, float v)
{
    const glm::vec2 p = glm::fract(glm::vec2(u, v) * float(kStuds)) - 0.5f;
    const float dome = std::max(0.0f, 1.0f - glm::dot(p, p) / 0.2f);
    return 0.03f * dome * dome;
}

Texture makeNormalMap()
{
    Texture texture;
    texture.width = texture.height = kTextureSize;
    constexpr float kStep = 1.0f / float(kTextureSize);
    for (int y = 0; y < kTextureSize; ++y)
        for (int x = 0; x < kTextureSize; ++x)
        {
            const float u = (float(x) + 0.5f) * kStep, v = (float(y) + 0.5f) * kStep;
            const float du = (height(u + 0.5f * kStep, v) - height(u - 0.5f * kStep, v)) / kStep;
            const float dv = (height(u, v + 0.5f * kStep) - height(u, v - 0.5f * kStep)) / kStep;
            const glm::vec3 n = glm::normalize(glm::vec3(-du, -dv, 1.0f)) * 0.5f + 0.5f;
            for (int c = 0; c < 3; ++c) texture.rgba.push_back(static_cast<uint8_t>(std::lround(n[c] * 255.0f)));
            texture.rgba.push_back(255);
        }
    return texture;
}

std::vector<Material> makeMaterials()
{
    std::vector<Material> materials = {
        makeMaterial("white", glm::vec3(0.2f), 0.0f, 0.9f),
        makeMaterial("rubber", glm::vec3(0.6f, 0.4f, 0.3f), 0.0f, 0.6f),
        makeMaterial("metal", glm::vec3(0.9f, 0.8f, 0.65f), 1.0f, 0.35f),
        makeMaterial("lamp", glm::vec3(0.8f), 0.0f, 1.0f),
    };
    for (MaterialIndex i : {Rubber, Metal})
    {
        TextureUse& use = materials[i].normalTexture;
        use.texture = 0;
        use.scale = glm::vec2(1.0f / kTile);
    }
    materials[Lamp].emission = glm::vec3(14.0f, 12.5f, 10.5f);
    return materials;
}

// Rubber but for the right half of the back wall, which is metal.
Mesh makeRoom()
{
    const glm::vec3 low(-kHalfWidth, 0.0f, -kHalfDepth), high(kHalfWidth, kHeight, kHalfDepth);
    const glm::vec3 x(2 * kHalfWidth, 0, 0), y(0, kHeight, 0), z(0, 0, 2 * kHalfDepth), half = 0.5f * x;
    Mesh mesh;
    mesh.primitives.push_back(makeQuad(Rubber, low, z, x));
    mesh.primitives.push_back(makeQuad(Rubber, low, half, y));
    mesh.primitives.push_back(makeQuad(Metal, low + half, half, y));
    mesh.primitives.push_back(makeQuad(White, high, -x, -z)); // ceiling
    mesh.primitives.push_back(makeQuad(White, high, -y, -x)); // behind the camera
    mesh.primitives.push_back(makeQuad(Rubber, low, y, z));
    mesh.primitives.push_back(makeQuad(Rubber, high, -z, -y));
    // On the left wall, so low that its light grazes the floor.
    const glm::vec3 corner(-kHalfWidth + 0.02f, 0.5f, -1.4f);
    mesh.primitives.push_back(makeQuad(Lamp, corner, glm::vec3(0, 1.0f, 0), glm::vec3(0, 0, 2.0f)));
    return mesh;
}
} // namespace

Scene makeBumps()
{
    Scene scene;
    scene.name = "bumps";
    scene.textures.push_back(makeNormalMap());
    scene.materials = makeMaterials();
    scene.meshes.push_back(makeRoom());
    scene.nodes.push_back(makeNode("room", 0, glm::vec3(0.0f), 0.0f));
    scene.nodes.push_back(makeNode("camera", kNone, glm::vec3(0.0f, 1.5f, 2.2f), 0.0f));
    scene.nodes.back().camera = 0;
    scene.cameras.push_back({0.85f, 0.05f});
    scene.channels.push_back(makeChannel(1, AnimationPath::Translation, 3, kDuration,
                                         [](float phase) { return glm::vec3(0.3f * std::sin(phase), 1.5f, 2.2f); }));
    scene.channels.push_back(makeChannel(1, AnimationPath::Rotation, 4, kDuration,
                                         [](float phase) { return turnAndTilt(0.05f * std::sin(phase), -0.38f); }));
    scene.duration = kDuration;
    return scene;
}
} // namespace sample
