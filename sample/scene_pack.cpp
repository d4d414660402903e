#include "scene_pack.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <glm/gtc/packing.hpp>

namespace sample
{
namespace
{
uint32_t bits(float x) { return std::bit_cast<uint32_t>(x); }
glm::uvec4 words(const glm::vec3& v, uint32_t w) { return {bits(v.x), bits(v.y), bits(v.z), w}; }
glm::uvec4 words(const glm::vec4& v) { return words(glm::vec3(v), bits(v.w)); }

glm::vec2 octEncode(const glm::vec3& n)
{
    const glm::vec3 a = glm::abs(n);
    glm::vec2 e = glm::vec2(n) / std::max(a.x + a.y + a.z, 1e-20f);
    if (n.z < 0.0f)
        e = (1.0f - glm::vec2(std::abs(e.y), std::abs(e.x))) *
            glm::vec2(e.x >= 0.0f ? 1.0f : -1.0f, e.y >= 0.0f ? 1.0f : -1.0f);
    return e;
}

uint32_t packNormal(const glm::vec3& n) { return glm::packSnorm2x16(octEncode(n)); }

// Bit 16, the lowest of y, is the bitangent's sign.
uint32_t packTangent(const glm::vec4& t)
{
    const uint32_t direction = glm::packSnorm2x16(octEncode(glm::vec3(t))) & 0xFFFEFFFFu;
    return direction | (t.w < 0.0f ? 0x00010000u : 0u);
}

void appendTexture(const TextureUse& use, const Scene& scene, const PackedTexels& texels, Words& out)
{
    if (use.texture == kNone)
    {
        out.insert(out.end(), {glm::uvec4(0xFFFFFFFFu, 1, 1, 1u << 8), glm::uvec4(0), glm::uvec4(0)});
        return;
    }
    const auto index = size_t(use.texture);
    const Texture& texture = scene.textures[index];
    const uint32_t flags = static_cast<uint32_t>(use.wrapU) | static_cast<uint32_t>(use.wrapV) << 2 |
                           static_cast<uint32_t>(use.texCoord) << 4 | texels.mipCount[index] << 8;
    out.emplace_back(texels.firstTexel[index], texture.width, texture.height, flags);
    // KHR_texture_transform: scale, then turn, then shift.
    const float c = std::cos(use.rotation), s = std::sin(use.rotation);
    out.push_back(words(glm::vec4(c * use.scale.x, s * use.scale.y, -s * use.scale.x, c * use.scale.y)));
    out.push_back(words(glm::vec4(use.offset, 0.0f, 0.0f)));
}

struct Picture
{
    int width;
    int height;
    std::vector<uint8_t> rgba;
};

// Each texel of the next mip is the mean of four (or fewer at an edge).
Picture halve(const Picture& in)
{
    Picture out = {std::max(in.width / 2, 1), std::max(in.height / 2, 1), {}};
    for (int y = 0; y < out.height; ++y)
        for (int x = 0; x < out.width; ++x)
            for (int c = 0; c < 4; ++c)
            {
                uint32_t sum = 0;
                for (int k = 0; k < 4; ++k)
                {
                    const int sx = std::min(2 * x + (k & 1), in.width - 1),
                              sy = std::min(2 * y + (k >> 1), in.height - 1);
                    sum += in.rgba[(size_t(sy) * size_t(in.width) + size_t(sx)) * 4 + size_t(c)];
                }
                out.rgba.push_back(static_cast<uint8_t>((sum + 2) / 4));
            }
    return out;
}

double smithLambdaTerm(double cosine, double a2) { return std::sqrt(a2 + (1.0 - a2) * cosine * cosine); }

// One visible normal (Dupuy and Benyoub 2023) for the view (sqrt(1 - v^2), 0, v): returns its weight, -1 below ground.
double visibleNormalWeight(double v, double alpha, double u1, double u2, double& fresnelTerm)
{
    const double sine = std::sqrt(std::max(0.0, 1.0 - v * v));
    const double length = std::hypot(sine * alpha, v);
    const double sx = sine * alpha / length, sz = v / length;
    const double z = (1.0 - u2) * (1.0 + sz) - sz;
    const double r = std::sqrt(std::max(0.0, 1.0 - z * z)), phi = 6.283185307179586 * u1;
    const double hx = (r * std::cos(phi) + sx) * alpha, hy = r * std::sin(phi) * alpha, hz = std::max(z + sz, 0.0);
    const double scale = 1.0 / std::sqrt(hx * hx + hy * hy + hz * hz);
    const double voh = (sine * hx + v * hz) * scale;
    const double l = 2.0 * voh * hz * scale - v;
    if (l <= 0.0) return -1.0;
    fresnelTerm = std::pow(std::max(0.0, 1.0 - voh), 5.0);
    const double a2 = alpha * alpha;
    // Height-correlated masking-shadowing over masking.
    return l * (v + smithLambdaTerm(v, a2)) / (v * smithLambdaTerm(l, a2) + l * smithLambdaTerm(v, a2));
}
} // namespace

PackedTexels packTexels(const Scene& scene)
{
    PackedTexels out;
    for (const Texture& texture : scene.textures)
    {
        out.firstTexel.push_back(static_cast<uint32_t>(out.rgba.size() / 4));
        Picture mip = {texture.width, texture.height, texture.rgba};
        uint32_t count = 1;
        out.rgba.insert(out.rgba.end(), mip.rgba.begin(), mip.rgba.end());
        for (; mip.width > 1 || mip.height > 1; ++count)
        {
            mip = halve(mip);
            out.rgba.insert(out.rgba.end(), mip.rgba.begin(), mip.rgba.end());
        }
        out.mipCount.push_back(count);
    }
    if (out.rgba.empty()) out.rgba.assign(4, 255); // a buffer cannot be empty
    return out;
}

Words packMaterials(const Scene& scene, const PackedTexels& texels)
{
    Words out;
    for (const Material& m : scene.materials)
    {
        out.push_back(words(m.baseColor));
        // No bounce ends at glass.
        out.push_back(words(m.emission, bits(m.isGlass ? 2.0f : m.alphaCutoff)));
        out.push_back(words(glm::vec4(m.metallic, m.roughness, m.normalScale, m.isDoubleSided ? 1.0f : 0.0f)));
        for (const TextureUse* use :
             {&m.baseColorTexture, &m.metallicRoughnessTexture, &m.normalTexture, &m.emissiveTexture})
            appendTexture(*use, scene, texels, out);
        out.emplace_back(m.isBlended || m.isGlass, m.isGlass, bits(m.ior), m.isSolidGlass);
    }
    return out;
}

std::vector<TrianglePositions> trianglePositions(const ScenePose& pose)
{
    std::vector<TrianglePositions> out;
    out.reserve(pose.triangles.size());
    for (const PosedTriangle& t : pose.triangles)
        out.push_back({{pose.positions[t.vertices[0]], pose.positions[t.vertices[1]], pose.positions[t.vertices[2]]}});
    return out;
}

PackedGeometry packGeometry(const ScenePose& pose, const Bvh& bvh, const SceneLights& lights)
{
    PackedGeometry out;
    static_assert(sizeof(BvhNode) == 2 * sizeof(glm::uvec4));
    out.nodes.resize(bvh.nodes.size() * 2);
    std::memcpy(out.nodes.data(), bvh.nodes.data(), bvh.nodes.size() * sizeof(BvhNode));
    std::vector<uint32_t> lightOf(pose.triangles.size(), 0);
    for (size_t i = 0; i < lights.lights.size(); ++i)
        if (lights.lights[i].kind == LightKind::Triangle)
            lightOf[lights.lights[i].triangle] = static_cast<uint32_t>(i + 1);
    for (uint32_t index : bvh.triangleOrder)
    {
        const PosedTriangle& t = pose.triangles[index];
        const glm::vec3 a = pose.positions[t.vertices[0]];
        out.triangles.push_back(words(a, t.material));
        out.triangles.push_back(words(pose.positions[t.vertices[1]] - a, 0));
        out.triangles.push_back(words(pose.positions[t.vertices[2]] - a, lightOf[index]));
        for (int c = 0; c < 3; ++c)
        {
            const uint32_t v = t.vertices[c];
            const auto& uv = pose.texCoords[v];
            out.vertices.emplace_back(packNormal(pose.normals[v]), packTangent(pose.tangents[v]), bits(uv[0].x),
                                      bits(uv[0].y));
            out.vertices.emplace_back(bits(uv[1].x), bits(uv[1].y),
                                      glm::packUnorm4x8(glm::clamp(pose.colors[v], 0.0f, 1.0f)), 0);
            out.motion.push_back(words(pose.previous[v] - pose.positions[v], 0));
        }
    }
    return out;
}

Words packLights(const SceneLights& lights, const Bvh& bvh)
{
    std::vector<uint32_t> leafPosition(bvh.triangleOrder.size());
    for (size_t i = 0; i < bvh.triangleOrder.size(); ++i) leafPosition[bvh.triangleOrder[i]] = static_cast<uint32_t>(i);
    Words out;
    for (size_t i = 0; i < lights.lights.size(); ++i)
    {
        const SceneLight& light = lights.lights[i];
        const AliasEntry& entry = lights.table[i];
        out.emplace_back(static_cast<uint32_t>(light.kind), bits(entry.probability), bits(entry.threshold),
                         entry.alias);
        if (light.kind == LightKind::Triangle)
            out.emplace_back(leafPosition[light.triangle], 0, 0, 0);
        else
            out.push_back(words(light.position, bits(light.source.range)));
        out.push_back(words(light.direction, bits(light.source.innerCosine)));
        out.push_back(words(light.source.intensity, bits(light.source.outerCosine)));
        const bool isSun = light.kind == LightKind::Directional;
        const AliasEntry& primary = lights.primaryTable[i];
        out.emplace_back(bits(isSun ? light.source.tanAngularRadius : light.source.radius), bits(primary.probability),
                         bits(primary.threshold), primary.alias);
    }
    if (out.empty()) out.emplace_back(0);
    return out;
}

Words packEnvironment(const Environment& environment)
{
    Words out;
    for (size_t i = 0; i < environment.radiance.size(); ++i)
    {
        const AliasEntry& entry = environment.alias[i];
        const int row = static_cast<int>(i / size_t(environment.width));
        const double density = double(entry.probability) / texelSolidAngle(environment.width, environment.height, row);
        out.push_back(words(environment.radiance[i], bits(static_cast<float>(density))));
        out.emplace_back(bits(entry.threshold), entry.alias, 0, 0);
    }
    return out;
}

std::vector<glm::vec4> packEnergyTable()
{
    constexpr int kSize = 32, kSteps = 48;
    std::vector<glm::vec4> table;
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x)
        {
            const double v = std::max(double(x) / (kSize - 1), 1e-3), r = std::max(double(y) / (kSize - 1), 0.03);
            double a = 0.0, b = 0.0; // albedo = a + f0 * b with Schlick's Fresnel term
            for (int i = 0; i < kSteps * kSteps; ++i)
            {
                double fresnel = 0.0;
                const double weight =
                    visibleNormalWeight(v, r * r, (i % kSteps + 0.5) / kSteps, (i / kSteps + 0.5) / kSteps, fresnel);
                a += std::max(weight, 0.0) * fresnel;
                b += std::max(weight, 0.0) * (1.0 - fresnel);
            }
            table.emplace_back(a / (kSteps * kSteps), b / (kSteps * kSteps), 0.0f, 0.0f);
        }
    return table;
}
} // namespace sample
