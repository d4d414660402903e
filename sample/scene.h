// A scene as it was read: meshes, materials, nodes, animation. Plain data in memory, validated by whoever fills it.
#pragma once
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace sample
{
/// A scene that cannot be used, in one sentence that names the file and the part.
class SceneError : public std::runtime_error
{
public:
    using std::runtime_error::runtime_error;
};

constexpr int kNone = -1; // an index that refers to nothing

/// 8-bit picture, row 0 on top, four channels.
struct Texture
{
    int width = 0;
    int height = 0;
    std::vector<uint8_t> rgba; // width * height * 4
};

enum class Wrap : uint8_t
{
    Repeat,
    Clamp,
    Mirror
};

/// How a material reads a texture: which, by which coordinates, through which transform (KHR_texture_transform).
struct TextureUse
{
    int texture = kNone;
    int texCoord = 0; // 0 or 1
    Wrap wrapU = Wrap::Repeat;
    Wrap wrapV = Wrap::Repeat;
    glm::vec2 offset = glm::vec2(0.0f);
    glm::vec2 scale = glm::vec2(1.0f);
    float rotation = 0.0f; // radians, counter-clockwise
};

/// glTF's metallic-roughness material.
struct Material
{
    std::string name;
    glm::vec4 baseColor = glm::vec4(1.0f); // linear, [0; 1]
    float metallic = 1.0f;                 // [0; 1]
    float roughness = 1.0f;                // [0; 1], perceptual
    glm::vec3 emission = glm::vec3(0.0f);  // radiance, factor times strength
    float normalScale = 1.0f;
    float alphaCutoff = 0.0f; // a surface with alpha below it is not there; 0 = opaque
    bool isBlended = false;   // lets light through, tinted; where alphaCutoff says it is there, rays still end at it
    bool isDoubleSided = false;
    bool isGlass = false;     // the camera sees through it, bent where it is solid; light passes straight, tinted
    bool isSolidGlass = true; // false: a pane without thickness, which bends nothing
    float ior = 1.5f;         // of glass, [1; 4]
    TextureUse baseColorTexture;
    TextureUse metallicRoughnessTexture;
    TextureUse normalTexture;
    TextureUse emissiveTexture;
};

struct MorphTarget
{
    std::vector<glm::vec3> positions; // per vertex, or empty
    std::vector<glm::vec3> normals;
};

/// Triangles of one material. Every per-vertex array is empty or as long as `positions`, every index is below that.
struct Primitive
{
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec4> tangents; // .w: sign of the bitangent
    std::array<std::vector<glm::vec2>, 2> texCoords;
    std::vector<glm::vec4> colors;
    std::vector<glm::uvec4> joints;
    std::vector<glm::vec4> weights;
    std::vector<MorphTarget> targets;
    std::vector<uint32_t> indices; // three per triangle
    int material = 0;
};

struct Mesh
{
    std::vector<Primitive> primitives;
    std::vector<float> weights; // of the morph targets, at rest
};

struct Node
{
    std::string name;
    int parent = kNone;
    glm::vec3 translation = glm::vec3(0.0f);
    glm::quat rotation = glm::quat(1.0f, 0.0f, 0.0f, 0.0f);
    glm::vec3 scale = glm::vec3(1.0f);
    std::optional<glm::mat4> matrix; // instead of the three above
    int mesh = kNone;
    int skin = kNone;
    int camera = kNone;
    int light = kNone;
    std::vector<float> weights; // of the morph targets; empty: the mesh's
};

struct Skin
{
    std::vector<int> joints; // nodes
    std::vector<glm::mat4> inverseBind;
};

enum class AnimationPath : uint8_t
{
    Translation,
    Rotation,
    Scale,
    Weights
};

enum class Interpolation : uint8_t
{
    Linear,
    Step,
    Cubic
};

/// Keys of one property of one node.
struct AnimationChannel
{
    int node = kNone;
    AnimationPath path = AnimationPath::Translation;
    Interpolation interpolation = Interpolation::Linear;
    uint32_t valueSize = 3;    // floats per value
    std::vector<float> times;  // seconds, not decreasing, at least one
    std::vector<float> values; // times.size() * valueSize, for Cubic three times that (in-tangent, value, out-tangent)
};

struct PerspectiveCamera
{
    float verticalFov = 0.8f; // radians, (0; pi)
    float nearPlane = 0.01f;  // > 0, world units
};

enum class LightType : uint8_t
{
    Directional,
    Point,
    Spot
};

/// KHR_lights_punctual with an extent, which glTF does not know; shines along the node's -Z.
struct PunctualLight
{
    LightType type = LightType::Point;
    glm::vec3 intensity = glm::vec3(1.0f); // colour times candela, directional: times lux
    float range = 0.0f;                    // world units, 0 = without end
    float innerCosine = 1.0f;
    float outerCosine = 0.70710678f;
    float radius = 0.05f;              // world units, of a disc that faces what it lights; not of directional ones
    float tanAngularRadius = 0.00471f; // of directional ones: 0.27 degrees, as the sun's
};

struct Scene
{
    std::string name;
    std::vector<Texture> textures;
    std::vector<Material> materials; // at least one
    std::vector<Mesh> meshes;
    std::vector<Node> nodes;            // parents before children
    glm::vec3 origin = glm::vec3(0.0f); // where the nodes without a parent have theirs, world units
    std::vector<Skin> skins;
    std::vector<PerspectiveCamera> cameras;
    std::vector<PunctualLight> lights;
    std::vector<AnimationChannel> channels; // of the first animation
    float duration = 0.0f;                  // seconds after which the animation repeats, 0 = nothing moves
};
} // namespace sample
