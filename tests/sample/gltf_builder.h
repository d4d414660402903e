// glTF files made in a temporary folder: a valid one to start from, and ways to break it.
#pragma once
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace test
{
/// A folder that goes with the object.
class TemporaryFolder
{
public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    std::filesystem::path operator/(const std::string& name) const { return m_path / name; }

private:
    std::filesystem::path m_path;
};

/// JSON and binary chunk of a file; one triangle with material and scene when made by makeTriangle().
struct GltfFile
{
    nlohmann::json json;
    std::vector<uint8_t> bytes;

    /// Appends values to the buffer with a view of their own and returns the view's index.
    template <class T> int addView(const std::vector<T>& values)
    {
        const size_t offset = (bytes.size() + 3) / 4 * 4;
        bytes.resize(offset + values.size() * sizeof(T));
        std::copy_n(reinterpret_cast<const uint8_t*>(values.data()), values.size() * sizeof(T), &bytes[offset]);
        json["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", values.size() * sizeof(T)}});
        return static_cast<int>(json["bufferViews"].size()) - 1;
    }
    /// An accessor over a new view; returns its index. `type` as in glTF: "VEC3" with componentType 5126.
    template <class T> int addAccessor(const std::vector<T>& values, const char* type, int componentType, size_t count)
    {
        const int view = addView(values);
        json["accessors"].push_back(
            {{"bufferView", view}, {"type", type}, {"componentType", componentType}, {"count", count}});
        return static_cast<int>(json["accessors"].size()) - 1;
    }
    void writeBinary(const std::filesystem::path& file) const;
    /// As text with the buffer in a file beside it.
    void writeText(const std::filesystem::path& file) const;
};

/// (0 0 0) (1 0 0) (0 1 0): accessor 0 positions, accessor 1 indices.
GltfFile makeTriangle();
} // namespace test
