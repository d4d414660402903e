#include "path_tracer.h"

#include "engine/transfer.h"
#include "nrd_sample_shaders.h"
#include "shaders/trace_constants.h"

#include <algorithm>
#include <cstring>

namespace sample
{
namespace
{
constexpr uint32_t kSlotCount = 8;
constexpr uint32_t kSceneBindings = 10; // constants and the texel buffers
constexpr uint32_t kGroupSize = 8;      // pixels per side

struct ModeRow
{
    Shader shader;
    size_t targetCount; // images it writes
};
constexpr uint32_t kFrameMode = 0, kReferenceMode = 1, kPlainMode = 2, kRetraceMode = 3;
constexpr ModeRow kModes[] = {
    {Shader::TraceFrame, 15}, {Shader::TraceReference, 3}, {Shader::TracePlain, 2}, {Shader::TraceAgain, 1}};

// What the tracer is asked for applies to frames; a reference has all samples, plain paths have nothing apart.
TracerDesc descOfMode(TracerDesc desc, uint32_t mode)
{
    if (mode == kRetraceMode) return desc;
    if (mode > 0) desc.checkerboard = nrd::CheckerboardMode::OFF;
    if (mode > 1 || (mode > 0 && desc.lobes == Lobes::Probabilistic)) desc.lobes = Lobes::Both;
    if (mode > 1) desc.hasShadowSignal = false;
    if (mode > 1) desc.mirrorRoughness = 0.0f;
    return desc;
}

bool usesTextures(const Scene& scene)
{
    if (!scene.textures.empty()) return true;
    for (const Mesh& mesh : scene.meshes)
        for (const Primitive& p : mesh.primitives)
            if (!p.colors.empty()) return true;
    return false;
}

// Same order as the constant ids in scene_data.glsl, lobe_choice.glsl and primary.glsl.
std::vector<uint32_t> specializationOf(const Scene& scene, bool hasEnvironment, const TracerDesc& desc)
{
    const auto any = [](const auto& list, auto predicate) { return std::any_of(list.begin(), list.end(), predicate); };
    const bool hasMask = any(scene.materials, [](const Material& m) { return m.alphaCutoff > 0.0f || m.isGlass; });
    const bool hasEmission = any(scene.materials, [](const Material& m) { return glm::length(m.emission) > 0.0f; });
    const bool hasPunctual = any(scene.nodes, [](const Node& n) { return n.light != kNone; });
    return {usesTextures(scene),
            hasMask,
            hasEmission,
            hasPunctual,
            hasEnvironment,
            !scene.channels.empty(),
            desc.lobes == Lobes::Probabilistic,
            static_cast<uint32_t>(desc.checkerboard),
            desc.hasShadowSignal,
            any(scene.materials, [](const Material& m) { return m.isBlended || m.isGlass; }),
            desc.lobes == Lobes::Merged,
            desc.mirrorRoughness > 0.0f,
            any(scene.materials, [](const Material& m) { return m.isGlass; })};
}

uint32_t environmentLight(const SceneLights& lights)
{
    const auto found = std::find_if(lights.lights.begin(), lights.lights.end(),
                                    [](const SceneLight& light) { return light.kind == LightKind::Environment; });
    return static_cast<uint32_t>(found - lights.lights.begin());
}
} // namespace

PathTracer::PathTracer(const engine::Device& device, const Scene& scene, const Environment* environment,
                       const TracerDesc& desc)
    : m_device(device), m_desc(desc)
{
    createImages();
    createTables(scene, environment);
    engine::BufferDesc constants;
    constants.name = "trace constants";
    constants.byteSize = sizeof(TraceConstants);
    constants.usage = VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT;
    constants.isHostVisible = true;
    for (uint32_t i = 0; i < kSlotCount; ++i) m_constants.emplace_back(device, constants);
    for (uint32_t mode = 0; mode < m_programs.size(); ++mode)
        m_programs[mode].specialization = specializationOf(scene, environment != nullptr, descOfMode(desc, mode));
    compile(kFrameMode);
}

void PathTracer::createImages()
{
    const auto create = [&](const char* name, VkFormat format) {
        return engine::Image(m_device, {name, m_desc.width, m_desc.height, format});
    };
    m_images.viewZ = create("traced viewZ", VK_FORMAT_R32_SFLOAT);
    const std::pair<engine::Image*, const char*> vectors[] = {
        {&m_images.normalRoughness, "traced normal"},
        {&m_images.motion, "traced motion"},
        {&m_images.diffuse, "traced diffuse"},
        {&m_images.specular, "traced specular"},
        {&m_images.diffuseDirection, "traced diffuse direction"},
        {&m_images.specularDirection, "traced specular direction"},
        {&m_images.diffuseFactor, "traced diffuse factor"},
        {&m_images.specularFactor, "traced specular factor"},
        {&m_images.direct, "traced direct"},
        {&m_images.diffuseOrigin, "traced diffuse origin"},
        {&m_images.specularOrigin, "traced specular origin"},
        {&m_images.specularMotion, "traced specular motion"},
        {&m_sumDiffuse, "reference diffuse"},
        {&m_sumSpecular, "reference specular"}};
    const uint32_t width = m_desc.hasShadowSignal ? m_desc.width : 1,
                   height = m_desc.hasShadowSignal ? m_desc.height : 1;
    for (const auto& [image, name] :
         {std::pair(&m_images.shadow, "traced shadow"), std::pair(&m_images.sun, "traced sun"),
          std::pair(&m_sumShadow, "reference shadow")})
        *image = engine::Image(m_device, {name, width, height, VK_FORMAT_R32G32B32A32_SFLOAT});
    for (const auto& [image, name] : vectors) *image = create(name, VK_FORMAT_R32G32B32A32_SFLOAT);
}

void PathTracer::createTables(const Scene& scene, const Environment* environment)
{
    const PackedTexels texels = packTexels(scene);
    if (texels.rgba.size() / 4 > m_device.properties().limits.maxTexelBufferElements)
        throw SceneError("the textures of '" + scene.name + "' have more texels than the device can address");
    engine::BufferDesc desc;
    desc.name = "texels";
    desc.usage = VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;
    desc.texelFormat = VK_FORMAT_R8G8B8A8_UNORM;
    m_texels = engine::createFilled(m_device, desc, std::as_bytes(std::span(texels.rgba)));
    const std::vector<glm::vec4> energy = packEnergyTable();
    desc.name = "energy table";
    desc.texelFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
    m_energy = engine::createFilled(m_device, desc, std::as_bytes(std::span(energy)));
    store(m_materials, "materials", packMaterials(scene, texels));
    setEnvironment(environment);
}

void PathTracer::compile(uint32_t mode)
{
    Program& program = m_programs[mode];
    if (program.pipeline) return;
    const ShaderBlob blob = shaderBlob(kModes[mode].shader);
    engine::ComputeDesc desc;
    desc.name = blob.name;
    desc.words = blob.words;
    desc.byteSize = blob.byteSize;
    desc.bindings.assign(kSceneBindings, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER);
    desc.bindings[0] = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    desc.bindings.resize(kSceneBindings + kModes[mode].targetCount, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE);
    desc.setCount = kSlotCount;
    desc.specialization = program.specialization;
    program.pipeline.emplace(m_device, desc);
    program.sets.assign(kSlotCount, VK_NULL_HANDLE);
}

void PathTracer::setLimits(uint32_t maxBounces, float roughening)
{
    m_desc.maxBounces = maxBounces;
    m_desc.roughening = roughening;
}

void PathTracer::setEnvironment(const Environment* environment)
{
    m_device.waitIdle();
    store(m_environment, "environment", environment ? packEnvironment(*environment) : Words(2, glm::uvec4(0)));
    if (environment) m_environmentConstants = glm::uvec4(environment->width, environment->height, 0, 0);
}

// A texel buffer grows by a quarter more than needed, so that a moving scene seldom replaces it.
void PathTracer::store(engine::Buffer& buffer, const char* name, const Words& words)
{
    if (words.size() > m_device.properties().limits.maxTexelBufferElements)
        throw SceneError(std::string("the scene's ") + name + " are more than the device can address");
    const auto bytes = std::as_bytes(std::span(words));
    if (buffer.byteSize() < bytes.size())
    {
        engine::BufferDesc desc;
        desc.name = name;
        desc.byteSize = bytes.size() + bytes.size() / 64 * 16;
        desc.usage = VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;
        desc.texelFormat = VK_FORMAT_R32G32B32A32_UINT;
        buffer = engine::Buffer(m_device, desc);
    }
    engine::upload(m_device, buffer, bytes);
}

void PathTracer::setPose(const Scene& scene, const ScenePose& pose, const Environment* environment)
{
    m_device.waitIdle();
    const Bvh bvh = m_builder.build(trianglePositions(pose));
    const SceneLights lights = collectLights(scene, pose, environment);
    const PackedGeometry geometry = packGeometry(pose, bvh, lights);
    store(m_nodes, "hierarchy nodes", geometry.nodes);
    store(m_triangles, "triangles", geometry.triangles);
    store(m_vertices, "vertices", geometry.vertices);
    store(m_motion, "motion vectors", geometry.motion);
    storeLights(lights, bvh);
    m_nodeCount = bvh.nodeCount;
    m_lightCount = static_cast<uint32_t>(lights.lights.size());
    m_environmentConstants.z = environmentLight(lights);
    m_shadowLight.reset();
    if (m_desc.hasShadowSignal && lights.shadowLight == kNone)
        throw SceneError("'" + scene.name + "' has neither a sun nor a spot light whose shadow could be a signal");
    if (m_desc.hasShadowSignal)
    {
        m_shadowLightIndex = static_cast<uint32_t>(lights.shadowLight);
        m_shadowLight = lights.lights[m_shadowLightIndex];
    }
    m_sceneRadius = pose.bounds().radius();
    m_denoisingRange = std::max(1000.0f, 100.0f * m_sceneRadius);
}

// Paths that are traced again make the choices of the last frame, or they would differ for that alone.
void PathTracer::storeLights(SceneLights lights, const Bvh& bvh)
{
    store(m_lights, "lights", packLights(lights, bvh));
    if (m_isPoseTraced) m_tablesOfFrame = std::move(m_tables);
    m_isPoseTraced = false;
    m_tables = {lights.table, lights.primaryTable};
    if (m_tablesOfFrame.any.size() == lights.lights.size())
    {
        lights.table = m_tablesOfFrame.any;
        lights.primaryTable = m_tablesOfFrame.primary;
    }
    store(m_lightsAgain, "lights of re-traced paths", packLights(lights, bvh));
}

void PathTracer::recordFrame(VkCommandBuffer cmd, const View& view)
{
    FrameImages& i = m_images;
    const std::vector<engine::Image*> targets = {&i.viewZ,
                                                 &i.normalRoughness,
                                                 &i.motion,
                                                 &i.diffuse,
                                                 &i.specular,
                                                 &i.diffuseDirection,
                                                 &i.specularDirection,
                                                 &i.diffuseFactor,
                                                 &i.specularFactor,
                                                 &i.direct,
                                                 &i.diffuseOrigin,
                                                 &i.specularOrigin,
                                                 &i.specularMotion,
                                                 &i.shadow,
                                                 &i.sun};
    m_strideOfImages = m_desc.stride;
    m_isPoseTraced = true;
    record(cmd, kFrameMode, targets, view, glm::uvec4(m_desc.seed, view.frameIndex, 1, 1), m_desc.stride);
}

void PathTracer::recordReference(VkCommandBuffer cmd, const View& view, const ReferenceBatch& batch)
{
    // Another seed than the frames', so that a frame is no part of its own reference.
    record(cmd, kReferenceMode, {&m_sumDiffuse, &m_sumSpecular, &m_sumShadow}, view,
           glm::uvec4(m_desc.seed + 0x5EED, batch.first, batch.count, batch.first == 0));
}

void PathTracer::recordPlain(VkCommandBuffer cmd, const View& view, const ReferenceBatch& batch)
{
    record(cmd, kPlainMode, {&m_sumDiffuse, &m_sumSpecular}, view,
           glm::uvec4(m_desc.seed + 0xBEEF, batch.first, batch.count, batch.first == 0));
}

void PathTracer::recordRetrace(VkCommandBuffer cmd, const View& view, engine::Image& target, uint32_t tileSize)
{
    record(cmd, kRetraceMode, {&target}, view, glm::uvec4(m_desc.seed, view.frameIndex, 1, 1), tileSize);
}

void PathTracer::record(VkCommandBuffer cmd, uint32_t mode, const std::vector<engine::Image*>& targets,
                        const View& view, const glm::uvec4& sampling, uint32_t tileSize)
{
    compile(mode);
    Program& program = m_programs[mode];
    m_slot = (m_slot + 1) % kSlotCount;
    TraceConstants c = {};
    c.worldToView = view.camera.worldToView;
    c.viewToWorld = glm::inverse(view.camera.worldToView);
    c.frustum = glm::vec4(view.camera.tanHalfFovX, view.camera.tanHalfFovY,
                          2.0f * view.camera.tanHalfFovY / float(m_desc.height), -2.0f * m_denoisingRange);
    // Twenty units in the last place of a position, and a share of the scene for surfaces near the origin.
    c.jitter = glm::vec4(view.jitter, 2.5e-6f, 1e-6f * m_sceneRadius);
    c.hitDistanceParameters = glm::vec4(m_desc.hitDistanceParameters, m_desc.maxRadiance);
    c.limits = glm::vec4(m_desc.roughening, m_desc.mirrorRoughness, 0.0f, 0.0f);
    c.size = glm::uvec4(m_desc.width, m_desc.height, m_nodeCount, m_lightCount);
    c.environment = m_environmentConstants;
    c.environment.w = m_desc.maxBounces;
    c.sampling = sampling;
    c.shadow = glm::uvec4(m_shadowLightIndex, 0, 0, 0);
    c.tiles = glm::uvec4(engine::groupCount(m_desc.width, tileSize), engine::groupCount(m_desc.height, tileSize),
                         tileSize, m_strideOfImages);
    std::memcpy(m_constants[m_slot].mapped().data(), &c, sizeof(c));

    const engine::Buffer& lights = mode == kRetraceMode && !m_isPoseTraced ? m_lightsAgain : m_lights;
    std::vector<engine::Binding> bindings = {m_constants[m_slot], m_nodes,  m_triangles, m_vertices,    m_motion,
                                             m_materials,         m_texels, lights,      m_environment, m_energy};
    for (engine::Image* target : targets)
    {
        transition(cmd, *target, engine::kStorage);
        bindings.emplace_back(*target);
    }
    VkDescriptorSet& set = program.sets[m_slot];
    if (set)
        program.pipeline->writeSet(set, bindings);
    else
        set = program.pipeline->createSet(bindings);
    const uint32_t groups = engine::groupCount(c.tiles.x, kGroupSize) * engine::groupCount(c.tiles.y, kGroupSize);
    const uint32_t pixelsOfTile = mode == kRetraceMode ? 1 : tileSize * tileSize;
    program.pipeline->dispatch(cmd, set, {}, {groups, pixelsOfTile, 1});
}
} // namespace sample
