#include "denoise.h"

#include "nrd_sample_shaders.h"

#include <algorithm>
#include <cstring>
#include <glm/gtc/type_ptr.hpp>
#include <iterator>

namespace sample
{
namespace
{
constexpr nrd::Identifier kLobeDenoiser = 0, kShadowDenoiser = 1;

nrd::NrdUserImage toUserImage(const engine::Image& image)
{
    nrd::NrdUserImage user;
    user.image = image.handle();
    user.format = image.desc().format;
    user.width = image.desc().width;
    user.height = image.desc().height;
    user.usage = image.desc().usage;
    user.state = {image.state.layout, image.state.access, image.state.stage};
    return user;
}

void copyMatrix(const glm::mat4& from, float (&to)[16]) { std::memcpy(to, glm::value_ptr(from), sizeof(to)); }

// The weights of the lobes in a picture of occlusion; both 0: the picture is of light.
glm::vec2 occlusionWeights(const SampleDenoiser& denoiser)
{
    const glm::vec2 lobes(denoiser.hasOcclusionOnly(Lobe::Diffuse), denoiser.hasOcclusionOnly(Lobe::Specular));
    return lobes / std::max(lobes.x + lobes.y, 1.0f);
}

nrd::SPIRV findShader(void* userArg, const char* name)
{
    const ShaderModules& modules = *static_cast<const ShaderModules*>(userArg);
    const auto found = modules.find(name);
    if (found == modules.end()) return {};
    return {found->second.data(), found->second.size() * sizeof(uint32_t)};
}

// Where the light is, unless the user said otherwise.
nrd::SigmaSettings shadowSettings(const ReplaySettings& given, const SceneLight& light)
{
    nrd::SigmaSettings settings = given.sigma;
    const nrd::SigmaSettings untold;
    if (settings.isLightLocal || !std::equal(std::begin(untold.lightDirection), std::end(untold.lightDirection),
                                             std::begin(settings.lightDirection)))
        return settings;
    settings.isLightLocal = light.kind != LightKind::Directional;
    for (int i = 0; i < 3; ++i)
    {
        settings.lightDirection[i] = settings.isLightLocal ? 0.0f : -light.direction[i]; // it is the light's travel
        settings.lightPosition[i] = light.position[i];
    }
    return settings;
}
} // namespace

glm::vec3 hitDistanceParametersOf(const ReplaySettings& settings)
{
    const nrd::HitDistanceParameters& h = settings.reblur.hitDistanceParameters;
    return {h.A * settings.common.metersToUnits, h.B, h.C};
}

engine::DeviceDesc denoiserDeviceDesc()
{
    const nrd::RequiredDeviceFeatures required = nrd::GetRequiredDeviceFeatures();
    engine::DeviceDesc desc;
    desc.features = required.features;
    desc.extensions.assign(required.deviceExtensions, required.deviceExtensions + required.deviceExtensionsNum);
    return desc;
}

DenoiseStage::DenoiseStage(const engine::Device& device, const DenoiseDesc& desc)
    : m_device(device), m_desc(desc), m_compose(device)
{
    const Family family = desc.set.lobes->family;
    m_desc.hasConfidence &= family == Family::Reblur || family == Family::Relax;
    if (!desc.set.isNone()) createIntegration(); // first: it may be refused
    createImages();
    if (desc.hasTemporalAa) m_temporalAa.emplace(device, desc.width, desc.height);
    m_packGuides = createPixelPipeline(device, shaderBlob(Shader::PackGuides), 2, sizeof(glm::uvec2));
}

void DenoiseStage::check(nrd::Result result, const char* action) const
{
    if (result == nrd::Result::SUCCESS) return;
    throw engine::Error(std::string("cannot ") + action + ": " + m_integration.GetLastMessage());
}

uint32_t DenoiseStage::strideOf(const SampleDenoiser& denoiser) const
{
    return resolutionOf(denoiser.family, m_desc.resolution).stride();
}

void DenoiseStage::createImages()
{
    const auto create = [&](const char* name, VkFormat format) {
        return engine::Image(m_device, {name, m_desc.width, m_desc.height, format});
    };
    m_normalRoughness = create("normal and roughness", VK_FORMAT_A2B10G10R10_UNORM_PACK32);
    m_composed = create("composed", VK_FORMAT_R32G32B32A32_SFLOAT);
    const SampleDenoiser& denoiser = *m_desc.set.lobes;
    if (denoiser.family == Family::Reference) m_signal = create("composed noisy", VK_FORMAT_R32G32B32A32_SFLOAT);
    const uint32_t divisor = resolutionOf(denoiser.family, m_desc.resolution).divisor;
    if (m_desc.hasOverlay && !m_desc.set.isNone())
        m_overlay = engine::Image(m_device, {"validation overlay", engine::groupCount(m_desc.width, divisor),
                                             engine::groupCount(m_desc.height, divisor), VK_FORMAT_R8G8B8A8_UNORM});
    for (auto& confidence : m_confidences)
        if (m_desc.hasConfidence)
            confidence =
                engine::Image(m_device, {"history confidence", engine::groupCount(m_desc.width, Retrace::kTileSize),
                                         engine::groupCount(m_desc.height, Retrace::kTileSize), VK_FORMAT_R8_UNORM});
    if (m_desc.set.shadow)
        m_shadow.emplace(m_device,
                         ShadowSignalDesc{m_desc.set.shadow->denoiser == nrd::Denoiser::SIGMA_SHADOW_TRANSLUCENCY,
                                          m_desc.width, m_desc.height, strideOf(*m_desc.set.shadow)});
    for (Lobe lobe : kLobes)
    {
        const LobeFormat format = denoiser.format(lobe);
        if (format == LobeFormat::None) continue;
        m_lobes[static_cast<size_t>(lobe)].emplace(
            m_device, LobeSignalDesc{lobe, format, denoiser.family, m_desc.width, m_desc.height, strideOf(denoiser),
                                     hitDistanceParametersOf(m_desc.settings),
                                     checkerboardModeOf(m_desc.settings, denoiser.family)});
    }
}

void DenoiseStage::createIntegration()
{
    nrd::IntegrationCreationDesc creation;
    creation.native.instance = m_device.instance();
    creation.native.physicalDevice = m_device.physical();
    creation.native.device = m_device.handle();
    creation.native.queueFamilyIndex = m_device.queueFamily();
    creation.native.getInstanceProcAddr = vkGetInstanceProcAddr;
    creation.native.enabledFeatures = &m_device.enabledFeatures();
    creation.resourceWidth = static_cast<uint16_t>(m_desc.width);
    creation.resourceHeight = static_cast<uint16_t>(m_desc.height);
    creation.framesInFlight = m_desc.framesInFlight;
    creation.createDefaultPipelines = true;
    creation.isGpuTimingEnabled = m_desc.isTimed;
    creation.findShader = m_desc.shaders ? findShader : nullptr;
    creation.findShaderArg = const_cast<ShaderModules*>(m_desc.shaders);
    std::vector<nrd::DenoiserDesc> denoisers;
    const auto add = [&](nrd::Identifier identifier, const SampleDenoiser& row)
    { denoisers.push_back(denoiserDesc(identifier, row.denoiser, resolutionOf(row.family, m_desc.resolution))); };
    if (m_desc.set.lobes->family != Family::None) add(kLobeDenoiser, *m_desc.set.lobes);
    if (m_desc.set.shadow) add(kShadowDenoiser, *m_desc.set.shadow);
    nrd::InstanceCreationDesc instance;
    instance.denoisers = denoisers.data();
    instance.denoisersNum = static_cast<uint32_t>(denoisers.size());
    if (m_desc.hasConfidence) instance.confidenceTileSize = Retrace::kTileSize;
    check(m_integration.Create(creation, instance), "create the denoiser");
    applyFamilySettings();
}

void DenoiseStage::applyFamilySettings()
{
    const auto apply = [&](const SampleDenoiser& denoiser, nrd::Identifier identifier)
    {
        const auto set = [&](const auto& own) { return m_integration.SetDenoiserSettings(identifier, own); };
        check(setDenoiserSettings(m_desc.settings, denoiser.family, set), "set the denoiser's settings");
    };
    apply(*m_desc.set.lobes, kLobeDenoiser);
    if (m_desc.set.shadow) apply(*m_desc.set.shadow, kShadowDenoiser);
    if (m_desc.hasConfidence)
        check(m_integration.SetConfidenceSettings(m_desc.settings.confidence), "set up the history confidence");
}

engine::Image* DenoiseStage::denoised(Lobe lobe)
{
    std::optional<LobeSignal>& signal = m_lobes[static_cast<size_t>(lobe)];
    return signal ? &signal->values() : nullptr;
}

engine::Image* DenoiseStage::confidence(Lobe lobe)
{
    std::optional<engine::Image>& image = m_confidences[static_cast<size_t>(lobe)];
    return image ? &*image : nullptr;
}

void DenoiseStage::setSettings(const ReplaySettings& settings, const std::vector<Assignment>& assignments)
{
    const DenoiseDesc before = m_desc;
    m_desc.settings = settings;
    m_desc.assignments = assignments;
    try
    {
        if (m_integration.IsCreated()) applyFamilySettings();
    }
    catch (const engine::Error&)
    {
        m_desc = before;
        applyFamilySettings();
        throw;
    }
    for (auto& lobe : m_lobes)
        if (lobe) lobe->setHitDistanceParameters(hitDistanceParametersOf(settings));
}

nrd::MemoryStatistics DenoiseStage::memory() const
{
    return m_integration.IsCreated() ? m_integration.GetMemoryStatistics() : nrd::MemoryStatistics{};
}

std::set<std::string> DenoiseStage::shaders() const
{
    std::set<std::string> names;
    if (!m_integration.IsCreated()) return names;
    const nrd::InstanceDesc& instance = nrd::GetInstanceDesc(*m_integration.GetInstance());
    for (uint32_t i = 0; i < instance.pipelinesNum; ++i) names.insert(instance.pipelines[i].shaderIdentifier);
    return names;
}

nrd::Timings DenoiseStage::timings() const
{
    return m_integration.IsCreated() ? m_integration.GetTimings() : nrd::Timings{};
}

void DenoiseStage::record(VkCommandBuffer cmd, FrameImages& images, const DenoiseFrame& frame)
{
    if (m_integration.IsCreated()) beginFrame(frame);
    if (m_desc.hasConfidence) makeConfidence(cmd, *frame.retrace);
    if (m_lobes[0] || m_lobes[1] || m_shadow) denoiseSignals(cmd, images, frame);
    compose(cmd, images);
    if (m_desc.set.lobes->family == Family::Reference)
        denoise(cmd, {kLobeDenoiser},
                {{nrd::ResourceType::IN_SIGNAL, &m_signal}, {nrd::ResourceType::OUT_SIGNAL, &m_composed}});
    if (m_temporalAa)
        m_temporalAa->record(cmd, images, m_composed, frame.view, m_previous && !frame.isCut ? &*m_previous : nullptr);
    m_previous = frame.view;
}

void DenoiseStage::beginFrame(const DenoiseFrame& frame)
{
    check(m_integration.NewFrame(), "begin a frame of the denoiser");
    if (m_desc.set.shadow)
        check(m_integration.SetDenoiserSettings(kShadowDenoiser, shadowSettings(m_desc.settings, *frame.shadowLight)),
              "set the light");
    check(m_integration.SetCommonSettings(settingsOf(frame)), "set the frame's settings");
}

void DenoiseStage::denoiseSignals(VkCommandBuffer cmd, FrameImages& images, const DenoiseFrame& frame)
{
    packGuides(cmd, images);
    std::vector<nrd::Identifier> identifiers;
    if (m_lobes[0] || m_lobes[1]) identifiers.push_back(kLobeDenoiser);
    for (auto& lobe : m_lobes)
        if (lobe) lobe->recordPack(cmd, images, frame.view.frameIndex);
    if (m_shadow) identifiers.push_back(kShadowDenoiser);
    if (m_shadow) m_shadow->recordPack(cmd, images, *frame.shadowLight);
    denoise(cmd, identifiers, slots(images));
    for (auto& lobe : m_lobes)
        if (lobe) lobe->recordUnpack(cmd, images, frame.denoisingRange);
    if (m_shadow) m_shadow->recordUnpack(cmd, images, frame.denoisingRange);
}

void DenoiseStage::packGuides(VkCommandBuffer cmd, FrameImages& images)
{
    transition(cmd, images.normalRoughness, engine::kSampled);
    transition(cmd, images.motion, engine::kSampled);
    transition(cmd, m_normalRoughness, engine::kStorage);
    if (!m_packGuidesSet)
        m_packGuidesSet = m_packGuides.createSet({images.normalRoughness, images.motion, m_normalRoughness});
    const glm::uvec2 size(m_desc.width, m_desc.height);
    dispatchPixels(cmd, m_packGuides, m_packGuidesSet, size, size);
}

nrd::CommonSettings DenoiseStage::settingsOf(const DenoiseFrame& frame) const
{
    const bool isCut = frame.isCut || !m_previous;
    const View& previous = isCut ? frame.view : *m_previous;
    ReplaySettings settings = m_desc.settings;
    nrd::CommonSettings& s = settings.common;
    copyMatrix(frame.view.camera.viewToClip, s.viewToClipMatrix);
    copyMatrix(previous.camera.viewToClip, s.viewToClipMatrixPrev);
    copyMatrix(frame.view.camera.worldToView, s.worldToViewMatrix);
    copyMatrix(previous.camera.worldToView, s.worldToViewMatrixPrev);
    s.motionVectorScale[2] = 1.0f;
    s.isMotionVectorInWorldSpace = true;
    for (int i = 0; i < 2; ++i)
    {
        s.cameraJitter[i] = frame.view.jitter[i];
        s.cameraJitterPrev[i] = previous.jitter[i];
        const auto size = static_cast<uint16_t>(i == 0 ? m_desc.width : m_desc.height);
        s.resourceSize[i] = s.resourceSizePrev[i] = s.rectSize[i] = s.rectSizePrev[i] = size;
    }
    s.timeDeltaBetweenFrames = frame.deltaTimeMs;
    s.denoisingRange = frame.denoisingRange;
    s.frameIndex = frame.view.frameIndex;
    s.accumulationMode = isCut ? nrd::AccumulationMode::CLEAR_AND_RESTART : nrd::AccumulationMode::CONTINUE;
    s.isSpecularMotionAvailable = m_desc.isSceneMoving;
    s.isHistoryConfidenceAvailable = m_desc.hasConfidence;
    // Of other sets' settings this set has none.
    std::vector<Assignment> common;
    for (const Assignment& assignment : m_desc.assignments)
        if (isCommonSetting(assignment.first)) common.push_back(assignment);
    applySettings(settings, Family::None, common);
    return s;
}

std::vector<SlotImage> DenoiseStage::slots(FrameImages& images)
{
    using nrd::ResourceType;
    std::vector<SlotImage> all = {{ResourceType::IN_MV, &images.motion},
                                  {ResourceType::IN_NORMAL_ROUGHNESS, &m_normalRoughness},
                                  {ResourceType::IN_VIEWZ, &images.viewZ}};
    if (denoised(Lobe::Specular) && strideOf(*m_desc.set.lobes) == 1)
        all.emplace_back(ResourceType::IN_SPEC_MV, &images.specularMotion);
    const auto add = [&](const std::vector<SlotImage>& own) { all.insert(all.end(), own.begin(), own.end()); };
    for (auto& lobe : m_lobes)
        if (lobe) add(lobe->slots());
    if (m_shadow) add(m_shadow->slots());
    if (m_overlay) all.emplace_back(ResourceType::OUT_VALIDATION, &*m_overlay);
    if (m_desc.hasConfidence)
    {
        all.emplace_back(ResourceType::IN_DIFF_CONFIDENCE, confidence(Lobe::Diffuse));
        all.emplace_back(ResourceType::IN_SPEC_CONFIDENCE, confidence(Lobe::Specular));
    }
    return all;
}

void DenoiseStage::makeConfidence(VkCommandBuffer cmd, Retrace& retrace)
{
    using nrd::ResourceType;
    use({{ResourceType::IN_STORED_SAMPLE, &retrace.storedSample()},
         {ResourceType::IN_RETRACED_SAMPLE, &retrace.retracedSample()},
         {ResourceType::IN_STORED_NORMAL_ROUGHNESS, &retrace.storedNormalRoughness()},
         {ResourceType::IN_DIFF_CONFIDENCE, confidence(Lobe::Diffuse)},
         {ResourceType::IN_SPEC_CONFIDENCE, confidence(Lobe::Specular)}},
        [&](nrd::NrdUserPool& pool) { return m_integration.ComputeConfidence(cmd, pool); });
}

void DenoiseStage::denoise(VkCommandBuffer cmd, const std::vector<nrd::Identifier>& identifiers,
                           const std::vector<SlotImage>& images)
{
    use(images, [&](nrd::NrdUserPool& pool)
        { return m_integration.Denoise(cmd, identifiers.data(), static_cast<uint32_t>(identifiers.size()), pool); });
}

// As a user pool, whose entries say afterwards how the images were left.
void DenoiseStage::use(const std::vector<SlotImage>& all, const std::function<nrd::Result(nrd::NrdUserPool&)>& record)
{
    nrd::NrdUserPool pool;
    for (const auto& [slot, image] : all) pool[slot] = toUserImage(*image);
    check(record(pool), "denoise");
    for (const auto& [slot, image] : all)
    {
        const nrd::NrdImageState& state = pool[slot].state;
        image->state = {state.layout, state.access, state.stages};
    }
}

void DenoiseStage::compose(VkCommandBuffer cmd, FrameImages& images)
{
    engine::Image& target = m_desc.set.lobes->family == Family::Reference ? m_signal : m_composed;
    engine::Image* diffuse = denoised(Lobe::Diffuse);
    engine::Image* specular = denoised(Lobe::Specular);
    const ComposeSignals signals = {diffuse ? diffuse : &images.diffuse, specular ? specular : &images.specular,
                                    m_shadow ? &m_shadow->values() : &images.shadow};
    m_compose.record(
        cmd, images, signals, target,
        {glm::uvec2(m_desc.width, m_desc.height), occlusionWeights(*m_desc.set.lobes), m_desc.hasShadowSignal});
}
} // namespace sample
