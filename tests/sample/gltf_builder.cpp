#include "gltf_builder.h"

#include <cstring>
#include <fstream>
#include <unistd.h>

namespace test
{
namespace
{
void append(std::vector<char>& out, uint32_t word)
{
    const char* bytes = reinterpret_cast<const char*>(&word);
    out.insert(out.end(), bytes, bytes + 4);
}

void write(const std::filesystem::path& file, const char* data, size_t size)
{
    std::ofstream(file, std::ios::binary).write(data, static_cast<std::streamsize>(size));
}
} // namespace

TemporaryFolder::TemporaryFolder()
{
    std::string pattern = (std::filesystem::temp_directory_path() / "nrd-test-sample-XXXXXX").string();
    if (!mkdtemp(pattern.data())) throw std::runtime_error("cannot create a temporary folder");
    m_path = pattern;
}

TemporaryFolder::~TemporaryFolder()
{
    std::error_code ignored;
    std::filesystem::remove_all(m_path, ignored);
}

void GltfFile::writeBinary(const std::filesystem::path& file) const
{
    nlohmann::json copy = json;
    copy["buffers"] = {{{"byteLength", bytes.size()}}};
    std::string text = copy.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::vector<uint8_t> binary = bytes;
    binary.resize((binary.size() + 3) / 4 * 4);
    std::vector<char> out;
    append(out, 0x46546C67);
    append(out, 2);
    append(out, static_cast<uint32_t>(12 + 8 + text.size() + 8 + binary.size()));
    append(out, static_cast<uint32_t>(text.size()));
    append(out, 0x4E4F534A);
    out.insert(out.end(), text.begin(), text.end());
    append(out, static_cast<uint32_t>(binary.size()));
    append(out, 0x004E4942);
    out.insert(out.end(), binary.begin(), binary.end());
    write(file, out.data(), out.size());
}

void GltfFile::writeText(const std::filesystem::path& file) const
{
    nlohmann::json copy = json;
    const std::string name = file.stem().string() + ".bin";
    copy["buffers"] = {{{"byteLength", bytes.size()}, {"uri", name}}};
    const std::string text = copy.dump();
    write(file, text.data(), text.size());
    write(file.parent_path() / name, reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

GltfFile makeTriangle()
{
    GltfFile file;
    file.json["asset"] = {{"version", "2.0"}};
    file.addAccessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", 5126, 3);
    file.addAccessor<uint16_t>({0, 1, 2}, "SCALAR", 5123, 3);
    file.json["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}}}}};
    file.json["nodes"] = {{{"mesh", 0}}};
    file.json["scenes"] = {{{"nodes", {0}}}};
    file.json["scene"] = 0;
    return file;
}
} // namespace test
