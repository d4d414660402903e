// Checked reading of glTF accessors: every range is verified before a byte is read.
#pragma once
#include "scene.h"

namespace tinygltf
{
class Model;
}

namespace sample
{
/// The values of an accessor, widened to float (normalised integers to [0; 1] or [-1; 1]) or to unsigned integers.
template <class T> struct AccessorData
{
    uint32_t componentCount = 0; // 1 to 4, 16 for matrices
    size_t count = 0;
    std::vector<T> values; // count * componentCount
};

/// Reads accessor `index` with its sparse part. `what` names the user of it in the error: "mesh 'x', POSITION".
/// Throws SceneError for anything out of range and for values that are not finite.
AccessorData<float> readFloats(const tinygltf::Model& model, int index, const std::string& what);

/// The same for indices and joints: unsigned integers only.
AccessorData<uint32_t> readIntegers(const tinygltf::Model& model, int index, const std::string& what);
} // namespace sample
