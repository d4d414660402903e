// The flattened hierarchy finds what trying every triangle finds.
#include "bvh.h"
#include "catch.h"

#include <random>
#include <set>

using namespace sample;

namespace
{
struct Ray
{
    glm::vec3 origin;
    glm::vec3 direction;
};

float hitTriangle(const Ray& ray, const TrianglePositions& t)
{
    const glm::vec3 e1 = t.corners[1] - t.corners[0], e2 = t.corners[2] - t.corners[0];
    const glm::vec3 p = glm::cross(ray.direction, e2);
    const float scale = 1.0f / glm::dot(e1, p);
    const glm::vec3 s = ray.origin - t.corners[0], q = glm::cross(s, e1);
    const float u = glm::dot(s, p) * scale, v = glm::dot(ray.direction, q) * scale, d = glm::dot(e2, q) * scale;
    return u >= 0 && v >= 0 && u + v <= 1 && d > 0 ? d : INFINITY;
}

// As traversal.glsl walks it: hit goes on, miss skips. Also counts nodes, so that a broken order cannot hide.
float walk(const Bvh& bvh, const std::vector<TrianglePositions>& triangles, const Ray& ray, size_t& visited)
{
    uint32_t octant = 0;
    for (int a = 0; a < 3; ++a) octant |= ray.direction[a] < 0.0f ? 1u << a : 0u;
    const BvhNode* nodes = &bvh.nodes[size_t(octant) * bvh.nodeCount];
    float nearest = INFINITY;
    for (uint32_t n = 0; n < bvh.nodeCount; ++visited)
    {
        const BvhNode& node = nodes[n];
        const glm::vec3 t0 = (node.lower - ray.origin) / ray.direction, t1 = (node.upper - ray.origin) / ray.direction;
        const glm::vec3 low = glm::min(t0, t1), high = glm::max(t0, t1);
        const float enter = std::max(std::max(low.x, low.y), std::max(low.z, 0.0f));
        const float leave = std::min(std::min(high.x, high.y), std::min(high.z, nearest));
        const bool isHit = enter <= leave * 1.000001f;
        if (isHit && node.leaf)
            for (uint32_t i = 0; i < (node.leaf & 7u); ++i)
                nearest = std::min(nearest, hitTriangle(ray, triangles[bvh.triangleOrder[(node.leaf >> 3) + i]]));
        n = isHit && !node.leaf ? n + 1 : node.skip;
    }
    return nearest;
}
} // namespace

TEST_CASE("every ray hits the same triangle with and without the hierarchy", "[unit]")
{
    std::mt19937 random(7);
    std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
    const auto vector = [&] { return glm::vec3(uniform(random), uniform(random), uniform(random)); };
    std::vector<TrianglePositions> triangles;
    for (int i = 0; i < 800; ++i)
    {
        const glm::vec3 center = 3.0f * vector();
        triangles.push_back({{center + 0.3f * vector(), center + 0.3f * vector(), center + 0.3f * vector()}});
    }
    BvhBuilder builder;
    const Bvh bvh = builder.build(triangles);
    REQUIRE(bvh.nodes.size() == size_t(bvh.nodeCount) * 8);
    CHECK(std::set<uint32_t>(bvh.triangleOrder.begin(), bvh.triangleOrder.end()).size() == triangles.size());
    size_t visited = 0, hits = 0;
    constexpr size_t kRays = 2000;
    for (size_t i = 0; i < kRays; ++i)
    {
        const Ray ray = {4.0f * vector(), glm::normalize(vector())};
        float expected = INFINITY;
        for (const auto& t : triangles) expected = std::min(expected, hitTriangle(ray, t));
        CHECK(walk(bvh, triangles, ray, visited) == expected);
        hits += expected < INFINITY ? 1 : 0;
    }
    CHECK(hits > kRays / 10);
    CHECK(visited < kRays * triangles.size() / 5); // it does spare work
}

TEST_CASE("one triangle and none are hierarchies too", "[unit]")
{
    BvhBuilder builder;
    const Bvh one = builder.build(std::vector<TrianglePositions>{{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}});
    CHECK(one.nodeCount == 1);
    CHECK(one.nodes[0].leaf == 1u);
    const Bvh none = builder.build({});
    CHECK(none.nodeCount == 1);
    CHECK(none.nodes[0].leaf == 0u);
    CHECK(none.nodes[0].lower.x > none.nodes[0].upper.x); // never hit
}
