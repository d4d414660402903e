// Files that cannot be used: each ends in one sentence that names what is wrong.
#include "catch.h"
#include "gltf.h"
#include "gltf_builder.h"

#include <fstream>
#include <limits>

using namespace sample;
using test::GltfFile;

namespace
{
// The sentence; empty when the file loads after all.
std::string problemOf(const std::filesystem::path& file)
{
    try
    {
        (void)loadGltf(file);
        return "";
    }
    catch (const SceneError& error)
    {
        return error.what();
    }
}

struct BrokenFile
{
    const char* what;     // for the message of a failing test
    const char* expected; // part of the sentence
    void (*breakIt)(GltfFile&);
};

const BrokenFile kBrokenFiles[] = {
    {"a required extension we don't know", "KHR_draco_mesh_compression",
     [](GltfFile& f) { f.json["extensionsRequired"] = {"KHR_draco_mesh_compression"}; }},
    {"version 1", "version 2", [](GltfFile& f) { f.json["asset"]["version"] = "1.0"; }},
    {"no asset", "asset", [](GltfFile& f) { f.json.erase("asset"); }},
    {"no scene", "no scene", [](GltfFile& f) { f.json.erase("scenes"); }},
    {"an empty scene", "empty", [](GltfFile& f) { f.json["scenes"][0].erase("nodes"); }},
    {"a node without mesh", "empty",
     [](GltfFile& f) {
         f.json["nodes"][0] = {{"name", "nothing"}};
     }},
    {"NaN positions", "not a finite number",
     [](GltfFile& f)
     {
         const float nan = std::numeric_limits<float>::quiet_NaN();
         std::copy_n(reinterpret_cast<const uint8_t*>(&nan), 4, &f.bytes[16]);
     }},
    {"an index beyond the vertices", "refers to vertex 7 of 3", [](GltfFile& f) { f.bytes[36] = 7; }},
    {"an accessor beyond its view", "reaches beyond buffer view 0",
     [](GltfFile& f) { f.json["accessors"][0]["count"] = 4; }},
    {"an accessor with a huge count", "count", [](GltfFile& f) { f.json["accessors"][0]["count"] = 1e15; }},
    {"zeros that would fill the memory", "too many elements",
     [](GltfFile& f)
     {
         f.json["accessors"][0].erase("bufferView");
         f.json["accessors"][0]["count"] = 2000000000;
     }},
    {"an accessor's offset beyond its view", "reaches beyond",
     [](GltfFile& f) { f.json["accessors"][0]["byteOffset"] = 1000000; }},
    {"a view beyond its buffer", "reaches beyond its buffer",
     [](GltfFile& f) { f.json["bufferViews"][0]["byteLength"] = 1000; }},
    {"a view of no buffer", "does not exist", [](GltfFile& f) { f.json["bufferViews"][0]["buffer"] = 5; }},
    {"an accessor of no view", "does not exist", [](GltfFile& f) { f.json["accessors"][0]["bufferView"] = 9; }},
    {"positions that don't exist", "does not exist",
     [](GltfFile& f) { f.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 77; }},
    {"no positions", "no positions",
     [](GltfFile& f) {
         f.json["meshes"][0]["primitives"][0]["attributes"] = {{"NORMAL", 0}};
     }},
    {"indices that are floats", "unsigned integers",
     [](GltfFile& f) { f.json["meshes"][0]["primitives"][0]["indices"] = 0; }},
    {"a material that doesn't exist", "material 3",
     [](GltfFile& f) { f.json["meshes"][0]["primitives"][0]["material"] = 3; }},
    {"a mesh that doesn't exist", "mesh 4", [](GltfFile& f) { f.json["nodes"][0]["mesh"] = 4; }},
    {"a node that doesn't exist", "node 9", [](GltfFile& f) { f.json["scenes"][0]["nodes"] = {9}; }},
    {"a node that is its own child", "ancestor", [](GltfFile& f) { f.json["nodes"][0]["children"] = {0}; }},
    {"a texture that doesn't exist", "texture 2",
     [](GltfFile& f)
     {
         f.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 2}}}}}}};
         f.json["meshes"][0]["primitives"][0]["material"] = 0;
     }},
    {"a picture that is none", "cannot be decoded",
     [](GltfFile& f)
     {
         const int view = f.addView<uint8_t>({1, 2, 3, 4, 5, 6, 7, 8});
         f.json["images"] = {{{"bufferView", view}, {"mimeType", "image/png"}}};
     }},
    {"a picture that is missing", "image",
     [](GltfFile& f) {
         f.json["images"] = {{{"uri", "absent.png"}}};
     }},
    {"a sparse index beyond the accessor", "writes element 8 of 3",
     [](GltfFile& f)
     {
         const int indices = f.addView<uint16_t>({8});
         const int values = f.addView<float>({1, 2, 3});
         f.json["accessors"][0]["sparse"] = {{"count", 1},
                                             {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
                                             {"values", {{"bufferView", values}}}};
     }},
    {"weights without joints", "joints or weights",
     [](GltfFile& f)
     {
         f.json["meshes"][0]["primitives"][0]["attributes"]["WEIGHTS_0"] =
             f.addAccessor<float>(std::vector<float>(12, 0.25f), "VEC4", 5126, 3);
     }},
    {"fewer normals than vertices", "for 3 vertices",
     [](GltfFile& f) {
         f.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] =
             f.addAccessor<float>({0, 0, 1}, "VEC3", 5126, 1);
     }},
    {"animation times that decrease", "decrease",
     [](GltfFile& f)
     {
         const int times = f.addAccessor<float>({1, 0}, "SCALAR", 5126, 2);
         const int values = f.addAccessor<float>({0, 0, 0, 1, 0, 0}, "VEC3", 5126, 2);
         f.json["animations"] = {
             {{"samplers", {{{"input", times}, {"output", values}}}},
              {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
     }},
    {"a node out of the range of floats", "not finite",
     [](GltfFile& f) {
         f.json["nodes"][0]["translation"] = {1e300, 0, 0};
     }},
};
} // namespace

TEST_CASE("every broken file ends in one sentence that names the problem", "[unit]")
{
    const test::TemporaryFolder folder;
    for (const BrokenFile& broken : kBrokenFiles)
    {
        GltfFile file = test::makeTriangle();
        broken.breakIt(file);
        for (const char* name : {"scene.glb", "scene.gltf"})
        {
            const std::filesystem::path path = folder / name;
            if (path.extension() == ".glb")
                file.writeBinary(path);
            else
                file.writeText(path);
            INFO(broken.what << ", " << name);
            const std::string problem = problemOf(path);
            CHECK_THAT(problem, containing(broken.expected));
            CHECK_THAT(problem, containing(name));
            CHECK(problem.find('\n') == std::string::npos);
        }
    }
}

TEST_CASE("a file cut off at any byte is refused", "[unit]")
{
    const test::TemporaryFolder folder;
    test::makeTriangle().writeBinary(folder / "whole.glb");
    REQUIRE(problemOf(folder / "whole.glb").empty());
    std::ifstream stream(folder / "whole.glb", std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(stream)), {});
    for (size_t length = 0; length < bytes.size(); length += 3)
    {
        std::ofstream(folder / "cut.glb", std::ios::binary) << bytes.substr(0, length);
        INFO(length << " of " << bytes.size() << " bytes");
        const std::string problem = problemOf(folder / "cut.glb");
        CHECK_FALSE(problem.empty());
        CHECK(problem.find('\n') == std::string::npos);
    }
}

TEST_CASE("a byte changed anywhere never crashes the reader", "[unit]")
{
    const test::TemporaryFolder folder;
    test::makeTriangle().writeBinary(folder / "whole.glb");
    std::ifstream stream(folder / "whole.glb", std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(stream)), {});
    size_t refused = 0;
    for (size_t at = 0; at < bytes.size(); ++at)
    {
        for (const char value : {'\0', '9', '\xFF'})
        {
            std::string copy = bytes;
            copy[at] = value;
            std::ofstream(folder / "changed.glb", std::ios::binary) << copy;
            refused += problemOf(folder / "changed.glb").empty() ? 0 : 1;
        }
    }
    CHECK(refused > bytes.size()); // most of the file is JSON, where nearly every change is an error
}

TEST_CASE("missing files and folders are refused by name", "[unit]")
{
    const test::TemporaryFolder folder;
    CHECK_THAT(problemOf(folder / "absent.glb"), containing("absent.glb"));
    CHECK_THAT(problemOf(folder / ""), containing("cannot be"));
    test::makeTriangle().writeText(folder / "scene.gltf");
    std::filesystem::remove(folder / "scene.bin");
    CHECK_THAT(problemOf(folder / "scene.gltf"), containing("scene.bin"));
}
