#include "plugin.h"
#include "refusal.h"
#include <algorithm>

namespace nrd::plugin
{
namespace
{
constexpr uint32_t kDefaultFramesInFlight = 3;
constexpr uint32_t kDenoiserBits = 0xFF;
constexpr uint32_t kSlotShift = 8;

Refusal invalid(const std::string& text) { return Refusal(Result::INVALID_ARGUMENT, text); }
} // namespace

Denoiser toDenoiser(uint32_t index)
{
    if (index < static_cast<uint32_t>(Denoiser::MAX_NUM)) return static_cast<Denoiser>(index);
    throw invalid(
        sentence("there is no denoiser %u, the last is %u", index, static_cast<uint32_t>(Denoiser::MAX_NUM) - 1));
}

int makeEventId(uint32_t denoiser, uint32_t frameIndex)
{
    if (denoiser >= static_cast<uint32_t>(Denoiser::MAX_NUM)) return -1;
    return static_cast<int>(denoiser | (frameIndex % kRingSize) << kSlotShift);
}

void Plugin::setDevice(const NrdPluginDevice& device, Creator create)
{
    if (!device.getCommandBuffer) throw invalid("getCommandBuffer is null");
    Device result;
    result.native.instance = device.instance;
    result.native.physicalDevice = device.physicalDevice;
    result.native.device = device.device;
    result.native.queueFamilyIndex = device.queueFamilyIndex;
    result.native.getInstanceProcAddr = device.getInstanceProcAddr;
    result.native.isSynchronization2Enabled = device.isSynchronization2Enabled != 0;
    result.native.isDebugUtilsEnabled = device.isDebugUtilsEnabled != 0;
    result.framesInFlight = device.framesInFlight ? device.framesInFlight : kDefaultFramesInFlight;
    result.getCommandBuffer = device.getCommandBuffer;
    result.userArg = device.userArg;
    result.create = std::move(create);
    // Created with nothing to denoise: a device that cannot be used is refused here and not with the first denoiser.
    NrdIntegration probe;
    IntegrationCreationDesc desc;
    desc.native = result.native;
    desc.resourceWidth = desc.resourceHeight = 1;
    desc.framesInFlight = result.framesInFlight;
    const Result isUsable = result.create(probe, desc, {});
    if (isUsable != Result::SUCCESS) throw Refusal(isUsable, probe.GetLastMessage());

    const std::lock_guard lock(m_mutex);
    if (m_device) throw invalid("the device is set already: NrdPluginReleaseAll() must come in between");
    m_checker.emplace();
    m_device = std::move(result);
}

const Device& Plugin::requireDevice() const
{
    if (!m_device) throw invalid("NrdPluginSetDevice() must succeed first");
    return *m_device;
}

void Plugin::initialize(uint32_t denoiser, Images images)
{
    const Denoiser kind = toDenoiser(denoiser);
    std::unique_lock lock(m_mutex);
    const Device device = requireDevice();
    Initialized next = m_denoisers[denoiser];
    const uint64_t generation = ++m_initializeNum;
    lock.unlock();
    next.images = std::make_shared<const SlottedImages>(slotted(kind, images, generation));
    if (!next.session || !next.session->suits(*next.images))
        next.session = std::make_shared<Session>(device, kind, *next.images);
    lock.lock();
    Initialized& present = m_denoisers[denoiser];
    if (present.session && present.session != next.session) retire(present.session);
    present = std::move(next);
}

Plugin::AllSettings Plugin::defaults()
{
    AllSettings result;
    for (uint32_t i = 0; i < kDenoiserNum; i++) result[i] = defaultSettings(static_cast<Denoiser>(i));
    return result;
}

void Plugin::describeSetting(uint32_t denoiser, uint32_t index, NrdPluginSettingInfo& info)
{
    const Denoiser kind = toDenoiser(denoiser);
    if (index >= settingNum(kind))
        throw invalid(sentence("index is %u, %s has %u settings", index, toString(kind), settingNum(kind)));
    const std::lock_guard lock(m_mutex);
    plugin::describeSetting(kind, index, m_settings[denoiser], info);
}

void Plugin::setSetting(uint32_t denoiser, const char* name, double value)
{
    const Denoiser kind = toDenoiser(denoiser);
    const std::lock_guard lock(m_mutex);
    (void)requireDevice();
    DenoiserSettings settings = m_settings[denoiser];
    plugin::setSetting(kind, name, value, settings);
    requireValid(kind, settings);
    m_settings[denoiser] = settings;
}

void Plugin::setFrame(const NrdPluginFrame& frame)
{
    const std::lock_guard lock(m_mutex);
    (void)requireDevice();
    m_checker->require(frame);
    RingSlot& slot = m_ring[frame.frameIndex % kRingSize];
    const bool isRepeated = slot.frame && slot.frame->frameIndex == frame.frameIndex;
    slot.frame = frame;
    slot.denoisers = m_denoisers;
    slot.settings = m_settings;
    if (isRepeated) return;
    m_frameNum++;
    collectRetired();
}

Plugin::Event Plugin::findEvent(uint32_t eventId)
{
    const uint32_t denoiser = eventId & kDenoiserBits;
    const uint32_t slotIndex = eventId >> kSlotShift;
    if (slotIndex >= kRingSize) throw invalid(sentence("event id 0x%X has bits above 9, which must be 0", eventId));
    const char* const name = toString(toDenoiser(denoiser));
    const std::lock_guard lock(m_mutex);
    const Device& device = requireDevice();
    const RingSlot& slot = m_ring[slotIndex];
    if (!slot.frame) throw invalid(sentence("event id 0x%X: no frame was set in ring slot %u", eventId, slotIndex));
    if (!slot.denoisers[denoiser].session)
        throw invalid(sentence("event id 0x%X: %s was not initialised when frame %u was set", eventId, name,
                               slot.frame->frameIndex));
    return {*slot.frame, slot.denoisers[denoiser], slot.settings[denoiser], device.getCommandBuffer, device.userArg};
}

void Plugin::execute(uint32_t eventId)
{
    const Event event = findEvent(eventId);
    const VkCommandBuffer commandBuffer = event.getCommandBuffer(event.userArg);
    if (commandBuffer == VK_NULL_HANDLE) throw invalid("getCommandBuffer returned null");
    event.denoiser.session->execute(commandBuffer, *event.denoiser.images, event.frame, event.settings);
}

void Plugin::release(uint32_t denoiser)
{
    const Denoiser kind = toDenoiser(denoiser);
    const std::lock_guard lock(m_mutex);
    if (!m_denoisers[denoiser].session) throw invalid(sentence("%s is not initialised", toString(kind)));
    retire(m_denoisers[denoiser].session);
    m_denoisers[denoiser] = {};
}

void Plugin::retire(std::shared_ptr<Session> session) { m_retired.push_back({std::move(session), m_frameNum}); }

// Frames that were set may be recorded three frames later, and the GPU be done with them framesInFlight frames later.
void Plugin::collectRetired()
{
    const uint64_t age = kRingSize + m_device->framesInFlight;
    const auto isDone = [&](const Retired& retired) { return m_frameNum > retired.frameNum + age; };
    m_retired.erase(std::remove_if(m_retired.begin(), m_retired.end(), isDone), m_retired.end());
}

void Plugin::releaseAll()
{
    const std::lock_guard lock(m_mutex);
    m_retired.clear();
    for (RingSlot& slot : m_ring) slot = {};
    m_denoisers = {};
    m_settings = defaults();
    m_checker.reset();
    m_device.reset();
    m_frameNum = 0;
}
} // namespace nrd::plugin
