// What files mean, once they load.
#include "catch.h"
#include "gltf.h"
#include "gltf_builder.h"
#include "scene_pose.h"

using namespace sample;
using test::GltfFile;

namespace
{
Scene load(const GltfFile& file)
{
    const test::TemporaryFolder folder;
    file.writeBinary(folder / "scene.glb");
    return loadGltf(folder / "scene.glb");
}

const Primitive& onlyPrimitive(const Scene& scene) { return scene.meshes.at(0).primitives.at(0); }
} // namespace

TEST_CASE("text and binary files give the same scene", "[unit]")
{
    const test::TemporaryFolder folder;
    test::makeTriangle().writeBinary(folder / "a.glb");
    test::makeTriangle().writeText(folder / "b.gltf");
    const Scene a = loadGltf(folder / "a.glb"), b = loadGltf(folder / "b.gltf");
    CHECK(onlyPrimitive(a).positions == onlyPrimitive(b).positions);
    CHECK(onlyPrimitive(a).indices == onlyPrimitive(b).indices);
    CHECK(onlyPrimitive(a).normals.at(1) == glm::vec3(0, 0, 1)); // none in the file: flat
}

TEST_CASE("a sparse accessor replaces only the elements it names", "[unit]")
{
    GltfFile file = test::makeTriangle();
    const int indices = file.addView<uint16_t>({2});
    const int values = file.addView<float>({0, 5, 0});
    file.json["accessors"][0]["sparse"] = {{"count", 1},
                                           {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
                                           {"values", {{"bufferView", values}}}};
    const Scene scene = load(file);
    CHECK(onlyPrimitive(scene).positions == std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 5, 0}});
}

TEST_CASE("quantised positions, strides and colours are widened", "[unit]")
{
    GltfFile file = test::makeTriangle();
    // Normalised bytes, four bytes apart.
    const int view = file.addView<int8_t>({0, 0, 0, 0, 127, 0, 0, 0, 0, -127, 0, 0});
    file.json["bufferViews"][size_t(view)]["byteStride"] = 4;
    file.json["accessors"][0] = {
        {"bufferView", view}, {"type", "VEC3"}, {"componentType", 5120}, {"count", 3}, {"normalized", true}};
    const int colors = file.addAccessor<uint8_t>({255, 0, 0, 0, 255, 0, 0, 0, 255}, "VEC3", 5121, 3);
    file.json["accessors"][size_t(colors)]["normalized"] = true;
    file.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = colors;
    file.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    const Scene scene = load(file);
    CHECK(onlyPrimitive(scene).positions == std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, -1, 0}});
    CHECK(onlyPrimitive(scene).colors.at(1) == glm::vec4(0, 1, 0, 1));
}

TEST_CASE("materials carry emissive strength, texture transforms and alpha masks", "[unit]")
{
    GltfFile file = test::makeTriangle();
    file.json["materials"] = {{{"emissiveFactor", {1.0, 0.5, 0.0}},
                               {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 8.0}}}}},
                               {"alphaMode", "MASK"},
                               {"alphaCutoff", 0.25},
                               {"doubleSided", true},
                               {"pbrMetallicRoughness", {{"metallicFactor", 0.5}, {"roughnessFactor", 0.25}}}}};
    file.json["meshes"][0]["primitives"][0]["material"] = 0;
    const Scene scene = load(file);
    const Material& m = scene.materials.at(0);
    CHECK(m.emission == glm::vec3(8, 4, 0));
    CHECK(m.alphaCutoff == 0.25f);
    CHECK(m.isDoubleSided);
    CHECK(m.metallic == 0.5f);
    CHECK(m.roughness == 0.25f);
    CHECK_FALSE(m.isBlended);
}

TEST_CASE("blended materials let light through and are seen from one half on", "[unit]")
{
    GltfFile file = test::makeTriangle();
    file.json["materials"] = {{{"alphaMode", "BLEND"}, {"alphaCutoff", 0.25}}};
    const Material material = load(file).materials.at(0);
    CHECK(material.isBlended);
    CHECK(material.alphaCutoff == 0.5f);
}

TEST_CASE("glass transmits at least half, is solid where it has a thickness, and bends by its index", "[unit]")
{
    const auto load = [](double transmission, double thickness)
    {
        test::GltfFile file = test::makeTriangle();
        file.json["materials"] = {{{"pbrMetallicRoughness", {{"metallicFactor", 0.0}}},
                                   {"extensions",
                                    {{"KHR_materials_transmission", {{"transmissionFactor", transmission}}},
                                     {"KHR_materials_volume", {{"thicknessFactor", thickness}}},
                                     {"KHR_materials_ior", {{"ior", 1.33}}}}}}};
        file.json["extensionsRequired"] = {"KHR_materials_transmission", "KHR_materials_volume", "KHR_materials_ior"};
        const test::TemporaryFolder folder;
        file.writeBinary(folder / "glass.glb");
        return loadGltf(folder / "glass.glb").materials[0];
    };
    CHECK(load(1.0, 0.1).isGlass);
    CHECK(load(1.0, 0.1).isSolidGlass);
    CHECK(load(1.0, 0.1).ior == Approx(1.33f));
    CHECK_FALSE(load(1.0, 0.0).isSolidGlass);
    CHECK_FALSE(load(0.4, 0.1).isGlass);
}

TEST_CASE("a light's size is in its extras, where it makes sense", "[unit]")
{
    for (const auto& [extras, radius] : {std::pair(R"({"radius": 0.3})", 0.3f), std::pair(R"({"radius": -1})", 0.05f),
                                         std::pair(R"({"radius": "big"})", 0.05f), std::pair("{}", 0.05f)})
    {
        GltfFile file = test::makeTriangle();
        file.json["extensions"]["KHR_lights_punctual"]["lights"] = {
            {{"type", "point"}, {"extras", nlohmann::json::parse(extras)}}};
        INFO(extras);
        CHECK(load(file).lights.at(0).radius == radius);
    }
}

TEST_CASE("strips and fans become the triangles they are", "[unit]")
{
    for (const int mode : {5, 6})
    {
        GltfFile file = test::makeTriangle();
        const int positions = file.addAccessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, "VEC3", 5126, 4);
        file.json["meshes"][0]["primitives"][0] = {{"attributes", {{"POSITION", positions}}}, {"mode", mode}};
        const Scene scene = load(file);
        const Primitive& p = onlyPrimitive(scene);
        REQUIRE(p.indices.size() == 6);
        // A strip keeps its winding: both triangles face +Z. The second of the fan turns round here.
        CHECK(p.normals.at(0).z == 1.0f);
        CHECK(p.normals.at(3).z == (mode == 5 ? 1.0f : -1.0f));
    }
}

TEST_CASE("lights and cameras stand where their nodes stand", "[unit]")
{
    GltfFile file = test::makeTriangle();
    file.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"}, {"intensity", 10.0}, {"color", {1.0, 0.5, 0.25}}, {"spot", {{"outerConeAngle", 0.5}}}}};
    file.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.6}, {"znear", 0.2}}}}};
    file.json["nodes"].push_back(
        {{"translation", {1, 2, 3}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}, {"camera", 0}});
    file.json["scenes"][0]["nodes"] = {0, 1};
    const Scene scene = load(file);
    REQUIRE(scene.lights.size() == 1);
    CHECK(scene.lights[0].type == LightType::Spot);
    CHECK(scene.lights[0].intensity == glm::vec3(10, 5, 2.5));
    CHECK(scene.lights[0].outerCosine == Approx(std::cos(0.5f)));
    CHECK(scene.cameras.at(0).verticalFov == Approx(0.6f));
    CHECK(scene.nodes.at(1).light == 0);
    CHECK(scene.nodes.at(1).camera == 0);
}
