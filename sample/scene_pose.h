// A scene at a moment: node transforms, skinned vertices in world space, and where they were the moment before.
#pragma once
#include "scene.h"

namespace sample
{
/// One triangle of the posed scene.
struct PosedTriangle
{
    glm::uvec3 vertices; // into the per-vertex arrays of ScenePose
    uint32_t material = 0;
};

struct Bounds
{
    glm::vec3 lower = glm::vec3(0.0f);
    glm::vec3 upper = glm::vec3(0.0f);
    glm::vec3 center() const { return 0.5f * (lower + upper); }
    float radius() const { return 0.5f * glm::length(upper - lower); }
};

/// Skins and morphs on the CPU, so that the path tracer sees nothing but world-space triangles.
class ScenePose
{
public:
    /// Keeps a reference to the scene, posed at time 0. Throws SceneError when nothing remains to be drawn.
    explicit ScenePose(const Scene& scene);

    /// Moves everything to `time` (seconds, repeats after Scene::duration); what was current becomes previous.
    /// Throws SceneError when a vertex leaves the range of floats.
    void update(double time);

    /// Makes the previous positions equal to the current ones: after a cut nothing has moved.
    void forgetPrevious() { previous = positions; }

    /// True when update() can change a triangle.
    bool isAnimated() const { return m_isAnimated; }
    const std::vector<glm::mat4>& nodeToWorld() const { return m_nodeToWorld; }
    Bounds bounds() const;

    // Per vertex; texCoords and colors do not change after construction.
    std::vector<glm::vec3> positions; // world space
    std::vector<glm::vec3> previous;  // world space, at the time of the update before
    std::vector<glm::vec3> normals;   // unit
    std::vector<glm::vec4> tangents;  // unit, .w: sign of the bitangent
    std::vector<std::array<glm::vec2, 2>> texCoords;
    std::vector<glm::vec4> colors;
    std::vector<PosedTriangle> triangles;

private:
    struct Instance
    {
        int node;
        const Primitive* primitive;
        size_t firstVertex;
    };
    void addInstances(int node, const Mesh& mesh);
    void updateNodes(float time);
    void poseInstance(const Instance& instance);

    const Scene& m_scene;
    std::vector<Instance> m_instances;
    std::vector<Node> m_nodes; // with the animated values
    std::vector<glm::mat4> m_nodeToWorld;
    bool m_isAnimated = false;
};
} // namespace sample
