// glTF 2.0 files (.gltf, .glb) as scenes, read through tinygltf.
#pragma once
#include "scene.h"

#include <filesystem>

namespace sample
{
/// Reads a file with the buffers and textures it names. Lines, points and unknown optional extensions are left out.
/// Throws SceneError, one sentence that names the file, for whatever is broken, missing or unsupported; also for a
/// scene without a triangle.
Scene loadGltf(const std::filesystem::path& file);
} // namespace sample
