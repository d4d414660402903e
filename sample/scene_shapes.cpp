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

Primitive makeBlock(int material, const glm::vec3& size)
{
    const glm::vec3 x(size.x, 0, 0), y(0, size.y, 0), z(0, 0, size.z);
    const glm::vec3 low = -0.5f * (x + z), high = low + x + y + z;
    Primitive p;
    p.material = material;
    addQuad(p, low, x, z);    // bottom
    addQuad(p, low, y, x);    // back
    addQuad(p, low, z, y);    // left
    addQuad(p, high, -z, -x); // top
    addQuad(p, high, -x, -y); // front
    addQuad(p, high, -y, -z); // right
    return p;
}

Primitive makeSphere(const glm::vec3& center, float radius, int material)
{
    constexpr int kRows = 32, kColumns = 64;
    Primitive p;
    p.material = material;
    for (int y = 0; y <= kRows; ++y)
        for (int x = 0; x <= kColumns; ++x)
        {
            const float theta = 3.14159265f * float(y) / kRows, phi = 6.2831853f * float(x) / kColumns;
            const glm::vec3 n(std::sin(theta) * std::cos(phi), std::cos(theta), -std::sin(theta) * std::sin(phi));
            p.positions.push_back(center + radius * n);
            p.normals.push_back(n);
        }
    for (int y = 0; y < kRows; ++y)
        for (int x = 0; x < kColumns; ++x)
        {
            const auto a = static_cast<uint32_t>(y * (kColumns + 1) + x), b = a + kColumns + 1;
            for (uint32_t i : {a, b, b + 1, a, b + 1, a + 1}) p.indices.push_back(i);
        }
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
