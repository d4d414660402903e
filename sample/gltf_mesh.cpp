#include "gltf_accessor.h"
#include "gltf_parts.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tiny_gltf.h>

namespace sample
{
namespace
{
using Attributes = std::map<std::string, int>;

// What a primitive is read with: its model, its place for errors, and the number of its vertices.
struct Source
{
    const tinygltf::Model& model;
    std::string what; // "mesh 3 'name', primitive 1"
    size_t vertexCount = 0;
};

// V is a float vector of `N` components; a missing attribute gives an empty array.
template <class V> std::vector<V> readVectors(const Source& source, const Attributes& attributes, const char* name)
{
    constexpr uint32_t kSize = static_cast<uint32_t>(V::length());
    const auto found = attributes.find(name);
    if (found == attributes.end()) return {};
    const std::string what = source.what + ", " + name;
    const AccessorData<float> data = readFloats(source.model, found->second, what);
    // COLOR_0 may have three components; the fourth is then 1.
    if (data.componentCount != kSize && !(kSize == 4 && data.componentCount == 3))
        throw SceneError(what + ": its accessor has " + std::to_string(data.componentCount) + " components");
    if (source.vertexCount != 0 && data.count != source.vertexCount)
        throw SceneError(what + ": it has " + std::to_string(data.count) + " elements for " +
                         std::to_string(source.vertexCount) + " vertices");
    std::vector<V> vectors(data.count, V(1.0f));
    for (size_t i = 0; i < data.count; ++i)
        for (uint32_t c = 0; c < data.componentCount; ++c)
            vectors[i][int(c)] = data.values[i * data.componentCount + c];
    return vectors;
}

std::vector<glm::uvec4> readJoints(const Source& source, const Attributes& attributes)
{
    const auto found = attributes.find("JOINTS_0");
    if (found == attributes.end()) return {};
    const std::string what = source.what + ", JOINTS_0";
    const AccessorData<uint32_t> data = readIntegers(source.model, found->second, what);
    if (data.componentCount != 4 || data.count != source.vertexCount)
        throw SceneError(what + ": it does not have four joints for each vertex");
    std::vector<glm::uvec4> joints(data.count);
    for (size_t i = 0; i < data.count; ++i)
        for (int c = 0; c < 4; ++c) joints[i][c] = data.values[i * 4 + size_t(c)];
    return joints;
}

// Strips and fans become lists.
std::vector<uint32_t> toTriangles(const std::vector<uint32_t>& in, int mode)
{
    if (mode == TINYGLTF_MODE_TRIANGLES) return {in.begin(), in.begin() + std::ptrdiff_t(in.size() / 3 * 3)};
    std::vector<uint32_t> out;
    for (size_t i = 2; i < in.size(); ++i)
    {
        const bool isFan = mode == TINYGLTF_MODE_TRIANGLE_FAN;
        const size_t odd = i % 2; // every second triangle of a strip turns the other way round
        out.push_back(isFan ? in[0] : in[i - 2 + odd]);
        out.push_back(isFan ? in[i - 1] : in[i - 1 - odd]);
        out.push_back(in[i]);
    }
    return out;
}

std::vector<uint32_t> readIndices(const Source& source, const tinygltf::Primitive& primitive)
{
    std::vector<uint32_t> indices(source.vertexCount);
    std::iota(indices.begin(), indices.end(), 0u);
    if (primitive.indices >= 0)
        indices = readIntegers(source.model, primitive.indices, source.what + ", indices").values;
    for (size_t i = 0; i < indices.size(); ++i)
    {
        if (indices[i] >= source.vertexCount)
            throw SceneError(source.what + ": index " + std::to_string(i) + " refers to vertex " +
                             std::to_string(indices[i]) + " of " + std::to_string(source.vertexCount));
    }
    return toTriangles(indices, primitive.mode);
}

// Without normals glTF asks for flat shading: every triangle gets its own vertices.
void unshareVertices(Primitive& p)
{
    const auto spread = [&](auto& values)
    {
        if (values.empty()) return;
        auto copy = values;
        copy.resize(p.indices.size());
        for (size_t i = 0; i < p.indices.size(); ++i) copy[i] = values[p.indices[i]];
        values = std::move(copy);
    };
    for (MorphTarget& target : p.targets)
    {
        spread(target.positions);
        target.normals.clear();
    }
    for (auto& coords : p.texCoords) spread(coords);
    spread(p.tangents);
    spread(p.colors);
    spread(p.joints);
    spread(p.weights);
    spread(p.positions);
    std::iota(p.indices.begin(), p.indices.end(), 0u);
}

void computeFlatNormals(Primitive& p)
{
    unshareVertices(p);
    p.normals.resize(p.positions.size());
    for (size_t i = 0; i + 2 < p.indices.size(); i += 3)
    {
        const glm::vec3 cross = glm::cross(p.positions[i + 1] - p.positions[i], p.positions[i + 2] - p.positions[i]);
        const float length = glm::length(cross);
        const glm::vec3 normal = length > 0.0f ? cross / length : glm::vec3(0.0f, 1.0f, 0.0f);
        std::fill_n(p.normals.begin() + std::ptrdiff_t(i), 3, normal);
    }
}

glm::vec3 anyPerpendicular(const glm::vec3& n)
{
    return glm::normalize(std::abs(n.x) > 0.7f ? glm::vec3(-n.y, n.x, 0.0f) : glm::vec3(0.0f, -n.z, n.y));
}

// Along +U, averaged over the triangles of a vertex (the file may leave tangents to us).
void computeTangents(Primitive& p, int texCoord)
{
    const std::vector<glm::vec2>& uv = p.texCoords[size_t(texCoord)];
    std::vector<glm::vec3> along(p.positions.size(), glm::vec3(0.0f)), across = along;
    for (size_t i = 0; i + 2 < p.indices.size() && !uv.empty(); i += 3)
    {
        const uint32_t* v = &p.indices[i];
        const glm::vec3 e1 = p.positions[v[1]] - p.positions[v[0]], e2 = p.positions[v[2]] - p.positions[v[0]];
        const glm::vec2 d1 = uv[v[1]] - uv[v[0]], d2 = uv[v[2]] - uv[v[0]];
        const float area = d1.x * d2.y - d2.x * d1.y;
        if (std::abs(area) < 1e-20f) continue;
        for (int c = 0; c < 3; ++c)
        {
            along[v[c]] += (e1 * d2.y - e2 * d1.y) / area;
            across[v[c]] += (e2 * d1.x - e1 * d2.x) / area;
        }
    }
    p.tangents.resize(p.positions.size());
    for (size_t i = 0; i < p.positions.size(); ++i)
    {
        const glm::vec3 n = p.normals[i];
        const glm::vec3 t = along[i] - n * glm::dot(n, along[i]);
        const float length = glm::length(t);
        const bool isGood = length > 1e-20f && std::isfinite(length);
        // The V axis of glTF points down the picture, so the bitangent is the derivative by V itself.
        const float sign = glm::dot(glm::cross(n, t), across[i]) < 0.0f ? -1.0f : 1.0f;
        p.tangents[i] = isGood ? glm::vec4(t / length, sign) : glm::vec4(anyPerpendicular(n), 1.0f);
    }
}

void readTargets(const Source& source, const tinygltf::Primitive& primitive, Primitive& out)
{
    for (const Attributes& attributes : primitive.targets)
    {
        MorphTarget target;
        target.positions = readVectors<glm::vec3>(source, attributes, "POSITION");
        target.normals = readVectors<glm::vec3>(source, attributes, "NORMAL");
        out.targets.push_back(std::move(target));
    }
}

void normalizeAll(Primitive& p)
{
    for (glm::vec3& n : p.normals)
    {
        const float length = glm::length(n);
        n = length > 1e-12f && std::isfinite(length) ? n / length : glm::vec3(0.0f, 1.0f, 0.0f);
    }
    for (glm::vec4& w : p.weights)
    {
        const float sum = w.x + w.y + w.z + w.w;
        w = sum > 1e-12f && std::isfinite(sum) ? w / sum : glm::vec4(1.0f, 0.0f, 0.0f, 0.0f);
    }
}

int materialIndex(const Source& source, int index, const Scene& scene)
{
    if (index < 0) return int(scene.materials.size()) - 1; // readMaterials() put the default there
    if (size_t(index) + 1 >= scene.materials.size())
        throw SceneError(source.what + " uses material " + std::to_string(index) + ", which does not exist");
    return index;
}

Primitive readPrimitive(Source source, const tinygltf::Primitive& in, const Scene& scene)
{
    Primitive out;
    out.material = materialIndex(source, in.material, scene);
    if (in.attributes.find("POSITION") == in.attributes.end()) throw SceneError(source.what + " has no positions");
    out.positions = readVectors<glm::vec3>(source, in.attributes, "POSITION");
    source.vertexCount = out.positions.size();
    if (source.vertexCount == 0) return out;
    out.normals = readVectors<glm::vec3>(source, in.attributes, "NORMAL");
    out.tangents = readVectors<glm::vec4>(source, in.attributes, "TANGENT");
    out.texCoords[0] = readVectors<glm::vec2>(source, in.attributes, "TEXCOORD_0");
    out.texCoords[1] = readVectors<glm::vec2>(source, in.attributes, "TEXCOORD_1");
    out.colors = readVectors<glm::vec4>(source, in.attributes, "COLOR_0");
    out.joints = readJoints(source, in.attributes);
    out.weights = readVectors<glm::vec4>(source, in.attributes, "WEIGHTS_0");
    if (out.joints.empty() != out.weights.empty())
        throw SceneError(source.what + " has joints or weights, but not both");
    readTargets(source, in, out);
    out.indices = readIndices(source, in);
    if (out.normals.empty()) computeFlatNormals(out);
    normalizeAll(out);
    const TextureUse& normalMap = scene.materials[size_t(out.material)].normalTexture;
    if (out.tangents.empty() && normalMap.texture >= 0) computeTangents(out, normalMap.texCoord);
    return out;
}

bool isTriangles(int mode)
{
    return mode == TINYGLTF_MODE_TRIANGLES || mode == TINYGLTF_MODE_TRIANGLE_STRIP ||
           mode == TINYGLTF_MODE_TRIANGLE_FAN;
}
} // namespace

void readMeshes(const tinygltf::Model& model, Scene& scene)
{
    for (size_t m = 0; m < model.meshes.size(); ++m)
    {
        Mesh mesh;
        for (double weight : model.meshes[m].weights) mesh.weights.push_back(float(weight));
        for (size_t i = 0; i < model.meshes[m].primitives.size(); ++i)
        {
            const tinygltf::Primitive& in = model.meshes[m].primitives[i];
            // tinygltf leaves -1 where the file names no mode
            tinygltf::Primitive copy = in;
            if (copy.mode < 0) copy.mode = TINYGLTF_MODE_TRIANGLES;
            if (!isTriangles(copy.mode)) continue;
            const Source source = {model, "mesh " + std::to_string(m) + ", primitive " + std::to_string(i), 0};
            Primitive primitive = readPrimitive(source, copy, scene);
            if (!primitive.indices.empty()) mesh.primitives.push_back(std::move(primitive));
        }
        scene.meshes.push_back(std::move(mesh));
    }
}
} // namespace sample
