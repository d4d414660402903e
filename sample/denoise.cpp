#include "denoise.h"

#include "nrd_sample_shaders.h"

#include <cstring>
#include <glm/gtc/type_ptr.hpp>

namespace sample
{
namespace
{
constexpr nrd::Identifier kIdentifier = 0;
constexpr uint32_t kGroupSize = 8;

struct ComposeConstants
{
    glm::uvec2 size;
    glm::vec2 occlusionWeights;
};

engine::ComputePipeline createPipeline(const engine::Device& device, Shader shader, uint32_t sampledCount,
                                       uint32_t constantsByteSize)
{
    const ShaderBlob blob = shaderBlob(shader);
    engine::ComputeDesc pipeline;
    pipeline.name = blob.name;
    pipeline.words = blob.words;
    pipeline.byteSize = blob.byteSize;
    pipeline.bindings.assign(sampledCount, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE);
    pipeline.bindings.push_back(VK_DESCRIPTOR_TYPE_STORAGE_IMAGE);
    pipeline.pushConstantByteSize = constantsByteSize;
    return {device, pipeline};
}

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

template <class T> std::span<const std::byte> bytesOf(const T& value) { return std::as_bytes(std::span(&value, 1)); }
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

DenoiseStage::DenoiseStage(const engine::Device& device, const DenoiseDesc& desc) : m_device(device), m_desc(desc)
{
    if (desc.denoiser.family != Family::None) createIntegration(); // first: it may be refused
    createImages();
    m_packGuides = createPipeline(device, Shader::PackGuides, 2, sizeof(glm::uvec2));
    m_compose = createPipeline(device, Shader::Compose, 5, sizeof(ComposeConstants));
}

void DenoiseStage::check(nrd::Result result, const char* action) const
{
    if (result == nrd::Result::SUCCESS) return;
    throw engine::Error(std::string("cannot ") + action + ": " + m_integration.GetLastMessage());
}

void DenoiseStage::createImages()
{
    const auto create = [&](const char* name, VkFormat format) {
        return engine::Image(m_device, {name, m_desc.width, m_desc.height, format});
    };
    m_normalRoughness = create("normal and roughness", VK_FORMAT_A2B10G10R10_UNORM_PACK32);
    m_composed = create("composed", VK_FORMAT_R32G32B32A32_SFLOAT);
    if (m_desc.denoiser.family == Family::Reference) m_signal = create("composed noisy", VK_FORMAT_R32G32B32A32_SFLOAT);
    for (Lobe lobe : kLobes)
    {
        const LobeFormat format = m_desc.denoiser.format(lobe);
        if (format == LobeFormat::None) continue;
        m_lobes[static_cast<size_t>(lobe)].emplace(
            m_device, LobeSignalDesc{lobe, format, m_desc.denoiser.family, m_desc.width, m_desc.height,
                                     hitDistanceParametersOf(m_desc.settings),
                                     checkerboardModeOf(m_desc.settings, m_desc.denoiser.family)});
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
    const nrd::DenoiserDesc denoiser = {kIdentifier, m_desc.denoiser.denoiser};
    nrd::InstanceCreationDesc instance;
    instance.denoisers = &denoiser;
    instance.denoisersNum = 1;
    check(m_integration.Create(creation, instance), "create the denoiser");
    applyFamilySettings();
}

void DenoiseStage::applyFamilySettings()
{
    const auto set = [&](const auto& own) { return m_integration.SetDenoiserSettings(kIdentifier, own); };
    check(setDenoiserSettings(m_desc.settings, m_desc.denoiser.family, set), "set the denoiser's settings");
}

engine::Image* DenoiseStage::denoised(Lobe lobe)
{
    std::optional<LobeSignal>& signal = m_lobes[static_cast<size_t>(lobe)];
    return signal ? &signal->values() : nullptr;
}

double DenoiseStage::memoryMiB() const
{
    if (!m_integration.IsCreated()) return 0.0;
    return double(m_integration.GetMemoryStatistics().total) / (1024.0 * 1024.0);
}

void DenoiseStage::record(VkCommandBuffer cmd, FrameImages& images, const DenoiseFrame& frame)
{
    const bool hasLobes = m_lobes[0] || m_lobes[1];
    if (hasLobes)
    {
        packGuides(cmd, images);
        for (auto& lobe : m_lobes)
            if (lobe) lobe->recordPack(cmd, images, frame.view.frameIndex);
        denoise(cmd, images, frame);
        for (auto& lobe : m_lobes)
            if (lobe) lobe->recordUnpack(cmd, images, frame.denoisingRange);
    }
    compose(cmd, images);
    if (m_desc.denoiser.family == Family::Reference) denoise(cmd, images, frame);
    m_previous = frame.view;
}

void DenoiseStage::packGuides(VkCommandBuffer cmd, FrameImages& images)
{
    transition(cmd, images.normalRoughness, engine::kSampled);
    transition(cmd, images.motion, engine::kSampled);
    transition(cmd, m_normalRoughness, engine::kStorage);
    if (!m_packGuidesSet)
        m_packGuidesSet = m_packGuides.createSet({images.normalRoughness, images.motion, m_normalRoughness});
    m_packGuides.dispatch(
        cmd, m_packGuidesSet, bytesOf(glm::uvec2(m_desc.width, m_desc.height)),
        {engine::groupCount(m_desc.width, kGroupSize), engine::groupCount(m_desc.height, kGroupSize), 1});
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
    applySettings(settings, m_desc.denoiser.family, m_desc.assignments);
    return s;
}

std::vector<SlotImage> DenoiseStage::slots(FrameImages& images)
{
    using nrd::ResourceType;
    if (m_desc.denoiser.family == Family::Reference)
        return {{ResourceType::IN_SIGNAL, &m_signal}, {ResourceType::OUT_SIGNAL, &m_composed}};
    std::vector<SlotImage> all = {{ResourceType::IN_MV, &images.motion},
                                  {ResourceType::IN_NORMAL_ROUGHNESS, &m_normalRoughness},
                                  {ResourceType::IN_VIEWZ, &images.viewZ}};
    if (denoised(Lobe::Specular)) all.emplace_back(ResourceType::IN_SPEC_MV, &images.specularMotion);
    for (auto& lobe : m_lobes)
    {
        if (!lobe) continue;
        const std::vector<SlotImage> own = lobe->slots();
        all.insert(all.end(), own.begin(), own.end());
    }
    return all;
}

void DenoiseStage::denoise(VkCommandBuffer cmd, FrameImages& images, const DenoiseFrame& frame)
{
    check(m_integration.NewFrame(), "begin a frame of the denoiser");
    check(m_integration.SetCommonSettings(settingsOf(frame)), "set the frame's settings");
    const std::vector<SlotImage> all = slots(images);
    nrd::NrdUserPool pool;
    for (const auto& [slot, image] : all) pool[slot] = toUserImage(*image);
    check(m_integration.Denoise(cmd, &kIdentifier, 1, pool), "denoise");
    for (const auto& [slot, image] : all)
    {
        const nrd::NrdImageState& state = pool[slot].state;
        image->state = {state.layout, state.access, state.stages};
    }
}

void DenoiseStage::compose(VkCommandBuffer cmd, FrameImages& images)
{
    engine::Image& target = m_desc.denoiser.family == Family::Reference ? m_signal : m_composed;
    engine::Image* diffuse = denoised(Lobe::Diffuse);
    engine::Image* specular = denoised(Lobe::Specular);
    std::vector<engine::Binding> bindings;
    for (engine::Image* in : {diffuse ? diffuse : &images.diffuse, specular ? specular : &images.specular,
                              &images.diffuseFactor, &images.specularFactor, &images.direct})
    {
        transition(cmd, *in, engine::kSampled);
        bindings.emplace_back(*in);
    }
    transition(cmd, target, engine::kStorage);
    bindings.emplace_back(target);
    if (!m_composeSet) m_composeSet = m_compose.createSet(bindings);
    const ComposeConstants constants = {glm::uvec2(m_desc.width, m_desc.height), occlusionWeights(m_desc.denoiser)};
    m_compose.dispatch(
        cmd, m_composeSet, bytesOf(constants),
        {engine::groupCount(m_desc.width, kGroupSize), engine::groupCount(m_desc.height, kGroupSize), 1});
}
} // namespace sample
