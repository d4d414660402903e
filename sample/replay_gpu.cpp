#include "replay_gpu.h"
#include "replay_camera.h"
#include "replay_shaders.h"

#include "engine/commands.h"
#include "engine/transfer.h"

#include <algorithm>
#include <cmath>

namespace sample
{
namespace
{
constexpr nrd::Identifier kIdentifier = 0;
constexpr uint32_t kGroupSize = 8;

// Push constants of replay_pack.comp.glsl and replay_unpack.comp.glsl.
struct PackConstants
{
    float hitDistanceParameters[4];
    uint32_t mode;
    uint32_t isDiffuse;
    uint32_t size[2];
};
struct UnpackConstants
{
    uint32_t size[2];
    uint32_t mode;
};

engine::ComputePipeline makePipeline(const engine::Device& device, replay::Shader shader, size_t sampledCount,
                                     uint32_t constantsByteSize)
{
    const replay::ShaderBlob blob = replay::shaderBlob(shader);
    engine::ComputeDesc desc;
    desc.name = blob.name;
    desc.words = blob.words;
    desc.byteSize = blob.byteSize;
    desc.pushConstantByteSize = constantsByteSize;
    desc.setCount = nrd::NrdUserPool::kSlotsNum;
    desc.bindings.assign(sampledCount, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE);
    desc.bindings.push_back(VK_DESCRIPTOR_TYPE_STORAGE_IMAGE);
    return {device, desc};
}

template <class T> std::span<const std::byte> bytesOf(const T& value) { return std::as_bytes(std::span(&value, 1)); }

double median(std::vector<double> values)
{
    if (values.empty()) return 0.0;
    std::sort(values.begin(), values.end());
    const size_t half = values.size() / 2;
    return values.size() % 2 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}
} // namespace

ReplayGpu::ReplayGpu(const ReplayGpuDesc& desc)
    : m_info(desc.capture.info()), m_denoiser(desc.denoiser), m_assignments(desc.settings)
{
    (void)settingsOfFrame(); // wrong settings are told before anything is created
    const nrd::LibraryDesc& library = nrd::GetLibraryDesc();
    const nrd::Denoiser* last = library.supportedDenoisers + library.supportedDenoisersNum;
    if (std::find(library.supportedDenoisers, last, m_denoiser.denoiser) == last)
        throw engine::Error(std::string("this build of the library does not offer the denoiser ") + m_denoiser.name);
    const nrd::RequiredDeviceFeatures required = nrd::GetRequiredDeviceFeatures();
    engine::DeviceDesc deviceDesc;
    deviceDesc.device = desc.device;
    deviceDesc.validation = desc.validation;
    deviceDesc.features = required.features;
    deviceDesc.extensions.assign(required.deviceExtensions, required.deviceExtensions + required.deviceExtensionsNum);
    m_device = std::make_unique<engine::Device>(deviceDesc);
    createPipelines();
    createIntegration(desc);
    createSlots(desc);
}

ReplayGpu::~ReplayGpu() { m_device->waitIdle(); }

void ReplayGpu::check(nrd::Result result, const char* action) const
{
    if (result != nrd::Result::SUCCESS)
        throw engine::Error(std::string("cannot ") + action + ": " + m_integration.GetLastMessage());
}

void ReplayGpu::createPipelines()
{
    m_pack = makePipeline(*m_device, replay::Shader::ReplayPack, 3, sizeof(PackConstants));
    m_unpack = makePipeline(*m_device, replay::Shader::ReplayUnpack, 1, sizeof(UnpackConstants));
}

void ReplayGpu::createIntegration(const ReplayGpuDesc& desc)
{
    nrd::IntegrationCreationDesc creation;
    creation.native.instance = m_device->instance();
    creation.native.physicalDevice = m_device->physical();
    creation.native.device = m_device->handle();
    creation.native.queueFamilyIndex = m_device->queueFamily();
    creation.native.getInstanceProcAddr = vkGetInstanceProcAddr;
    creation.native.enabledFeatures = &m_device->enabledFeatures();
    creation.resourceWidth = static_cast<uint16_t>(m_info.width);
    creation.resourceHeight = static_cast<uint16_t>(m_info.height);
    creation.framesInFlight = 1; // every frame is waited for
    creation.isGpuTimingEnabled = true;
    const nrd::DenoiserDesc denoiser{kIdentifier, desc.denoiser.denoiser};
    nrd::InstanceCreationDesc instance;
    instance.denoisers = &denoiser;
    instance.denoisersNum = 1;
    check(m_integration.Create(creation, instance), "create the denoiser");
    // What the denoiser asks of the pool may depend on its settings.
    const ReplaySettings settings = settingsOfFrame();
    if (m_denoiser.family == Family::Reblur)
        check(m_integration.SetDenoiserSettings(kIdentifier, settings.reblur), "set the denoiser's settings");
    if (m_denoiser.family == Family::Reference)
        check(m_integration.SetDenoiserSettings(kIdentifier, settings.reference), "set the denoiser's settings");
}

engine::Image& ReplayGpu::layerImage(Layer layer)
{
    engine::Image& image = m_layers[layer];
    if (image.handle() == VK_NULL_HANDLE)
        image = engine::Image(*m_device, {"layer " + std::to_string(static_cast<int>(layer)),
                                          static_cast<uint32_t>(m_info.width), static_cast<uint32_t>(m_info.height)});
    return image;
}

void ReplayGpu::createSlots(const ReplayGpuDesc& desc)
{
    const nrd::ResourceRequirement* requirements = nullptr;
    uint32_t count = 0;
    if (nrd::GetRequiredResources(*m_integration.GetInstance(), kIdentifier, requirements, count) !=
        nrd::Result::SUCCESS)
        throw engine::Error(std::string("the library does not tell what ") + m_denoiser.name + " needs");
    const uint32_t width = static_cast<uint32_t>(m_info.width);
    const uint32_t height = static_cast<uint32_t>(m_info.height);
    for (uint32_t i = 0; i < count; i++)
    {
        if (!requirements[i].isRequired) continue;
        const std::string name = nrd::toString(requirements[i].type);
        const SlotRow* row = findSlot(requirements[i].type, m_denoiser.family);
        if (!row) throw engine::Error("nrd-replay cannot serve the slot " + name + " of " + m_denoiser.name);
        if (!row->isOutput)
            for (Channel channel : neededChannels(row->layer))
                if (!desc.capture.has(channel))
                    throw engine::Error("the capture has no channel " + std::string(channelInfo(channel).name) +
                                        ", which " + m_denoiser.name + " needs for " + name);
        Slot slot{*row, engine::Image(*m_device, {name, width, height, row->format}), {}, VK_NULL_HANDLE};
        if (row->isOutput)
        {
            slot.values = engine::Image(*m_device, {name + " unpacked", width, height});
            slot.set = m_unpack.createSet({slot.image, slot.values});
        }
        else
            slot.set = m_pack.createSet(
                {layerImage(row->layer), layerImage(Layer::Guides), layerImage(Layer::Depth), slot.image});
        m_slots.push_back(std::move(slot));
    }
}

nrd::NrdUserImage ReplayGpu::userImage(const engine::Image& image)
{
    const engine::ImageDesc& desc = image.desc();
    const engine::ImageState& state = image.state;
    return {
        image.handle(), desc.format, desc.width, desc.height, desc.usage, 0, {state.layout, state.access, state.stage}};
}

void ReplayGpu::setState(engine::Image& image, const nrd::NrdUserImage& user)
{
    image.state = {user.state.layout, user.state.access, user.state.stages};
}

ReplaySettings ReplayGpu::settingsOfFrame() const
{
    ReplaySettings settings;
    settings.common = commonSettingsOf(m_info, m_frameIndex);
    settings.reblur.hitDistanceParameters = hitDistanceParametersOf(m_info);
    applySettings(settings, m_denoiser.family, m_assignments);
    return settings;
}

void ReplayGpu::uploadLayers(const Planes& frame)
{
    for (auto& [layer, image] : m_layers)
        engine::upload(*m_device, image, std::as_bytes(std::span<const float>(layerValues(frame, layer))));
}

void ReplayGpu::recordPack(VkCommandBuffer cmd, Slot& slot, const nrd::HitDistanceParameters& parameters)
{
    engine::transition(cmd, slot.image, engine::kStorage);
    const PackConstants constants{{parameters.A, parameters.B, parameters.C, 0.0f},
                                  slot.row.mode,
                                  slot.row.layer == Layer::Diffuse,
                                  {static_cast<uint32_t>(m_info.width), static_cast<uint32_t>(m_info.height)}};
    m_pack.dispatch(
        cmd, slot.set, bytesOf(constants),
        {engine::groupCount(constants.size[0], kGroupSize), engine::groupCount(constants.size[1], kGroupSize), 1});
}

void ReplayGpu::recordUnpack(VkCommandBuffer cmd, Slot& slot)
{
    engine::transition(cmd, slot.image, engine::kSampled);
    engine::transition(cmd, slot.values, engine::kStorage);
    const UnpackConstants constants{{static_cast<uint32_t>(m_info.width), static_cast<uint32_t>(m_info.height)},
                                    slot.row.mode};
    m_unpack.dispatch(
        cmd, slot.set, bytesOf(constants),
        {engine::groupCount(constants.size[0], kGroupSize), engine::groupCount(constants.size[1], kGroupSize), 1});
}

void ReplayGpu::recordDenoise(VkCommandBuffer cmd)
{
    for (Slot& slot : m_slots) m_pool[slot.row.type] = userImage(slot.image);
    check(m_integration.Denoise(cmd, &kIdentifier, 1, m_pool), "denoise");
    for (Slot& slot : m_slots) setState(slot.image, m_pool[slot.row.type]);
}

void ReplayGpu::record(VkCommandBuffer cmd, const ReplaySettings& settings, bool isWanted)
{
    for (Slot& slot : m_slots)
        if (!slot.row.isOutput) recordPack(cmd, slot, settings.reblur.hitDistanceParameters);
    recordDenoise(cmd);
    if (!isWanted) return;
    for (Slot& slot : m_slots)
        if (slot.row.isOutput) recordUnpack(cmd, slot);
}

Signals ReplayGpu::denoise(const Planes& frame, bool isWanted)
{
    const ReplaySettings settings = settingsOfFrame();
    uploadLayers(frame);
    check(m_integration.NewFrame(), "begin a frame");
    collectTimes();
    check(m_integration.SetCommonSettings(settings.common), "set the common settings");
    engine::submitAndWait(*m_device, [&](VkCommandBuffer cmd) { record(cmd, settings, isWanted); });
    m_frameIndex++;
    return isWanted ? readSignals(frame) : Signals();
}

Signals ReplayGpu::readSignals(const Planes& frame)
{
    const Mask surface = surfaceMask(frame, m_info.denoisingRange);
    Signals signals;
    for (Slot& slot : m_slots)
    {
        if (!slot.row.isOutput || (!slot.row.radiance && !slot.row.scalar)) continue;
        const std::vector<float> values = engine::readBackAs<float>(*m_device, slot.values);
        Picture radiance(frame.width, frame.height, slot.row.radiance ? 3 : 0);
        Picture scalar(frame.width, frame.height, slot.row.scalar ? 1 : 0);
        const size_t scalarComponent = slot.row.radiance ? 3 : 0;
        for (size_t i = 0; i < surface.size(); i++)
        {
            for (size_t c = 0; c < radiance.planes.size(); c++)
                radiance.planes[c][i] = surface[i] ? values[i * 4 + c] : 0.0f;
            if (scalar.exists()) scalar.planes[0][i] = surface[i] ? values[i * 4 + scalarComponent] : 1.0f;
        }
        if (slot.row.radiance) signals[*slot.row.radiance] = std::move(radiance);
        if (slot.row.scalar) signals[*slot.row.scalar] = std::move(scalar);
    }
    return signals;
}

// Times of the frame before, which is done: called after NewFrame().
void ReplayGpu::collectTimes()
{
    const nrd::Timings timings = m_integration.GetTimings();
    if (timings.frame == 0 || timings.frame != m_times.size() + 1) return;
    FrameTimes times;
    times.total = timings.totalMilliseconds;
    for (uint32_t i = 0; i < timings.passesNum; i++)
    {
        std::string name = timings.passes[i].name;
        const size_t dash = name.find(" - ");
        if (dash != std::string::npos) name = name.substr(dash + 3);
        auto found = std::find_if(times.passes.begin(), times.passes.end(),
                                  [&](const PassReport& pass) { return pass.name == name; });
        if (found == times.passes.end()) found = times.passes.insert(found, {name, 0.0});
        found->ms += timings.passes[i].milliseconds;
    }
    m_times.push_back(std::move(times));
}

void ReplayGpu::reportTimes(ReplayReport& report, size_t firstFrame)
{
    check(m_integration.NewFrame(), "begin a frame");
    collectTimes();
    std::vector<double> totals;
    std::vector<std::pair<std::string, std::vector<double>>> passes; // in the order of their first frame
    for (size_t i = std::min(firstFrame, m_times.empty() ? 0 : m_times.size() - 1); i < m_times.size(); i++)
    {
        totals.push_back(m_times[i].total);
        for (const PassReport& pass : m_times[i].passes)
        {
            auto found =
                std::find_if(passes.begin(), passes.end(), [&](const auto& row) { return row.first == pass.name; });
            if (found == passes.end()) found = passes.insert(found, {pass.name, {}});
            found->second.push_back(pass.ms);
        }
    }
    if (totals.empty() || median(totals) == 0.0) return; // a device without timestamps
    report.gpuMs = median(totals);
    for (const auto& [name, times] : passes) report.passes.push_back({name, median(times)});
}

ReplayReport::Memory ReplayGpu::memory() const
{
    constexpr double kMiB = 1024.0 * 1024.0;
    const nrd::MemoryStatistics statistics = m_integration.GetMemoryStatistics();
    // The pools' sum, as everywhere in the reports; constants and buffers are not the denoiser's.
    const double permanent = static_cast<double>(statistics.permanent) / kMiB;
    const double transient = static_cast<double>(statistics.transient) / kMiB;
    return {permanent, transient, permanent + transient};
}

std::string ReplayGpu::deviceName() const { return m_device->properties().deviceName; }
} // namespace sample
