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

struct PackConstants
{
    glm::vec4 hitDistanceParameters;
    glm::uvec2 size;
};

struct ComposeConstants
{
    glm::uvec2 size;
    float denoisingRange;
};

engine::ComputePipeline createPipeline(const engine::Device& device, Shader shader, const DenoiseDesc& desc,
                                       uint32_t sampledCount, uint32_t constantsByteSize)
{
    const ShaderBlob blob = shaderBlob(shader);
    engine::ComputeDesc pipeline;
    pipeline.name = blob.name;
    pipeline.words = blob.words;
    pipeline.byteSize = blob.byteSize;
    pipeline.bindings.assign(sampledCount, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE);
    pipeline.bindings.resize(sampledCount + 3, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE);
    pipeline.pushConstantByteSize = constantsByteSize;
    pipeline.setCount = desc.framesInFlight;
    return engine::ComputePipeline(device, pipeline);
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

nrd::CommonSettings toSettings(const DenoiseDesc& desc, const DenoiseFrame& frame, const View& previous)
{
    nrd::CommonSettings s;
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
        const auto size = static_cast<uint16_t>(i == 0 ? desc.width : desc.height);
        s.resourceSize[i] = s.resourceSizePrev[i] = s.rectSize[i] = s.rectSizePrev[i] = size;
    }
    s.timeDeltaBetweenFrames = frame.deltaTimeMs;
    s.denoisingRange = frame.denoisingRange;
    s.frameIndex = frame.view.frameIndex;
    s.accumulationMode = frame.isCut ? nrd::AccumulationMode::CLEAR_AND_RESTART : nrd::AccumulationMode::CONTINUE;
    return s;
}

template <class T> std::span<const std::byte> bytesOf(const T& value) { return std::as_bytes(std::span(&value, 1)); }
} // namespace

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
    createImages();
    const bool isPacked = desc.denoiser == DenoiserChoice::ReblurDiffuseSpecular;
    m_pack = createPipeline(device, Shader::Pack, desc, 5, sizeof(PackConstants));
    m_compose = createPipeline(device, isPacked ? Shader::ComposeDenoised : Shader::ComposeNoisy, desc, 6,
                               sizeof(ComposeConstants));
    m_packSets.resize(desc.framesInFlight);
    m_composeSets.resize(desc.framesInFlight);
    if (desc.denoiser != DenoiserChoice::None) createIntegration();
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
    m_noisyDiffuse = create("noisy diffuse", VK_FORMAT_R16G16B16A16_SFLOAT);
    m_noisySpecular = create("noisy specular", VK_FORMAT_R16G16B16A16_SFLOAT);
    m_denoisedDiffuse = create("denoised diffuse", VK_FORMAT_R16G16B16A16_SFLOAT);
    m_denoisedSpecular = create("denoised specular", VK_FORMAT_R16G16B16A16_SFLOAT);
    m_composed = create("composed", VK_FORMAT_R32G32B32A32_SFLOAT);
    m_diffuse = create("unpacked diffuse", VK_FORMAT_R32G32B32A32_SFLOAT);
    m_specular = create("unpacked specular", VK_FORMAT_R32G32B32A32_SFLOAT);
    if (m_desc.denoiser == DenoiserChoice::Reference)
        m_signal = create("composed noisy", VK_FORMAT_R32G32B32A32_SFLOAT);
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
    const bool isReblur = m_desc.denoiser == DenoiserChoice::ReblurDiffuseSpecular;
    const nrd::DenoiserDesc denoiser = {kIdentifier,
                                        isReblur ? nrd::Denoiser::REBLUR_DIFFUSE_SPECULAR : nrd::Denoiser::REFERENCE};
    nrd::InstanceCreationDesc instance;
    instance.denoisers = &denoiser;
    instance.denoisersNum = 1;
    check(m_integration.Create(creation, instance), "create the denoiser");
    if (!isReblur) return;
    nrd::ReblurSettings settings;
    settings.hitDistanceParameters = {m_desc.hitDistanceParameters.x, m_desc.hitDistanceParameters.y,
                                      m_desc.hitDistanceParameters.z};
    check(m_integration.SetDenoiserSettings(kIdentifier, settings), "set the denoiser's settings");
}

double DenoiseStage::memoryMiB() const
{
    if (!m_integration.IsCreated()) return 0.0;
    return double(m_integration.GetMemoryStatistics().total) / (1024.0 * 1024.0);
}

void DenoiseStage::record(VkCommandBuffer cmd, FrameImages& images, const DenoiseFrame& frame)
{
    m_slot = (m_slot + 1) % m_desc.framesInFlight;
    if (m_desc.denoiser == DenoiserChoice::ReblurDiffuseSpecular)
    {
        pack(cmd, images);
        denoise(cmd, images, frame);
        compose(cmd, images, frame.denoisingRange);
    }
    else
    {
        compose(cmd, images, frame.denoisingRange);
        if (m_desc.denoiser == DenoiserChoice::Reference) denoise(cmd, images, frame);
    }
    m_previous = frame.view;
}

void DenoiseStage::pack(VkCommandBuffer cmd, FrameImages& images)
{
    std::vector<engine::Binding> bindings;
    for (engine::Image* in :
         {&images.viewZ, &images.normalRoughness, &images.motion, &images.diffuse, &images.specular})
    {
        transition(cmd, *in, engine::kSampled);
        bindings.emplace_back(*in);
    }
    for (engine::Image* out : {&m_normalRoughness, &m_noisyDiffuse, &m_noisySpecular})
    {
        transition(cmd, *out, engine::kStorage);
        bindings.emplace_back(*out);
    }
    VkDescriptorSet& set = m_packSets[m_slot];
    if (!set) set = m_pack.createSet(bindings); // the images are always the same
    const PackConstants constants = {glm::vec4(m_desc.hitDistanceParameters, 0.0f),
                                     glm::uvec2(m_desc.width, m_desc.height)};
    m_pack.dispatch(cmd, set, bytesOf(constants),
                    {engine::groupCount(m_desc.width, kGroupSize), engine::groupCount(m_desc.height, kGroupSize), 1});
}

void DenoiseStage::denoise(VkCommandBuffer cmd, FrameImages& images, const DenoiseFrame& frame)
{
    using nrd::ResourceType;
    const bool isReblur = m_desc.denoiser == DenoiserChoice::ReblurDiffuseSpecular;
    std::vector<std::pair<ResourceType, engine::Image*>> slots;
    if (isReblur)
        slots = {{ResourceType::IN_MV, &images.motion},
                 {ResourceType::IN_NORMAL_ROUGHNESS, &m_normalRoughness},
                 {ResourceType::IN_VIEWZ, &images.viewZ},
                 {ResourceType::IN_DIFF_RADIANCE_HITDIST, &m_noisyDiffuse},
                 {ResourceType::IN_SPEC_RADIANCE_HITDIST, &m_noisySpecular},
                 {ResourceType::OUT_DIFF_RADIANCE_HITDIST, &m_denoisedDiffuse},
                 {ResourceType::OUT_SPEC_RADIANCE_HITDIST, &m_denoisedSpecular}};
    else
        slots = {{ResourceType::IN_SIGNAL, &m_signal}, {ResourceType::OUT_SIGNAL, &m_composed}};

    const bool isCut = frame.isCut || !m_previous;
    DenoiseFrame checked = frame;
    checked.isCut = isCut;
    check(m_integration.NewFrame(), "begin a frame of the denoiser");
    check(m_integration.SetCommonSettings(toSettings(m_desc, checked, isCut ? frame.view : *m_previous)),
          "set the frame's settings");
    nrd::NrdUserPool pool;
    for (const auto& [slot, image] : slots) pool[slot] = toUserImage(*image);
    check(m_integration.Denoise(cmd, &kIdentifier, 1, pool), "denoise");
    for (const auto& [slot, image] : slots)
    {
        const nrd::NrdImageState& state = pool[slot].state;
        image->state = {state.layout, state.access, state.stages};
    }
}

void DenoiseStage::compose(VkCommandBuffer cmd, FrameImages& images, float denoisingRange)
{
    const bool isReblur = m_desc.denoiser == DenoiserChoice::ReblurDiffuseSpecular;
    engine::Image& target = m_desc.denoiser == DenoiserChoice::Reference ? m_signal : m_composed;
    std::vector<engine::Binding> bindings;
    for (engine::Image* in :
         {isReblur ? &m_denoisedDiffuse : &images.diffuse, isReblur ? &m_denoisedSpecular : &images.specular,
          &images.diffuseFactor, &images.specularFactor, &images.direct, &images.viewZ})
    {
        transition(cmd, *in, engine::kSampled);
        bindings.emplace_back(*in);
    }
    for (engine::Image* out : {&target, &m_diffuse, &m_specular})
    {
        transition(cmd, *out, engine::kStorage);
        bindings.emplace_back(*out);
    }
    VkDescriptorSet& set = m_composeSets[m_slot];
    if (!set) set = m_compose.createSet(bindings);
    const ComposeConstants constants = {glm::uvec2(m_desc.width, m_desc.height), denoisingRange};
    m_compose.dispatch(
        cmd, set, bytesOf(constants),
        {engine::groupCount(m_desc.width, kGroupSize), engine::groupCount(m_desc.height, kGroupSize), 1});
}
} // namespace sample
