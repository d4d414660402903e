#include "gltf.h"

#include "gltf_parts.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <tiny_gltf.h>

namespace sample
{
namespace
{
constexpr const char* kKnownExtensions[] = {"KHR_texture_transform",      "KHR_materials_emissive_strength",
                                            "KHR_lights_punctual",        "KHR_mesh_quantization",
                                            "KHR_materials_transmission", "KHR_materials_ior",
                                            "KHR_materials_volume"};
constexpr uint32_t kGlbMagic = 0x46546C67; // "glTF"
constexpr uint32_t kJsonChunk = 0x4E4F534A;
constexpr std::streamoff kMaxFileSize = std::streamoff(1) << 31;

std::vector<uint8_t> readFile(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary | std::ios::ate);
    if (!stream || std::filesystem::is_directory(file)) throw SceneError("the file cannot be opened");
    const std::streamoff size = stream.tellg();
    if (size > kMaxFileSize) throw SceneError("the file is larger than 2 GiB");
    std::vector<uint8_t> bytes(static_cast<size_t>(size));
    stream.seekg(0);
    stream.read(reinterpret_cast<char*>(bytes.data()), size);
    if (!stream) throw SceneError("the file cannot be read");
    return bytes;
}

uint32_t wordAt(const std::vector<uint8_t>& bytes, size_t offset)
{
    uint32_t word = 0;
    std::memcpy(&word, bytes.data() + offset, sizeof(word));
    return word;
}

bool isBinary(const std::vector<uint8_t>& bytes) { return bytes.size() >= 4 && wordAt(bytes, 0) == kGlbMagic; }

// The JSON text of either kind of file. A binary file is a header of 12 bytes and chunks of (length, type, bytes).
std::string jsonText(const std::vector<uint8_t>& bytes)
{
    if (!isBinary(bytes)) return {bytes.begin(), bytes.end()};
    if (bytes.size() < 20) throw SceneError("the file is truncated");
    if (wordAt(bytes, 4) != 2) throw SceneError("the binary container is not version 2");
    if (wordAt(bytes, 8) > bytes.size())
        throw SceneError("the file is truncated: it has " + std::to_string(bytes.size()) + " of " +
                         std::to_string(wordAt(bytes, 8)) + " bytes");
    const size_t length = wordAt(bytes, 12);
    if (wordAt(bytes, 16) != kJsonChunk || length > bytes.size() - 20) throw SceneError("the JSON chunk is broken");
    const auto first = bytes.begin() + 20;
    return {first, first + static_cast<std::ptrdiff_t>(length)};
}

// The parser's reports span lines; the first says what is wrong.
std::string firstLine(const std::string& text)
{
    const size_t begin = text.find_first_not_of(" \n\r\t");
    if (begin == std::string::npos) return "the file is broken";
    return text.substr(begin, text.find_first_of("\n\r", begin) - begin);
}

// Keeps the encoded picture; decoding happens in readTextures(), where errors can be told.
bool keepEncoded(tinygltf::Image* image, const int, std::string*, std::string*, int, int, const unsigned char* bytes,
                 int size, void*)
{
    image->image.assign(bytes, bytes + std::max(size, 0));
    return true;
}

tinygltf::Model parse(const std::vector<uint8_t>& bytes, const std::filesystem::path& file)
{
    tinygltf::TinyGLTF loader;
    loader.SetImageLoader(keepEncoded, nullptr);
    tinygltf::Model model;
    std::string error, warning;
    const std::string folder = file.parent_path().empty() ? "." : file.parent_path().string();
    const auto size = static_cast<unsigned>(bytes.size());
    const bool isRead = isBinary(bytes)
                            ? loader.LoadBinaryFromMemory(&model, &error, &warning, bytes.data(), size, folder)
                            : loader.LoadASCIIFromString(&model, &error, &warning,
                                                         reinterpret_cast<const char*>(bytes.data()), size, folder);
    if (!isRead || !error.empty()) throw SceneError(firstLine(error.empty() ? warning : error));
    return model;
}

Scene convert(const tinygltf::Model& model)
{
    Scene scene;
    readTextures(model, scene);
    readMaterials(model, scene);
    readMeshes(model, scene);
    const std::vector<int> nodeMap = readNodes(model, scene);
    readSkins(model, nodeMap, scene);
    readAnimation(model, nodeMap, scene);
    const bool hasTriangle = std::any_of(
        scene.nodes.begin(), scene.nodes.end(),
        [&](const Node& node) { return node.mesh >= 0 && !scene.meshes[size_t(node.mesh)].primitives.empty(); });
    if (!hasTriangle) throw SceneError("the scene is empty: no node has a mesh with triangles");
    return scene;
}
} // namespace

void checkGltfJson(const nlohmann::json& json)
{
    if (!json.is_object() || !json.contains("asset")) throw SceneError("the file is not glTF: it has no asset");
    if (json["asset"].value("version", "").substr(0, 2) != "2.") throw SceneError("the file is not glTF version 2");
    for (const auto& extension : json.value("extensionsRequired", nlohmann::json::array()))
    {
        const auto name = extension.get<std::string>();
        if (std::find(std::begin(kKnownExtensions), std::end(kKnownExtensions), name) == std::end(kKnownExtensions))
            throw SceneError("it requires the extension " + name + ", which is not supported");
    }
    const auto buffers = json.value("buffers", nlohmann::json::array());
    size_t index = 0;
    for (const auto& view : json.value("bufferViews", nlohmann::json::array()))
    {
        const std::string name = "buffer view " + std::to_string(index++);
        const auto buffer = view.at("buffer").get<int64_t>();
        if (buffer < 0 || size_t(buffer) >= buffers.size())
            throw SceneError(name + " refers to buffer " + std::to_string(buffer) + ", which does not exist");
        const auto size = buffers[size_t(buffer)].at("byteLength").get<int64_t>();
        const auto offset = view.value("byteOffset", int64_t(0));
        const auto length = view.at("byteLength").get<int64_t>();
        if (offset < 0 || length < 0 || offset > size || length > size - offset)
            throw SceneError(name + " reaches beyond its buffer");
    }
}

Scene loadGltf(const std::filesystem::path& file)
{
    try
    {
        const std::vector<uint8_t> bytes = readFile(file);
        checkGltfJson(nlohmann::json::parse(jsonText(bytes)));
        Scene scene = convert(parse(bytes, file));
        scene.name = file.stem().string();
        return scene;
    }
    catch (const SceneError& error)
    {
        throw SceneError(file.string() + ": " + error.what());
    }
    catch (const nlohmann::json::exception& error)
    {
        throw SceneError(file.string() + ": the JSON is broken: " + firstLine(error.what()));
    }
    catch (const std::bad_alloc&)
    {
        throw SceneError(file.string() + ": it does not fit into memory");
    }
}
} // namespace sample
