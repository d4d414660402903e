// The parts of the glTF reader; each turns one kind of glTF object into ours. All throw SceneError.
#pragma once
#include "scene.h"

#include <nlohmann/json.hpp>

namespace tinygltf
{
class Model;
}

namespace sample
{
/// Checks what tinygltf does not: required extensions, and that buffer views lie inside buffers that exist.
void checkGltfJson(const nlohmann::json& json);

void readTextures(const tinygltf::Model& model, Scene& scene);
void readMaterials(const tinygltf::Model& model, Scene& scene);
void readMeshes(const tinygltf::Model& model, Scene& scene);

/// Reads cameras, lights and the nodes of the default scene, parents first. Returns the new index of each glTF node,
/// kNone for those outside the scene.
std::vector<int> readNodes(const tinygltf::Model& model, Scene& scene);

void readSkins(const tinygltf::Model& model, const std::vector<int>& nodeMap, Scene& scene);

/// Reads the first animation.
void readAnimation(const tinygltf::Model& model, const std::vector<int>& nodeMap, Scene& scene);
} // namespace sample
