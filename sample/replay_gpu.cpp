#include "replay_gpu.h"
#include "replay_camera.h"
#include "shaders/replay_modes.h"

#include "engine/commands.h"
#include "engine/transfer.h"

#include <algorithm>
#include <cmath>

namespace sample
{
namespace
{
constexpr nrd::Identifier kIdentifier = 0;

bool contains(const std::vector<Signal>& signals, Signal signal)
{
    return std::find(signals.begin(), signals.end(), signal) != signals.end();
}

double median(std::vector<double> values)
{
    if (values.empty()) return 0.0;
    std::sort(values.begin(), values.end());
    const size_t half = values.size() / 2;
    return values.size() % 2 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}
uint32_t unpackMode(ShResolve resolve)
{
    switch (resolve)
    {
    case ShResolve::SphericalGaussians:
        return REPLAY_UNPACK_RESOLVE_SG;
    case ShResolve::Restore:
        return REPLAY_UNPACK_RESTORE;
    case ShResolve::SphericalHarmonics:
        return REPLAY_UNPACK_RESOLVE_SH;
    case ShResolve::None:
        break;
    }
    return REPLAY_UNPACK_EXTRACT;
}

// Colours are in .xyz, with alpha in .xyzw, scalars in .w of four floats per pixel; what the mask leaves out is `sky`.
Picture pictureOf(const std::vector<float>& values, const Mask& surface, const Picture& like, float sky)
{
    Picture picture = like;
    const size_t first = picture.planes.size() == 1 ? 3 : 0;
    for (size_t c = 0; c < picture.planes.size(); c++)
        for (size_t i = 0; i < picture.pixelCount(); i++)
            picture.planes[c][i] = counts(surface, i) ? values[i * 4 + first + c] : sky;
    return picture;
}

Picture overlayOf(const std::vector<float>& values, const engine::ImageDesc& desc)
{
    return pictureOf(values, {}, Picture(static_cast<int>(desc.width), static_cast<int>(desc.height), 4), 0.0f);
}
} // namespace

std::shared_ptr<engine::Device> createReplayDevice(const std::string& device, bool validation)
{
    const nrd::RequiredDeviceFeatures required = nrd::GetRequiredDeviceFeatures();
    engine::DeviceDesc desc;
    desc.device = device;
    desc.validation = validation;
    desc.features = required.features;
    desc.extensions.assign(required.deviceExtensions, required.deviceExtensions + required.deviceExtensionsNum);
    return std::make_shared<engine::Device>(desc);
}

ReplayGpu::ReplayGpu(const ReplayGpuDesc& desc) : m_desc(desc), m_info(desc.capture.info()), m_denoiser(desc.denoiser)
{
    (void)settingsOfFrame(); // wrong settings are told before anything is created
    const nrd::LibraryDesc& library = nrd::GetLibraryDesc();
    const nrd::Denoiser* last = library.supportedDenoisers + library.supportedDenoisersNum;
    if (std::find(library.supportedDenoisers, last, m_denoiser.denoiser) == last)
        throw engine::Error(std::string("this build of the library does not offer the denoiser ") + m_denoiser.name);
    m_device = desc.openDevice ? desc.openDevice : createReplayDevice(desc.device, desc.validation);
    m_packing = ReplayPacking(*m_device);
    createIntegration();
}

ReplayGpu::~ReplayGpu() { m_device->waitIdle(); }

void ReplayGpu::check(nrd::Result result, const char* action) const
{
    if (result != nrd::Result::SUCCESS)
        throw engine::Error(std::string("cannot ") + action + ": " + m_integration.GetLastMessage());
}

void ReplayGpu::createIntegration()
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
    const nrd::DenoiserDesc denoiser = denoiserDesc(kIdentifier, m_denoiser.denoiser, m_desc.resolution);
    nrd::InstanceCreationDesc instance;
    instance.denoisers = &denoiser;
    instance.denoisersNum = 1;
    check(m_integration.Create(creation, instance), "create the denoiser");
}

void ReplayGpu::applyDenoiserSettings(const ReplaySettings& settings)
{
    const auto set = [&](const auto& own) { return m_integration.SetDenoiserSettings(kIdentifier, own); };
    check(setDenoiserSettings(settings, m_denoiser.family, set), "set the denoiser's settings");
}

engine::Image& ReplayGpu::layerImage(Layer layer)
{
    engine::Image& image = m_layers[layer];
    if (image.handle() == VK_NULL_HANDLE)
        image = engine::Image(*m_device, {"layer " + std::to_string(static_cast<int>(layer)),
                                          static_cast<uint32_t>(m_info.width), static_cast<uint32_t>(m_info.height)});
    return image;
}

engine::Image& ReplayGpu::slotImage(nrd::ResourceType type)
{
    for (Slot& slot : m_slots)
        if (slot.row.type == type) return slot.image;
    throw engine::Error(std::string(m_denoiser.name) + " has no " + nrd::toString(type));
}

// Once all settings are set, on which it depends what the denoiser needs.
void ReplayGpu::createSlots()
{
    const nrd::ResourceRequirement* requirements = nullptr;
    uint32_t count = 0;
    if (nrd::GetRequiredResources(*m_integration.GetInstance(), kIdentifier, requirements, count) !=
        nrd::Result::SUCCESS)
        throw engine::Error(std::string("the library does not tell what ") + m_denoiser.name + " needs");
    for (uint32_t i = 0; i < count; i++)
        if (requirements[i].isRequired) createImage(requirements[i]);
    for (Slot& slot : m_slots)
    {
        if (slot.row.isOutput)
            createReadings(slot);
        else
            createPackSet(slot);
    }
}

void ReplayGpu::createImage(const nrd::ResourceRequirement& requirement)
{
    const std::string name = nrd::toString(requirement.type);
    const SlotRow* row = findSlot(requirement.type, m_denoiser.family);
    if (!row) throw engine::Error("nrd-replay cannot serve the slot " + name + " of " + m_denoiser.name);
    for (const std::optional<Layer>& layer : {row->layer, row->direction})
    {
        if (!layer) continue;
        for (Channel channel : neededChannels(*layer))
            if (!m_desc.capture.has(channel))
                throw engine::Error("the capture has no channel " + std::string(channelInfo(channel).name) +
                                    ", which " + m_denoiser.name + " needs for " + name);
    }
    const uint32_t divisor = requirement.sizeDivisor;
    const engine::ImageDesc desc = {name, engine::groupCount(static_cast<uint32_t>(m_info.width), divisor),
                                    engine::groupCount(static_cast<uint32_t>(m_info.height), divisor), row->format};
    m_slots.push_back({*row, engine::Image(*m_device, desc), divisor, VK_NULL_HANDLE, {}});
}

void ReplayGpu::createPackSet(Slot& slot)
{
    const engine::Image& layer = layerImage(slot.row.layer.value_or(Layer::Guides));
    const engine::Image& direction = slot.row.direction ? layerImage(*slot.row.direction) : layer;
    slot.set = m_packing.createSet(
        ReplayPacking::PackImages{layer, direction, layerImage(Layer::Guides), layerImage(Layer::Depth), slot.image});
}

void ReplayGpu::createReadings(Slot& slot)
{
    const SlotRow& row = slot.row;
    if (row.type == nrd::ResourceType::OUT_VALIDATION && m_desc.isOverlayWanted) createReading(slot, row.mode, false);
    if (!row.radiance && !row.scalar) return;
    const bool isResolved = row.sh1 && m_desc.resolve != ShResolve::None;
    createReading(slot, row.sh1 ? unpackMode(m_desc.resolve) : row.mode, false);
    if (isResolved) createReading(slot, REPLAY_UNPACK_EXTRACT, true);
}

void ReplayGpu::createReading(Slot& slot, uint32_t mode, bool isExtracted)
{
    Reading reading;
    reading.values = engine::Image(
        *m_device, {slot.image.desc().name + " unpacked", slot.image.desc().width, slot.image.desc().height});
    reading.mode = mode;
    reading.isExtracted = isExtracted;
    const engine::Image& sh1 = slot.row.sh1 ? slotImage(*slot.row.sh1) : slot.image;
    reading.set = m_packing.createSet(ReplayPacking::UnpackImages{slot.image, sh1, layerImage(Layer::Guides),
                                                                  layerImage(Layer::Depth), reading.values});
    slot.readings.push_back(std::move(reading));
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
    ReplaySettings settings = presetSettings(m_desc.preset);
    settings.common = commonSettingsOf(m_info, m_frameIndex);
    settings.common.isSpecularMotionAvailable = m_desc.capture.has(Channel::SpecularMX);
    settings.reblur.hitDistanceParameters = hitDistanceParametersOf(m_info);
    settings.sigma = sigmaSettingsOf(m_desc.capture.light(m_frameIndex), settings.sigma);
    applySettings(settings, m_denoiser.family, m_desc.settings);
    return settings;
}

void ReplayGpu::uploadLayers(const Planes& frame)
{
    for (auto& [layer, image] : m_layers)
        engine::upload(*m_device, image, std::as_bytes(std::span<const float>(layerValues(frame, layer))));
}

void ReplayGpu::recordPack(VkCommandBuffer cmd, Slot& slot, const ReplaySettings& settings)
{
    engine::transition(cmd, slot.image, engine::kStorage);
    const bool isMix = slot.row.type == nrd::ResourceType::IN_DISOCCLUSION_THRESHOLD_MIX;
    const nrd::HitDistanceParameters& p = settings.reblur.hitDistanceParameters;
    const bool isLobe =
        slot.row.layer == Layer::Diffuse || slot.row.layer == Layer::Specular || slot.row.layer == Layer::Shadow;
    const nrd::CheckerboardMode mode =
        isLobe ? checkerboardModeOf(settings, m_denoiser.family) : nrd::CheckerboardMode::OFF;
    PackConstants constants{{p.A * settings.common.metersToUnits, p.B, p.C, 0.0f},
                            slot.row.mode,
                            slot.row.isDiffuse,
                            {static_cast<uint32_t>(m_info.width), static_cast<uint32_t>(m_info.height)},
                            isMix ? m_desc.disocclusionMix : m_desc.confidence,
                            static_cast<uint32_t>(mode),
                            settings.common.frameIndex};
    constants.stride = slot.divisor;
    setLight(constants, m_desc.capture.info(), m_frameIndex);
    m_packing.pack(cmd, slot.set, constants);
}

void ReplayGpu::recordUnpack(VkCommandBuffer cmd, Slot& slot)
{
    if (slot.readings.empty()) return;
    engine::transition(cmd, slot.image, engine::kSampled);
    if (slot.row.sh1) engine::transition(cmd, slotImage(*slot.row.sh1), engine::kSampled);
    UnpackConstants constants = unpackConstantsOf(m_info, m_frameIndex);
    constants.isDiffuse = slot.row.isDiffuse;
    for (Reading& reading : slot.readings)
    {
        engine::transition(cmd, reading.values, engine::kStorage);
        constants.mode = reading.mode;
        constants.size[0] = reading.values.desc().width;
        constants.size[1] = reading.values.desc().height;
        m_packing.unpack(cmd, reading.set, constants);
    }
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
        if (!slot.row.isOutput) recordPack(cmd, slot, settings);
    recordDenoise(cmd);
    if (!isWanted) return;
    for (Slot& slot : m_slots) recordUnpack(cmd, slot);
}

ReplayedFrame ReplayGpu::denoise(const Planes& frame, bool isWanted)
{
    const ReplaySettings settings = settingsOfFrame();
    check(m_integration.NewFrame(), "begin a frame");
    collectTimes();
    applyDenoiserSettings(settings); // a light may move
    check(m_integration.SetCommonSettings(settings.common), "set the common settings");
    if (m_slots.empty()) createSlots();
    uploadLayers(frame);
    engine::submitAndWait(*m_device, [&](VkCommandBuffer cmd) { record(cmd, settings, isWanted); });
    ReplayedFrame result;
    if (isWanted) result = read(frame, settings.reblur.returnHistoryLengthInsteadOfOcclusion);
    m_frameIndex++;
    return result;
}

ReplayedFrame ReplayGpu::read(const Planes& frame, bool isHistoryLength)
{
    const Mask surface = surfaceMask(frame, m_info.denoisingRange);
    const Picture colour(frame.width, frame.height, 3), scalar(frame.width, frame.height, 1);
    ReplayedFrame result;
    for (Slot& slot : m_slots)
    {
        for (Reading& reading : slot.readings)
        {
            const std::vector<float> values = engine::readBackAs<float>(*m_device, reading.values);
            const SlotRow& row = slot.row;
            Signals& signals = reading.isExtracted ? result.extracted : result.signals;
            if (row.type == nrd::ResourceType::OUT_VALIDATION)
                result.overlay = overlayOf(values, reading.values.desc());
            const auto isWanted = [&](Signal signal) { return contains(m_denoiser.signals, signal); };
            if (row.radiance && isWanted(*row.radiance))
                signals[*row.radiance] = pictureOf(values, surface, colour, 0.0f);
            if (!row.scalar || (row.radiance && isHistoryLength)) continue;
            signals[*row.scalar] = pictureOf(values, surface, scalar, 1.0f);
        }
    }
    return result;
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
