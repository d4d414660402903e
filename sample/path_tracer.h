// The path tracer: a scene and a camera in, the signals of one noisy frame (or of its reference) out, all on the
// device.
#pragma once
#include "camera.h"
#include "engine/compute.h"
#include "scene_pack.h"

#include <nrd/settings.h>

namespace sample
{
/// How many paths a frame spends on a pixel that has both lobes.
enum class Lobes : uint8_t
{
    Both,          // one path for each
    Probabilistic, // one path: for the lobe that chance picks, its radiance divided by the probability
    Merged         // one path for both, which makes one signal: `diffuse` with the factor of both; `specular` is 0
};

/// Reflections of smoother surfaces than this are sharp at any distance that matters; for TracerDesc.
constexpr float kMirrorRoughness = 0.05f;

struct TracerDesc
{
    uint32_t width = 0;      // pixels, > 0
    uint32_t height = 0;     // pixels, > 0
    uint32_t seed = 0;       // other seeds, other noise
    uint32_t maxBounces = 4; // [1; 64], rays after the primary one
    // Least roughness of a surface that is seen by a bounce off another, as a share of that one's (1 for diffuse).
    // Keeps caustics from becoming fireflies; 0 traces the scene as it is.
    float roughening = 0.5f;
    // A single path's demodulated radiance is scaled down to this in its brightest channel.
    float maxRadiance = 250.0f;
    // Of frames; references always have all samples. What a pixel does not trace is 0 in every component.
    Lobes lobes = Lobes::Both;
    nrd::CheckerboardMode checkerboard = nrd::CheckerboardMode::OFF; // each lobe in its half of the pixels
    uint32_t stride = 1; // [1; 8]: only every such pixel of every such row of frames has paths and a shadow
    glm::vec3 hitDistanceParameters = glm::vec3(3.0f, 0.1f, 20.0f); // A (world units), B, C
    // SceneLights::shadowLight lights the primary surface apart: not in `diffuse` and `specular`, but in `sun`, with
    // its shadow in `shadow`. Needs hasShadowLight().
    bool hasShadowSignal = false;
    // Metals and black surfaces up to this roughness are mirrors that the camera's ray follows: what it finds behind
    // them is the primary surface (of frames and references), unfolded to where the camera sees it. 0: none are;
    // smoother ones than 0.04 count as that.
    float mirrorRoughness = 0.0f;
};

/// What one frame leaves behind; meaning as in the capture format, unless noted. Floats, so that no device's rounding
/// on the way to half floats takes energy away.
struct FrameImages
{
    engine::Image viewZ;           // R32F, negative; sky: -2 * denoisingRange
    engine::Image normalRoughness; // this and the rest RGBA32F
    engine::Image motion;          // .w: material id
    engine::Image diffuse;         // .w: hit distance in world units
    engine::Image specular;
    engine::Image diffuseDirection;
    engine::Image specularDirection;
    engine::Image diffuseFactor;
    engine::Image specularFactor;
    engine::Image direct;
    engine::Image specularMotion; // of what the specular path hits first; .w: 0 without a sample
    engine::Image shadow;         // translucency, .w: distance. Without the signal this and the next are 1 x 1
    engine::Image sun;            // what the light gives without its shadow, .w: distance to it, 0: infinite
    // Not in captures. Where a sample's radiance comes from: between the directions of the bounce and of the light that
    // was sampled at the surface, by luminance; up to unit length.
    engine::Image diffuseOrigin;
    engine::Image specularOrigin;
};

/// Where and when a frame is traced from.
struct View
{
    Camera camera;
    glm::vec2 jitter = glm::vec2(0.0f); // pixels, [-0.5; 0.5]
    uint32_t frameIndex = 0;
};

/// Samples that are added to the sums of a reference in one go.
struct ReferenceBatch
{
    uint32_t first = 0; // index of the first; 0 clears the sums
    uint32_t count = 1;
};

class PathTracer
{
public:
    /// `environment` may be null; it is not kept. The scene's materials and textures are uploaded here.
    PathTracer(const engine::Device& device, const Scene& scene, const Environment* environment,
               const TracerDesc& desc);

    /// Rebuilds hierarchy, geometry and lights for a pose. Waits for the device: nothing that reads them may be
    /// pending.
    void setPose(const Scene& scene, const ScenePose& pose, const Environment* environment);

    /// Records one noisy frame into images(), which are left in storage state. At most 8 recordings may be pending.
    void recordFrame(VkCommandBuffer cmd, const View& view);

    /// Adds samples to sumDiffuse() and sumSpecular(): demodulated radiance and in .w normalised hit distance; and to
    /// sumShadow(): translucency and in .w the share of rays that crossed nothing. With the same view as a frame, their
    /// mean is the expectation of that frame.
    void recordReference(VkCommandBuffer cmd, const View& view, const ReferenceBatch& batch);

    /// Adds plain paths, without split and demodulation, to sumDiffuse(): what composing must agree with.
    void recordPlain(VkCommandBuffer cmd, const View& view, const ReferenceBatch& batch);

    /// Traces the paths of the frame that `view` showed once more, through the scene as it is now: of each tile of
    /// `tileSize` pixels a side the one of NRD_GetConfidencePixel, or the one with paths before it. `target` has a
    /// texel per tile; see IN_RETRACED_SAMPLE.
    void recordRetrace(VkCommandBuffer cmd, const View& view, engine::Image& target, uint32_t tileSize);

    /// What may change from frame to frame; the other fields of the description are final.
    void setLimits(uint32_t maxBounces, float roughening);
    void setHitDistanceParameters(const glm::vec3& parameters) { m_desc.hitDistanceParameters = parameters; }
    void setStride(uint32_t stride) { m_desc.stride = stride; }
    /// Another picture of the same size, or none where there was none; then setPose() must follow. Waits for the
    /// device.
    void setEnvironment(const Environment* environment);

    FrameImages& images() { return m_images; }
    uint32_t strideOfImages() const { return m_strideOfImages; } // of the last frame
    engine::Image& sumDiffuse() { return m_sumDiffuse; }
    engine::Image& sumSpecular() { return m_sumSpecular; }
    engine::Image& sumShadow() { return m_sumShadow; }
    const TracerDesc& desc() const { return m_desc; }

    /// The light of the shadow signal as it stands in the pose; null without the signal.
    const SceneLight* shadowLight() const { return m_shadowLight ? &*m_shadowLight : nullptr; }

    /// Surfaces further away count as sky, in world units; follows the size of the scene.
    float denoisingRange() const { return m_denoisingRange; }

private:
    // How light samples choose.
    struct LightTables
    {
        std::vector<AliasEntry> any, primary;
    };
    void storeLights(SceneLights lights, const Bvh& bvh);
    void createImages();
    void createTables(const Scene& scene, const Environment* environment);
    // Compiled when it is used first: a frame needs one, and each costs a second on a CPU.
    struct Program
    {
        std::vector<uint32_t> specialization;
        std::optional<engine::ComputePipeline> pipeline;
        std::vector<VkDescriptorSet> sets; // one per constants slot
    };
    void compile(uint32_t mode);
    void record(VkCommandBuffer cmd, uint32_t mode, const std::vector<engine::Image*>& targets, const View& view,
                const glm::uvec4& sampling, uint32_t tileSize = 1);
    void store(engine::Buffer& buffer, const char* name, const Words& words);
    const engine::Device& m_device;
    TracerDesc m_desc;
    BvhBuilder m_builder;
    FrameImages m_images;
    engine::Image m_sumDiffuse, m_sumSpecular, m_sumShadow;
    engine::Buffer m_nodes, m_triangles, m_vertices, m_motion, m_materials, m_texels, m_lights, m_environment, m_energy;
    engine::Buffer m_lightsAgain;            // those of the pose, chosen from as in the last frame
    LightTables m_tables, m_tablesOfFrame;   // of the pose, of the last frame before it
    bool m_isPoseTraced = false;             // there is a frame of it
    std::vector<engine::Buffer> m_constants; // ring
    uint32_t m_slot = 0;
    uint32_t m_strideOfImages = 1;
    std::array<Program, 4> m_programs; // by mode
    float m_denoisingRange = 1000.0f;
    float m_sceneRadius = 1.0f;
    glm::uvec4 m_environmentConstants = glm::uvec4(0); // size, light index
    uint32_t m_nodeCount = 0;
    uint32_t m_lightCount = 0;
    uint32_t m_shadowLightIndex = 0;
    std::optional<SceneLight> m_shadowLight;
};
} // namespace sample
