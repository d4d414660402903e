#include "scene_shapes.h"

#include <cmath>

namespace sample
{
Material makeMaterial(const char* name, const glm::vec3& color, float metallic, float roughness)
{
    Material m;
    m.name = name;
    m.baseColor = glm::vec4(color, 1.0f);
    m.metallic = metallic;
    m.roughness = roughness;
    return m;
}

void addQuad(Primitive& p, const glm::vec3& origin, const glm::vec3& u, const glm::vec3& v)
{
    const auto first = static_cast<uint32_t>(p.positions.size());
    const glm::vec3 normal = glm::normalize(glm::cross(u, v));
    const glm::vec2 size(glm::length(u), glm::length(v));
    for (const glm::vec2& corner : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)})
    {
        p.positions.push_back(origin + u * corner.x + v * corner.y);
        p.normals.push_back(normal);
        p.tangents.emplace_back(glm::normalize(u), 1.0f);
        p.texCoords[0].push_back(corner * size);
    }
    for (uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) p.indices.push_back(first + i);
}

Primitive makeQuad(int material, const glm::vec3& origin, const glm::vec3& u, const glm::vec3& v)
{
    Primitive p;
    p.material = material;
    addQuad(p, origin, u, v);
    return p;
}

glm::vec4 turnAboutY(float angle) { return {0.0f, std::sin(0.5f * angle), 0.0f, std::cos(0.5f * angle)}; }

glm::vec4 turnAndTilt(float angle, float tilt)
{
    const glm::quat turn = glm::angleAxis(angle, glm::vec3(0, 1, 0)), pitch = glm::angleAxis(tilt, glm::vec3(1, 0, 0));
    const glm::quat q = turn * pitch;
    return {q.x, q.y, q.z, q.w};
}

Node makeNode(const char* name, int mesh, const glm::vec3& translation, float angle)
{
    Node node;
    node.name = name;
    node.mesh = mesh;
    node.translation = translation;
    const glm::vec4 q = turnAboutY(angle);
    node.rotation = glm::quat(q.w, q.x, q.y, q.z);
    return node;
}
} // namespace sample
