#include "scene_pose.h"

#include <algorithm>
#include <cmath>

namespace sample
{
namespace
{
glm::mat4 localMatrix(const Node& node)
{
    if (node.matrix) return *node.matrix;
    glm::mat4 m = glm::mat4_cast(node.rotation);
    for (int i = 0; i < 3; ++i) m[i] *= node.scale[i];
    m[3] = glm::vec4(node.translation, 1.0f);
    return m;
}

// Where a time lies between two keys.
struct KeyPosition
{
    size_t key = 0;
    float t = 0.0f;    // [0; 1] from key to key + 1
    float span = 0.0f; // seconds between the two
};

KeyPosition findKey(const std::vector<float>& times, float time)
{
    if (times.size() == 1 || time <= times.front()) return {0, 0.0f, 0.0f};
    if (time >= times.back()) return {times.size() - 1, 0.0f, 0.0f};
    const auto next = std::upper_bound(times.begin(), times.end(), time);
    const auto key = static_cast<size_t>(next - times.begin()) - 1;
    const float span = times[key + 1] - times[key];
    return {key, span > 0.0f ? (time - times[key]) / span : 0.0f, span};
}

// One number of a channel's value, interpolated as glTF's appendix C says.
float interpolate(const AnimationChannel& channel, const KeyPosition& at, size_t component)
{
    const bool isCubic = channel.interpolation == Interpolation::Cubic;
    const size_t stride = channel.valueSize * (isCubic ? 3 : 1);
    const size_t valueOffset = (isCubic ? channel.valueSize : 0) + component;
    const float a = channel.values[at.key * stride + valueOffset];
    if (at.t <= 0.0f || channel.interpolation == Interpolation::Step) return a;
    const float b = channel.values[(at.key + 1) * stride + valueOffset];
    if (!isCubic) return a + (b - a) * at.t;
    const float outTangent = at.span * channel.values[at.key * stride + 2 * channel.valueSize + component];
    const float inTangent = at.span * channel.values[(at.key + 1) * stride + component];
    const float t = at.t, t2 = t * t, t3 = t2 * t;
    return (2.0f * t3 - 3.0f * t2 + 1.0f) * a + (t3 - 2.0f * t2 + t) * outTangent + (3.0f * t2 - 2.0f * t3) * b +
           (t3 - t2) * inTangent;
}

glm::quat rotationAt(const AnimationChannel& channel, const KeyPosition& at)
{
    const auto key = [&](size_t k)
    {
        return glm::quat(channel.values[k * 4 + 3], channel.values[k * 4], channel.values[k * 4 + 1],
                         channel.values[k * 4 + 2]);
    };
    glm::quat q;
    if (channel.interpolation == Interpolation::Linear && at.t > 0.0f)
        q = glm::slerp(glm::normalize(key(at.key)), glm::normalize(key(at.key + 1)), at.t);
    else
        q = glm::quat(interpolate(channel, at, 3), interpolate(channel, at, 0), interpolate(channel, at, 1),
                      interpolate(channel, at, 2));
    const float length = glm::length(q);
    return length > 1e-12f ? q / length : glm::quat(1.0f, 0.0f, 0.0f, 0.0f);
}

void apply(const AnimationChannel& channel, float time, Node& node)
{
    const KeyPosition at = findKey(channel.times, time);
    const auto vector = [&]
    { return glm::vec3(interpolate(channel, at, 0), interpolate(channel, at, 1), interpolate(channel, at, 2)); };
    switch (channel.path)
    {
    case AnimationPath::Translation:
        node.translation = vector();
        break;
    case AnimationPath::Scale:
        node.scale = vector();
        break;
    case AnimationPath::Rotation:
        node.rotation = rotationAt(channel, at);
        break;
    case AnimationPath::Weights:
        node.weights.resize(channel.valueSize);
        for (size_t i = 0; i < channel.valueSize; ++i) node.weights[i] = interpolate(channel, at, i);
        break;
    }
}

bool isFinite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

glm::vec3 normalizeOr(const glm::vec3& v, const glm::vec3& otherwise)
{
    const float length = glm::length(v);
    return length > 1e-20f && std::isfinite(length) ? v / length : otherwise;
}

// Weighted sums of a primitive's morph targets.
struct Morphed
{
    glm::vec3 position;
    glm::vec3 normal;
};

Morphed morph(const Primitive& p, const std::vector<float>& weights, size_t vertex)
{
    Morphed m = {p.positions[vertex], p.normals[vertex]};
    for (size_t t = 0; t < p.targets.size() && t < weights.size(); ++t)
    {
        if (!p.targets[t].positions.empty()) m.position += weights[t] * p.targets[t].positions[vertex];
        if (!p.targets[t].normals.empty()) m.normal += weights[t] * p.targets[t].normals[vertex];
    }
    return m;
}
} // namespace

ScenePose::ScenePose(const Scene& scene) : m_scene(scene), m_nodes(scene.nodes)
{
    updateNodes(0.0f);
    for (size_t n = 0; n < scene.nodes.size(); ++n)
        if (scene.nodes[n].mesh != kNone) addInstances(int(n), scene.meshes[size_t(scene.nodes[n].mesh)]);
    if (triangles.empty()) throw SceneError("the scene '" + scene.name + "' has no triangles");
    positions.resize(texCoords.size());
    normals.resize(texCoords.size());
    tangents.resize(texCoords.size());
    for (const Instance& instance : m_instances) poseInstance(instance);
    previous = positions;
    // A moving camera or light alone leaves the triangles as they are, but rebuilding is cheap and rare.
    m_isAnimated = !scene.channels.empty();
}

void ScenePose::addInstances(int node, const Mesh& mesh)
{
    // A mirroring transform turns triangles inside out (glTF 3.7.4); skins ignore the node's own transform.
    const bool isMirrored =
        m_nodes[size_t(node)].skin == kNone && glm::determinant(glm::mat3(m_nodeToWorld[size_t(node)])) < 0.0f;
    for (const Primitive& p : mesh.primitives)
    {
        const auto first = static_cast<uint32_t>(texCoords.size());
        m_instances.push_back({node, &p, first});
        for (size_t v = 0; v < p.positions.size(); ++v)
        {
            std::array<glm::vec2, 2> coords = {};
            for (size_t s = 0; s < 2; ++s)
                if (!p.texCoords[s].empty()) coords[s] = p.texCoords[s][v];
            texCoords.push_back(coords);
            colors.push_back(p.colors.empty() ? glm::vec4(1.0f) : p.colors[v]);
        }
        for (size_t i = 0; i + 2 < p.indices.size(); i += 3)
        {
            const uint32_t second = p.indices[i + (isMirrored ? 2 : 1)], third = p.indices[i + (isMirrored ? 1 : 2)];
            triangles.push_back({glm::uvec3(p.indices[i], second, third) + first, static_cast<uint32_t>(p.material)});
        }
    }
}

void ScenePose::updateNodes(float time)
{
    for (const AnimationChannel& channel : m_scene.channels) apply(channel, time, m_nodes[size_t(channel.node)]);
    m_nodeToWorld.resize(m_nodes.size());
    const glm::mat4 root = glm::translate(glm::mat4(1.0f), m_scene.origin);
    for (size_t n = 0; n < m_nodes.size(); ++n)
    {
        const glm::mat4 local = localMatrix(m_nodes[n]);
        m_nodeToWorld[n] = (m_nodes[n].parent == kNone ? root : m_nodeToWorld[size_t(m_nodes[n].parent)]) * local;
    }
}

void ScenePose::poseInstance(const Instance& instance)
{
    const Node& node = m_nodes[size_t(instance.node)];
    const Primitive& p = *instance.primitive;
    const std::vector<float>& weights = node.weights.empty() ? m_scene.meshes[size_t(node.mesh)].weights : node.weights;
    std::vector<glm::mat4> joints;
    const bool isSkinned = node.skin != kNone && !p.joints.empty();
    if (isSkinned)
    {
        const Skin& skin = m_scene.skins[size_t(node.skin)];
        for (size_t j = 0; j < skin.joints.size(); ++j)
            joints.push_back(m_nodeToWorld[size_t(skin.joints[j])] * skin.inverseBind[j]);
    }
    glm::mat4 toWorld = m_nodeToWorld[size_t(instance.node)];
    glm::mat3 normalToWorld = glm::transpose(glm::inverse(glm::mat3(toWorld)));
    for (size_t v = 0; v < p.positions.size(); ++v)
    {
        if (isSkinned)
        {
            const glm::uvec4 j = p.joints[v];
            const glm::vec4 w = p.weights[v];
            toWorld = joints[j.x] * w.x + joints[j.y] * w.y + joints[j.z] * w.z + joints[j.w] * w.w;
            normalToWorld = glm::transpose(glm::inverse(glm::mat3(toWorld)));
        }
        const Morphed m = morph(p, weights, v);
        const size_t out = instance.firstVertex + v;
        positions[out] = glm::vec3(toWorld * glm::vec4(m.position, 1.0f));
        if (!isFinite(positions[out]))
            throw SceneError("a vertex of node '" + node.name + "' leaves the range of floating-point numbers");
        normals[out] = normalizeOr(normalToWorld * m.normal, glm::vec3(0.0f, 1.0f, 0.0f));
        const glm::vec4 tangent = p.tangents.empty() ? glm::vec4(1.0f, 0.0f, 0.0f, 1.0f) : p.tangents[v];
        tangents[out] =
            glm::vec4(normalizeOr(glm::mat3(toWorld) * glm::vec3(tangent), glm::vec3(1.0f, 0.0f, 0.0f)), tangent.w);
    }
}

void ScenePose::update(double time)
{
    std::swap(previous, positions);
    positions.resize(previous.size());
    const double duration = m_scene.duration;
    updateNodes(static_cast<float>(duration > 0.0 ? std::fmod(time, duration) : 0.0));
    for (const Instance& instance : m_instances) poseInstance(instance);
}

Bounds ScenePose::bounds() const
{
    Bounds b = {glm::vec3(INFINITY), glm::vec3(-INFINITY)};
    for (const PosedTriangle& t : triangles)
        for (int i = 0; i < 3; ++i)
        {
            b.lower = glm::min(b.lower, positions[t.vertices[i]]);
            b.upper = glm::max(b.upper, positions[t.vertices[i]]);
        }
    return b;
}
} // namespace sample
