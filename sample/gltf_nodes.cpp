#include "gltf_accessor.h"
#include "gltf_parts.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <tiny_gltf.h>

namespace sample
{
namespace
{
constexpr float kPi = 3.14159265f;

template <int N>
glm::vec<N, float> toVector(const std::vector<double>& in, glm::vec<N, float> otherwise, const std::string& what)
{
    if (in.empty()) return otherwise;
    if (in.size() != N) throw SceneError(what + " has " + std::to_string(in.size()) + " numbers");
    for (int i = 0; i < N; ++i)
    {
        if (!std::isfinite(float(in[size_t(i)]))) throw SceneError(what + " is not finite");
        otherwise[i] = float(in[size_t(i)]);
    }
    return otherwise;
}

int checkedIndex(int index, size_t count, const std::string& what)
{
    if (index >= 0 && size_t(index) >= count) throw SceneError(what + " " + std::to_string(index) + " does not exist");
    return index < 0 ? kNone : index;
}

void readCameras(const tinygltf::Model& model, Scene& scene)
{
    for (const tinygltf::Camera& in : model.cameras)
    {
        PerspectiveCamera camera;
        const auto fov = float(in.perspective.yfov);
        // An orthographic camera becomes the default perspective from the same place.
        if (in.type == "perspective" && fov > 0.01f && fov < 3.1f) camera.verticalFov = fov;
        if (in.type == "perspective" && in.perspective.znear > 0.0) camera.nearPlane = float(in.perspective.znear);
        scene.cameras.push_back(camera);
    }
}

// glTF's lights are points; exporters put the size of the emitter into the extras.
float radiusOf(const tinygltf::Light& in, float otherwise)
{
    if (!in.extras.IsObject() || !in.extras.Has("radius") || !in.extras.Get("radius").IsNumber()) return otherwise;
    const auto radius = float(in.extras.Get("radius").GetNumberAsDouble());
    return std::isfinite(radius) && radius > 0.0f ? radius : otherwise;
}

void readLights(const tinygltf::Model& model, Scene& scene)
{
    for (size_t i = 0; i < model.lights.size(); ++i)
    {
        const tinygltf::Light& in = model.lights[i];
        const std::string what = "light " + std::to_string(i);
        PunctualLight light;
        if (in.type == "directional")
            light.type = LightType::Directional;
        else if (in.type == "spot")
            light.type = LightType::Spot;
        else if (in.type != "point")
            throw SceneError(what + " has the unknown type '" + in.type + "'");
        const glm::vec3 color = toVector<3>(in.color, glm::vec3(1.0f), what + ", colour,");
        if (!std::isfinite(float(in.intensity)) || in.intensity < 0.0 || in.range < 0.0)
            throw SceneError(what + " has a negative or infinite intensity or range");
        light.intensity = glm::max(color, glm::vec3(0.0f)) * float(in.intensity);
        light.range = float(in.range);
        const float outer = std::clamp(float(in.spot.outerConeAngle), 1e-3f, 0.5f * kPi);
        light.outerCosine = std::cos(outer);
        light.innerCosine = std::cos(std::clamp(float(in.spot.innerConeAngle), 0.0f, outer * 0.999f));
        light.radius = radiusOf(in, light.radius);
        scene.lights.push_back(light);
    }
}

int lightOf(const tinygltf::Node& node)
{
    const auto found = node.extensions.find("KHR_lights_punctual");
    if (found == node.extensions.end() || !found->second.Has("light")) return kNone;
    const tinygltf::Value& light = found->second.Get("light");
    return light.IsNumber() ? light.GetNumberAsInt() : kNone;
}

Node toNode(const tinygltf::Model& model, const tinygltf::Node& in, size_t index, int parent)
{
    const std::string what = "node " + std::to_string(index);
    Node node;
    node.name = in.name;
    node.parent = parent;
    node.translation = toVector<3>(in.translation, node.translation, what + ", translation,");
    node.scale = toVector<3>(in.scale, node.scale, what + ", scale,");
    const glm::vec4 q = toVector<4>(in.rotation, glm::vec4(0, 0, 0, 1), what + ", rotation,");
    const float length = glm::length(q);
    if (length > 1e-6f) node.rotation = glm::quat(q.w, q.x, q.y, q.z) / length;
    if (!in.matrix.empty())
    {
        if (in.matrix.size() != 16)
            throw SceneError(what + ", matrix, has " + std::to_string(in.matrix.size()) + " numbers");
        glm::mat4 matrix;
        for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = float(in.matrix[size_t(i)]);
        for (int i = 0; i < 16; ++i)
            if (!std::isfinite(matrix[i / 4][i % 4])) throw SceneError(what + ", matrix, is not finite");
        node.matrix = matrix;
    }
    node.mesh = checkedIndex(in.mesh, model.meshes.size(), what + ": mesh");
    node.skin = checkedIndex(in.skin, model.skins.size(), what + ": skin");
    node.camera = checkedIndex(in.camera, model.cameras.size(), what + ": camera");
    node.light = checkedIndex(lightOf(in), model.lights.size(), what + ": light");
    for (double weight : in.weights) node.weights.push_back(std::isfinite(weight) ? float(weight) : 0.0f);
    return node;
}
} // namespace

std::vector<int> readNodes(const tinygltf::Model& model, Scene& scene)
{
    readCameras(model, scene);
    readLights(model, scene);
    std::vector<int> map(model.nodes.size(), kNone);
    std::vector<std::pair<int, int>> pending; // glTF node, our parent
    if (model.scenes.empty()) throw SceneError("the file has no scene");
    const int root = checkedIndex(std::max(model.defaultScene, 0), model.scenes.size(), "scene");
    const std::vector<int>& roots = model.scenes[size_t(root)].nodes;
    for (auto i = roots.rbegin(); i != roots.rend(); ++i) pending.emplace_back(*i, kNone);
    while (!pending.empty())
    {
        const auto [index, parent] = pending.back();
        pending.pop_back();
        if (index < 0 || size_t(index) >= model.nodes.size())
            throw SceneError("node " + std::to_string(index) + " does not exist");
        if (map[size_t(index)] != kNone)
            throw SceneError("node " + std::to_string(index) + " has two parents or is its own ancestor");
        map[size_t(index)] = int(scene.nodes.size());
        scene.nodes.push_back(toNode(model, model.nodes[size_t(index)], size_t(index), parent));
        for (int child : model.nodes[size_t(index)].children) pending.emplace_back(child, map[size_t(index)]);
    }
    return map;
}

void readSkins(const tinygltf::Model& model, const std::vector<int>& nodeMap, Scene& scene)
{
    for (size_t s = 0; s < model.skins.size(); ++s)
    {
        const tinygltf::Skin& in = model.skins[s];
        const std::string what = "skin " + std::to_string(s);
        Skin skin;
        for (int joint : in.joints)
        {
            if (joint < 0 || size_t(joint) >= nodeMap.size() || nodeMap[size_t(joint)] == kNone)
                throw SceneError(what + " has joint " + std::to_string(joint) + ", which is no node of the scene");
            skin.joints.push_back(nodeMap[size_t(joint)]);
        }
        skin.inverseBind.assign(skin.joints.size(), glm::mat4(1.0f));
        if (in.inverseBindMatrices >= 0)
        {
            const AccessorData<float> data =
                readFloats(model, in.inverseBindMatrices, what + ", inverse bind matrices");
            if (data.componentCount != 16 || data.count < skin.joints.size())
                throw SceneError(what + " has fewer inverse bind matrices than joints");
            for (size_t i = 0; i < skin.joints.size(); ++i) skin.inverseBind[i] = glm::make_mat4(&data.values[i * 16]);
        }
        scene.skins.push_back(std::move(skin));
    }
    for (const Node& node : scene.nodes)
    {
        if (node.mesh == kNone || node.skin == kNone) continue;
        const size_t jointCount = scene.skins[size_t(node.skin)].joints.size();
        for (const Primitive& p : scene.meshes[size_t(node.mesh)].primitives)
            for (const glm::uvec4& j : p.joints)
                if (std::max(std::max(j.x, j.y), std::max(j.z, j.w)) >= jointCount)
                    throw SceneError("mesh " + std::to_string(node.mesh) + " refers to a joint its skin does not have");
    }
}
} // namespace sample
