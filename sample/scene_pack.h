// The scene as the words the tracing shaders read (scene_data.glsl). Pure: no device.
#pragma once
#include "bvh.h"
#include "scene_lights.h"

namespace sample
{
using Words = std::vector<glm::uvec4>;

/// Textures one after the other with their mips, and where each begins.
struct PackedTexels
{
    std::vector<uint8_t> rgba;
    std::vector<uint32_t> firstTexel; // per texture
    std::vector<uint32_t> mipCount;
};
PackedTexels packTexels(const Scene& scene);

/// 16 words of 16 bytes per material.
Words packMaterials(const Scene& scene, const PackedTexels& texels);

/// World-space corners of all triangles, for the BVH.
std::vector<TrianglePositions> trianglePositions(const ScenePose& pose);

struct PackedGeometry
{
    Words nodes;     // 2 per node, eight orders
    Words triangles; // 3 per triangle
    Words vertices;  // 6 per triangle
    Words motion;    // 3 per triangle
};
PackedGeometry packGeometry(const ScenePose& pose, const Bvh& bvh, const SceneLights& lights);

/// 5 words of 16 bytes per light; `bvh` turns triangle indices into positions in the leaves.
Words packLights(const SceneLights& lights, const Bvh& bvh);

/// 2 words of 16 bytes per texel.
Words packEnvironment(const Environment& environment);

/// Directional albedo of GGX: f0 * y + x, for 32 cosines (across) and 32 linear roughnesses (down).
std::vector<glm::vec4> packEnergyTable();
} // namespace sample
