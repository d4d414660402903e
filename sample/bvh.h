// Bounding volume hierarchy for the compute path tracer: built by Embree (SAH), flattened for traversal without a
// stack.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

namespace sample
{
/// Three corners in world space; counter-clockwise from the front.
struct TrianglePositions
{
    glm::vec3 corners[3];
};

/// One node of a threaded tree: "hit" goes to the next node in memory, "miss" to `skip`. Two vec4 on the device.
struct BvhNode
{
    glm::vec3 lower;
    uint32_t skip; // index of the node after this subtree, counted from the start of this order
    glm::vec3 upper;
    uint32_t leaf; // 0 for an inner node, else first triangle * 8 + number of triangles (1 to 7)
};

/// Eight depth-first orders of the same tree, one for each octant of ray directions, so that children come front to
/// back without a stack: what a wide SIMD machine without cheap scratch memory (llvmpipe) is fastest at.
struct Bvh
{
    std::vector<BvhNode> nodes;          // octant o starts at o * nodeCount; bit a of o: direction[a] < 0
    uint32_t nodeCount = 0;              // of one order
    std::vector<uint32_t> triangleOrder; // leaf position -> index of the source triangle
};

/// Builds hierarchies; keeps Embree's device between builds.
class BvhBuilder
{
public:
    BvhBuilder();
    ~BvhBuilder();

    /// The hierarchy over `triangles`, which must be finite and fewer than 2^28. No triangles: one node that is
    /// never hit. Throws std::runtime_error when Embree fails, for example without memory.
    Bvh build(std::span<const TrianglePositions> triangles);

private:
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};
} // namespace sample
