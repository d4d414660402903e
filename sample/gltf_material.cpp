#include "gltf_parts.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <tiny_gltf.h>

// Static: tinygltf brings its own copy of the same functions.
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_MAX_DIMENSIONS 16384
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#endif
#include <stb/stb_image.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace sample
{
namespace
{
Wrap toWrap(int mode)
{
    switch (mode)
    {
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
        return Wrap::Clamp;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
        return Wrap::Mirror;
    default:
        return Wrap::Repeat;
    }
}

float numberOf(const tinygltf::Value& object, const char* key, float otherwise)
{
    return object.Has(key) && object.Get(key).IsNumber() ? float(object.Get(key).GetNumberAsDouble()) : otherwise;
}

glm::vec2 vec2Of(const tinygltf::Value& object, const char* key, glm::vec2 otherwise)
{
    if (!object.Has(key)) return otherwise;
    const tinygltf::Value& array = object.Get(key);
    if (!array.IsArray() || array.ArrayLen() != 2 || !array.Get(0).IsNumber() || !array.Get(1).IsNumber())
        return otherwise;
    return {float(array.Get(0).GetNumberAsDouble()), float(array.Get(1).GetNumberAsDouble())};
}

void applyTransform(const tinygltf::ExtensionMap& extensions, TextureUse& use)
{
    const auto found = extensions.find("KHR_texture_transform");
    if (found == extensions.end() || !found->second.IsObject()) return;
    use.offset = vec2Of(found->second, "offset", use.offset);
    use.scale = vec2Of(found->second, "scale", use.scale);
    use.rotation = numberOf(found->second, "rotation", use.rotation);
    use.texCoord = int(numberOf(found->second, "texCoord", float(use.texCoord)));
}

// Info is one of tinygltf's three texture-info structs.
template <class Info> TextureUse toUse(const tinygltf::Model& model, const Info& info, const std::string& what)
{
    TextureUse use;
    if (info.index < 0) return use;
    if (size_t(info.index) >= model.textures.size())
        throw SceneError(what + " uses texture " + std::to_string(info.index) + ", which does not exist");
    const tinygltf::Texture& texture = model.textures[size_t(info.index)];
    if (texture.source < 0) return use; // its picture is in an optional extension we do not read
    if (size_t(texture.source) >= model.images.size())
        throw SceneError(what + " uses image " + std::to_string(texture.source) + ", which does not exist");
    use.texture = texture.source;
    use.texCoord = info.texCoord;
    if (texture.sampler >= 0 && size_t(texture.sampler) < model.samplers.size())
    {
        use.wrapU = toWrap(model.samplers[size_t(texture.sampler)].wrapS);
        use.wrapV = toWrap(model.samplers[size_t(texture.sampler)].wrapT);
    }
    applyTransform(info.extensions, use);
    if (use.texCoord < 0 || use.texCoord > 1)
        throw SceneError(what + " uses texture coordinates " + std::to_string(use.texCoord) +
                         "; 0 and 1 are supported");
    return use;
}

// Missing and non-finite numbers take the default; the rest is clamped to what the shader relies on.
float cleaned(double value, float low, float high, float otherwise)
{
    return std::isfinite(value) ? std::clamp(float(value), low, high) : otherwise;
}

glm::vec3 emissionOf(const tinygltf::Material& source)
{
    float strength = 1.0f;
    const auto found = source.extensions.find("KHR_materials_emissive_strength");
    if (found != source.extensions.end() && found->second.IsObject())
        strength = cleaned(numberOf(found->second, "emissiveStrength", 1.0f), 0.0f, 1e6f, 1.0f);
    glm::vec3 emission(0.0f);
    for (size_t i = 0; i < 3 && i < source.emissiveFactor.size(); ++i)
        emission[int(i)] = cleaned(source.emissiveFactor[i], 0.0f, 1e6f, 0.0f) * strength;
    return emission;
}

float numberOfExtension(const tinygltf::Material& source, const char* extension, const char* key, float otherwise)
{
    const auto found = source.extensions.find(extension);
    if (found == source.extensions.end() || !found->second.IsObject()) return otherwise;
    const float value = numberOf(found->second, key, otherwise);
    return std::isfinite(value) ? value : otherwise;
}

// All or nothing, since a guide describes one surface.
void readGlass(const tinygltf::Material& source, Material& material)
{
    material.isGlass = numberOfExtension(source, "KHR_materials_transmission", "transmissionFactor", 0.0f) >= 0.5f &&
                       material.metallic < 0.5f;
    material.isSolidGlass = numberOfExtension(source, "KHR_materials_volume", "thicknessFactor", 0.0f) > 0.0f;
    material.ior = std::clamp(numberOfExtension(source, "KHR_materials_ior", "ior", 1.5f), 1.0f, 4.0f);
}

Material toMaterial(const tinygltf::Model& model, const tinygltf::Material& source, const std::string& what)
{
    const auto& pbr = source.pbrMetallicRoughness;
    Material material;
    material.name = source.name;
    for (size_t i = 0; i < 4 && i < pbr.baseColorFactor.size(); ++i)
        material.baseColor[int(i)] = cleaned(pbr.baseColorFactor[i], 0.0f, 1.0f, 1.0f);
    material.metallic = cleaned(pbr.metallicFactor, 0.0f, 1.0f, 1.0f);
    material.roughness = cleaned(pbr.roughnessFactor, 0.0f, 1.0f, 1.0f);
    material.emission = emissionOf(source);
    material.normalScale = cleaned(source.normalTexture.scale, -100.0f, 100.0f, 1.0f);
    if (source.alphaMode == "MASK") material.alphaCutoff = cleaned(source.alphaCutoff, 0.0f, 2.0f, 0.5f);
    // A guide describes one surface: the blended one from an alpha of one half on, else what lies behind it.
    material.isBlended = source.alphaMode == "BLEND";
    if (material.isBlended) material.alphaCutoff = 0.5f;
    material.isDoubleSided = source.doubleSided;
    readGlass(source, material);
    material.baseColorTexture = toUse(model, pbr.baseColorTexture, what + ", base colour,");
    material.metallicRoughnessTexture = toUse(model, pbr.metallicRoughnessTexture, what + ", metallic-roughness,");
    material.normalTexture = toUse(model, source.normalTexture, what + ", normal,");
    material.emissiveTexture = toUse(model, source.emissiveTexture, what + ", emissive,");
    return material;
}

struct StbFree
{
    void operator()(unsigned char* pixels) const { stbi_image_free(pixels); }
};

Texture decode(const tinygltf::Image& image, size_t index)
{
    const std::string what = "image " + std::to_string(index) + (image.uri.empty() ? "" : " (" + image.uri + ")");
    if (image.image.empty()) throw SceneError(what + " has no data");
    Texture texture;
    int channels = 0;
    const std::unique_ptr<unsigned char, StbFree> pixels(stbi_load_from_memory(
        image.image.data(), int(image.image.size()), &texture.width, &texture.height, &channels, 4));
    if (!pixels) throw SceneError(what + " cannot be decoded: " + stbi_failure_reason());
    const size_t byteSize = size_t(texture.width) * size_t(texture.height) * 4;
    texture.rgba.assign(pixels.get(), pixels.get() + byteSize);
    return texture;
}
} // namespace

void readTextures(const tinygltf::Model& model, Scene& scene)
{
    for (size_t i = 0; i < model.images.size(); ++i) scene.textures.push_back(decode(model.images[i], i));
}

void readMaterials(const tinygltf::Model& model, Scene& scene)
{
    for (size_t i = 0; i < model.materials.size(); ++i)
        scene.materials.push_back(toMaterial(model, model.materials[i], "material " + std::to_string(i)));
    Material plain; // of primitives that name none: glTF's default
    plain.name = "default";
    scene.materials.push_back(plain);
}
} // namespace sample
