#include "bvh.h"

#include <embree3/rtcore.h>

#include <new>
#include <stdexcept>
#include <string>

namespace sample
{
namespace
{
constexpr uint32_t kMaxLeafSize = 4;

struct Box
{
    glm::vec3 lower = glm::vec3(INFINITY);
    glm::vec3 upper = glm::vec3(-INFINITY);
};

// The tree as Embree's callbacks build it; Embree's allocator owns the nodes.
struct TreeNode
{
    TreeNode* children[2] = {}; // both null in a leaf
    Box boxes[2];               // of the children
    uint32_t primitives[kMaxLeafSize] = {};
    uint32_t primitiveCount = 0;
};

void* createNode(RTCThreadLocalAllocator allocator, unsigned, void*)
{
    return new (rtcThreadLocalAlloc(allocator, sizeof(TreeNode), 16)) TreeNode;
}

void setChildren(void* node, void** children, unsigned count, void*)
{
    for (unsigned i = 0; i < count; ++i)
        static_cast<TreeNode*>(node)->children[i] = static_cast<TreeNode*>(children[i]);
}

void setBounds(void* node, const RTCBounds** bounds, unsigned count, void*)
{
    for (unsigned i = 0; i < count; ++i)
    {
        const RTCBounds& b = *bounds[i];
        static_cast<TreeNode*>(node)->boxes[i] = {{b.lower_x, b.lower_y, b.lower_z}, {b.upper_x, b.upper_y, b.upper_z}};
    }
}

void* createLeaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives, size_t count, void*)
{
    auto* node = new (rtcThreadLocalAlloc(allocator, sizeof(TreeNode), 16)) TreeNode;
    for (size_t i = 0; i < count; ++i) node->primitives[i] = primitives[i].primID;
    node->primitiveCount = static_cast<uint32_t>(count);
    return node;
}

Box boundsOf(const TrianglePositions& triangle)
{
    const auto& c = triangle.corners;
    return {glm::min(c[0], glm::min(c[1], c[2])), glm::max(c[0], glm::max(c[1], c[2]))};
}

std::vector<RTCBuildPrimitive> toPrimitives(std::span<const TrianglePositions> triangles, Box& root)
{
    std::vector<RTCBuildPrimitive> primitives;
    primitives.reserve(triangles.size());
    for (const TrianglePositions& triangle : triangles)
    {
        const Box box = boundsOf(triangle);
        root = {glm::min(root.lower, box.lower), glm::max(root.upper, box.upper)};
        primitives.push_back({box.lower.x, box.lower.y, box.lower.z, 0, box.upper.x, box.upper.y, box.upper.z,
                              static_cast<unsigned>(primitives.size())});
    }
    return primitives;
}

// Writes the eight orders.
class Flattener
{
public:
    explicit Flattener(Bvh& bvh) : m_bvh(bvh) {}

    void append(const TreeNode& root, const Box& box, uint32_t octant)
    {
        m_octant = octant;
        m_first = static_cast<uint32_t>(m_bvh.nodes.size());
        visit(root, box);
        m_bvh.nodeCount = static_cast<uint32_t>(m_bvh.nodes.size()) - m_first;
    }

private:
    void visit(const TreeNode& node, const Box& box)
    {
        const size_t index = m_bvh.nodes.size();
        m_bvh.nodes.push_back({box.lower, 0, box.upper, node.primitiveCount ? leafCode(node) : 0});
        if (node.primitiveCount == 0)
        {
            const int near = isFirstNearer(node) ? 0 : 1;
            visit(*node.children[near], node.boxes[near]);
            visit(*node.children[1 - near], node.boxes[1 - near]);
        }
        m_bvh.nodes[index].skip = static_cast<uint32_t>(m_bvh.nodes.size()) - m_first;
    }

    // Along the axis on which the children's centres are furthest apart.
    bool isFirstNearer(const TreeNode& node) const
    {
        const glm::vec3 apart =
            (node.boxes[1].lower + node.boxes[1].upper) - (node.boxes[0].lower + node.boxes[0].upper);
        const glm::vec3 size = glm::abs(apart);
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const bool isNegative = (m_octant >> axis) & 1u;
        return (apart[axis] >= 0.0f) != isNegative;
    }

    uint32_t leafCode(const TreeNode& node)
    {
        // All orders share one triangle array, so a leaf's place is found by its first primitive.
        if (m_octant == 0)
        {
            const auto start = static_cast<uint32_t>(m_bvh.triangleOrder.size());
            m_bvh.triangleOrder.insert(m_bvh.triangleOrder.end(), node.primitives,
                                       node.primitives + node.primitiveCount);
            if (m_leafStart.size() <= node.primitives[0]) m_leafStart.resize(node.primitives[0] + 1);
            m_leafStart[node.primitives[0]] = start;
        }
        return m_leafStart[node.primitives[0]] * 8 + node.primitiveCount;
    }

    Bvh& m_bvh;
    std::vector<uint32_t> m_leafStart; // by a leaf's first primitive
    uint32_t m_octant = 0;
    uint32_t m_first = 0;
};

Bvh emptyBvh()
{
    Bvh bvh;
    bvh.nodeCount = 1;
    bvh.nodes.assign(8, BvhNode{glm::vec3(1.0f), 1, glm::vec3(-1.0f), 0});
    return bvh;
}
} // namespace

struct BvhBuilder::Impl
{
    RTCDevice device = rtcNewDevice(nullptr);
    ~Impl() { rtcReleaseDevice(device); }
};

BvhBuilder::BvhBuilder() : m_impl(std::make_unique<Impl>())
{
    if (!m_impl->device) throw std::runtime_error("Embree cannot create its device");
}

BvhBuilder::~BvhBuilder() = default;

Bvh BvhBuilder::build(std::span<const TrianglePositions> triangles)
{
    if (triangles.empty()) return emptyBvh();
    if (triangles.size() >= (1u << 28)) throw std::runtime_error("the scene has more than 268 million triangles");
    Box rootBox;
    std::vector<RTCBuildPrimitive> primitives = toPrimitives(triangles, rootBox);
    const std::unique_ptr<RTCBVHTy, void (*)(RTCBVH)> tree(rtcNewBVH(m_impl->device), rtcReleaseBVH);
    RTCBuildArguments arguments = rtcDefaultBuildArguments();
    arguments.maxBranchingFactor = 2;
    arguments.maxDepth = 64;
    arguments.maxLeafSize = kMaxLeafSize;
    arguments.traversalCost = 1.0f;
    arguments.intersectionCost = 2.0f;
    arguments.bvh = tree.get();
    arguments.primitives = primitives.data();
    arguments.primitiveCount = primitives.size();
    arguments.primitiveArrayCapacity = primitives.size();
    arguments.createNode = createNode;
    arguments.setNodeChildren = setChildren;
    arguments.setNodeBounds = setBounds;
    arguments.createLeaf = createLeaf;
    const auto* root = static_cast<const TreeNode*>(rtcBuildBVH(&arguments));
    if (!root) throw std::runtime_error("Embree cannot build the hierarchy of the scene");
    Bvh bvh;
    Flattener flattener(bvh);
    for (uint32_t octant = 0; octant < 8; ++octant) flattener.append(*root, rootBox, octant);
    return bvh;
}
} // namespace sample
