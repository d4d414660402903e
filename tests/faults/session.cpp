#include "session.h"
#include "catch.h"
#include "hooks.h"
#include "validated_device.h"
#include <cstdio>
#include <cstring>
#include <rhi/vulkan.h>

namespace faults
{
namespace
{
nrd::NativeDevice hookedDevice()
{
    const rhi::Device& device = test::validatedDevice();
    const rhi::VulkanHandles handles = rhi::vulkanHandles(device);
    standBefore(handles.getInstanceProcAddr, handles.getDeviceProcAddr);
    nrd::NativeDevice native;
    native.instance = handles.instance;
    native.physicalDevice = handles.physicalDevice;
    native.device = handles.device;
    native.queueFamilyIndex = handles.queueFamilyIndex;
    native.getInstanceProcAddr = hookedInstanceProcAddr;
    native.getDeviceProcAddr = hookedDeviceProcAddr;
    native.isSynchronization2Enabled = device.info().hasSynchronization2;
    native.isDebugUtilsEnabled = device.info().hasDebugLabels;
    return native;
}

const options::Frame& cachedFrame(const options::Setup& setup, const std::vector<nrd::ResourceRequirement>& needs,
                                  int index)
{
    // The host traces them: once for all runs that show the same, and soaks show ever others.
    constexpr size_t kMostFrames = 256;
    using Key = std::tuple<nrd::Denoiser, int, int, float, int>;
    static std::map<Key, options::Frame> frames;
    const Key key = {setup.denoiser, setup.size.x, setup.size.y, setup.speed, index};
    if (const auto it = frames.find(key); it != frames.end()) return it->second;
    if (frames.size() == kMostFrames) frames.clear();
    return frames.emplace(key, options::makeFrame(setup, needs, index)).first->second;
}
} // namespace

bool isSame(const Outputs& a, const Outputs& b)
{
    const auto isEqual = [](const test::Plane& x, const test::Plane& y)
    { return x.size() == y.size() && std::memcmp(x.data(), y.data(), x.size() * sizeof(x[0])) == 0; };
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), isEqual);
}

// Images of a frame in flight: all that the host writes and reads while others are on their way.
struct Session::Slot
{
    std::unique_ptr<rhi::CommandBuffer> commands = test::validatedDevice().createCommandBuffer("frame");
    std::unique_ptr<rhi::Fence> fence = test::validatedDevice().createFence("frame");
    std::map<std::pair<size_t, nrd::ResourceType>, std::unique_ptr<test::Image>> images; // by denoiser
    bool isPending = false;

    test::Image& image(size_t denoiser, nrd::ResourceType type, const options::Frame& frame)
    {
        std::unique_ptr<test::Image>& image = images[{denoiser, type}];
        if (!image) image = std::make_unique<test::Image>(frame.formats.at(type), frame.size.x, frame.size.y);
        return *image;
    }
};

Session::Session(const SessionDesc& desc) : m_desc(desc)
{
    (void)test::validatedDevice();
    for (const nrd::Denoiser denoiser : desc.denoisers)
    {
        options::Setup setup = options::makeSetup(denoiser, desc.size);
        setup.speed = 0.05f;
        m_setups.push_back(setup);
    }
    for (uint32_t i = 0; i < desc.framesInFlight; i++) m_slots.push_back(std::make_unique<Slot>());
    make = [this](const char* name, const Call& call)
    {
        const nrd::Result result = call();
        INFO(name << ": " << integration.GetLastMessage());
        REQUIRE(result == nrd::Result::SUCCESS);
    };
}

Session::~Session() { destroy(); }

void Session::create()
{
    std::vector<nrd::DenoiserDesc> denoisers;
    for (size_t i = 0; i < m_setups.size(); i++) denoisers.push_back({identifier(i), m_setups[i].denoiser});
    nrd::InstanceCreationDesc instanceDesc;
    instanceDesc.messageSink = {keepMessage, this};
    instanceDesc.denoisers = denoisers.data();
    instanceDesc.denoisersNum = static_cast<uint32_t>(denoisers.size());
    nrd::IntegrationCreationDesc desc;
    desc.native = hookedDevice();
    if (m_desc.hasOldBarriers) desc.native.isSynchronization2Enabled = false;
    desc.resourceWidth = static_cast<uint16_t>(m_setups[0].size.x);
    desc.resourceHeight = static_cast<uint16_t>(m_setups[0].size.y);
    desc.framesInFlight = m_desc.framesInFlight;
    desc.maxDenoiseCallsPerFrame = m_setups.size() > 1 ? 2 : 1; // the least: each denoiser is called once
    desc.isGpuTimingEnabled = m_desc.isGpuTimingEnabled;
    desc.isPassTracingEnabled = m_desc.isPassTracingEnabled;
    desc.createDefaultPipelines = m_desc.createDefaultPipelines;
    make("Create", [&] { return integration.Create(desc, instanceDesc); });
}

void Session::destroy()
{
    for (const std::unique_ptr<Slot>& slot : m_slots) collect(*slot);
    const auto destroyIt = [this]
    {
        integration.Destroy();
        return nrd::Result::SUCCESS;
    };
    make("Destroy", destroyIt);
}

void Session::keepMessage(void* self, nrd::Result, const char* text)
{
    std::snprintf(static_cast<Session*>(self)->m_message, sizeof(m_message), "%s", text);
}

void Session::resize(glm::ivec2 size)
{
    (void)finish(); // the images are about to go
    const auto width = static_cast<uint16_t>(size.x), height = static_cast<uint16_t>(size.y);
    make("Resize", [&] { return integration.Resize(width, height); });
    for (options::Setup& setup : m_setups) setup.size = setup.rect = size;
    for (const std::unique_ptr<Slot>& slot : m_slots)
    {
        for (const auto& [key, image] : slot->images)
        {
            const VkImage handle = rhi::vulkanImage(image->texture());
            make("Forget", [&] { return integration.Forget(handle); });
        }
        slot->images.clear();
    }
}

void Session::frame(int index, bool restarts)
{
    Slot& slot = *m_slots[m_next];
    m_next = (m_next + 1) % m_slots.size();
    collect(slot);
    make("NewFrame", [&] { return integration.NewFrame(); });
    const bool isCut = m_lastIndex + 1 != index;
    nrd::CommonSettings common = options::makeCommon(m_setups[0], index, isCut);
    if (restarts || isCut) common.accumulationMode = nrd::AccumulationMode::CLEAR_AND_RESTART;
    if (!isCut && index > 0)
        for (uint16_t* size : {common.resourceSizePrev, common.rectSizePrev})
            for (int axis = 0; axis < 2; axis++) size[axis] = static_cast<uint16_t>(m_lastSize[axis]);
    m_lastIndex = index;
    m_lastSize = m_setups[0].size;
    make("SetCommonSettings", [&] { return integration.SetCommonSettings(common); });
    if (changeSettings) changeSettings();
    slot.commands->begin();
    for (size_t i = 0; i < m_setups.size(); i++)
    {
        const nrd::ResourceRequirement* needs = nullptr;
        uint32_t count = 0;
        REQUIRE(nrd::GetRequiredResources(*integration.GetInstance(), identifier(i), needs, count) ==
                nrd::Result::SUCCESS);
        record(slot, i, cachedFrame(m_setups[i], {needs, needs + count}, index));
    }
    slot.commands->end();
    rhi::CommandBuffer* const list[] = {slot.commands.get()};
    test::validatedDevice().submit(list, slot.fence.get());
    slot.isPending = true;
}

void Session::record(Slot& slot, size_t denoiser, const options::Frame& frame)
{
    nrd::NrdUserPool pool;
    for (const auto& [type, format] : frame.formats)
    {
        test::Image& image = slot.image(denoiser, type, frame);
        const bool isWritten = options::isOutput(type);
        if (isWritten)
            image.fill(glm::vec4(0.5f));
        else
            image.fill(frame.inputs.at(type));
        image.upload(*slot.commands);
        image.transition(*slot.commands, isWritten ? rhi::states::kStorageWrite : rhi::states::kSampled);
        nrd::NrdUserImage& entry = pool[type];
        entry.image = rhi::vulkanImage(image.texture());
        entry.format = rhi::toVulkan(format);
        entry.width = static_cast<uint32_t>(frame.size.x);
        entry.height = static_cast<uint32_t>(frame.size.y);
        entry.generation = generation;
        entry.state = {isWritten ? VK_IMAGE_LAYOUT_GENERAL : VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                       VkAccessFlags(isWritten ? VK_ACCESS_SHADER_WRITE_BIT : VK_ACCESS_SHADER_READ_BIT),
                       VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT};
    }
    const VkCommandBuffer commands = rhi::vulkanCommandBuffer(*slot.commands);
    if (m_desc.isDiagnosed && denoiser == 0)
        make("RecordDiagnosis", [&] { return integration.RecordDiagnosis(commands, pool); });
    if (m_desc.dumpFolder && !integration.IsDumping())
        make("DumpInputs", [&] { return integration.DumpInputs(m_desc.dumpFolder, 1); });
    const nrd::Identifier chosen = identifier(denoiser);
    nrd::DenoiseOptions denoiseOptions;
    denoiseOptions.restoreInitialStates = true;
    make("Denoise", [&] { return integration.Denoise(commands, &chosen, 1, pool, denoiseOptions); });
    for (const auto& [type, format] : frame.formats)
        if (options::isOutput(type)) slot.image(denoiser, type, frame).download(*slot.commands);
}

void Session::diagnose()
{
    const nrd::Finding* findings = nullptr;
    uint32_t findingNum = 0;
    make("Diagnose", [&] { return integration.Diagnose(findings, findingNum, true); });
    make("EndDiagnosis", [&] { return integration.EndDiagnosis(); });
}

void Session::collect(Slot& slot)
{
    if (!slot.isPending) return;
    slot.fence->wait();
    slot.fence->reset();
    slot.isPending = false;
    Outputs outputs;
    for (const auto& [key, image] : slot.images)
        if (options::isOutput(key.second)) outputs.push_back(image->read());
    m_done.push_back(std::move(outputs));
}

std::vector<Outputs> Session::finish()
{
    for (size_t i = 0; i < m_slots.size(); i++) collect(*m_slots[(m_next + i) % m_slots.size()]);
    return std::exchange(m_done, {});
}
} // namespace faults
