#include "bench_run.h"
#include "bench_emission.h"
#include "bench_statistics.h"

#include "engine/commands.h"

#include <chrono>

namespace sample::bench
{
namespace
{
constexpr nrd::Identifier kIdentifier = 0;
constexpr uint32_t kFramesInFlight = 3; // so that the device never waits for the host
constexpr uint32_t kWarmUpFrameCount = 16;
constexpr uint32_t kRecordCount = 1000;

nrd::NrdUserImage toNrd(const engine::Image& image)
{
    const engine::ImageDesc& desc = image.desc();
    return {image.handle(),
            desc.format,
            desc.width,
            desc.height,
            desc.usage,
            0,
            {image.state.layout, image.state.access, image.state.stage}};
}
} // namespace

Run::Run(const RunDesc& desc) : m_desc(desc)
{
    const ReplaySettings settings = settingsOf(desc.workload, desc.denoiser, desc.size, 0);
    nrd::IntegrationCreationDesc creation;
    creation.native.instance = desc.device.instance();
    creation.native.physicalDevice = desc.device.physical();
    creation.native.device = desc.device.handle();
    creation.native.queueFamilyIndex = desc.device.queueFamily();
    creation.native.getInstanceProcAddr = vkGetInstanceProcAddr;
    creation.native.enabledFeatures = &desc.device.enabledFeatures();
    creation.resourceWidth = static_cast<uint16_t>(desc.size.width);
    creation.resourceHeight = static_cast<uint16_t>(desc.size.height);
    creation.framesInFlight = kFramesInFlight;
    creation.isGpuTimingEnabled = true;
    creation.createDefaultPipelines = true; // so that their time is Create()'s
    const nrd::DenoiserDesc denoiser = denoiserDesc(kIdentifier, desc.denoiser.denoiser, desc.workload.resolution);
    nrd::InstanceCreationDesc instance;
    instance.denoisers = &denoiser;
    instance.denoisersNum = 1;
    const auto start = std::chrono::steady_clock::now();
    check(m_integration.Create(creation, instance), "create the denoiser");
    m_createMs = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    const auto set = [&](const auto& own) { return m_integration.SetDenoiserSettings(kIdentifier, own); };
    check(setDenoiserSettings(settings, desc.denoiser.family, set), "set the denoiser's settings");
}

Run::~Run() { vkDeviceWaitIdle(m_desc.device.handle()); }

void Run::check(nrd::Result result, const char* action) const
{
    if (result != nrd::Result::SUCCESS)
        throw engine::Error(std::string("cannot ") + action + ": " + m_integration.GetLastMessage());
}

// The pools' sum, as everywhere in the reports; constants and buffers are not the denoiser's.
MemoryResult Run::memory() const
{
    const nrd::MemoryStatistics statistics = m_integration.GetMemoryStatistics();
    return {static_cast<double>(statistics.permanent), static_cast<double>(statistics.transient)};
}

void Run::createImages()
{
    m_slots = requiredSlots(*m_integration.GetInstance(), kIdentifier, m_desc.denoiser);
    m_inputs.emplace(m_desc.device, m_slots, m_desc.workload, m_desc.size);
    for (const BenchSlot& slot : m_slots)
        if (slot.isOutput)
        {
            const Extent size = divided(m_desc.size, slot.divisor);
            m_outputs.emplace_back(m_desc.device,
                                   engine::ImageDesc{nrd::toString(slot.type), size.width, size.height, slot.format});
        }
}

void Run::beginFrame()
{
    check(m_integration.NewFrame(), "begin a frame");
    const ReplaySettings settings = settingsOf(m_desc.workload, m_desc.denoiser, m_desc.size, m_index);
    check(m_integration.SetCommonSettings(settings.common), "set the common settings");
    size_t output = 0;
    for (const BenchSlot& slot : m_slots)
        m_pool[slot.type] =
            toNrd(slot.isOutput ? m_outputs[output++] : m_inputs->image(slot.type, inputFrameOf(m_index)));
    m_index++;
}

void Run::record(VkCommandBuffer cmd)
{
    check(m_integration.Denoise(cmd, &kIdentifier, 1, m_pool), "denoise");
    size_t output = 0;
    for (const BenchSlot& slot : m_slots)
    {
        const nrd::NrdImageState& state = m_pool[slot.type].state;
        if (slot.isOutput) m_outputs[output++].state = {state.layout, state.access, state.stages};
    }
}

// Of a frame that is done: called after NewFrame().
void Run::collect(Times& times)
{
    const nrd::Timings timings = m_integration.GetTimings();
    if (timings.frame <= std::max<uint64_t>(m_collectedFrame, kWarmUpFrameCount)) return;
    m_collectedFrame = timings.frame;
    times.totals.push_back(timings.totalMilliseconds);
    for (uint32_t i = 0; i < timings.passesNum; i++)
    {
        const std::string name = passName(timings.passes[i].name);
        const auto isNamed = [&](const auto& pass) { return pass.first == name; };
        auto pass = std::find_if(times.passes.begin(), times.passes.end(), isNamed);
        if (pass == times.passes.end()) pass = times.passes.insert(pass, {name, {}});
        if (pass->second.size() < times.totals.size()) pass->second.push_back(0.0);
        pass->second.back() += timings.passes[i].milliseconds;
    }
}

Run::Times Run::denoiseFrames(engine::FrameRing& ring)
{
    Times times;
    // The last ones fill the ring behind the frames that are measured.
    const uint32_t frameCount = kWarmUpFrameCount + m_desc.workload.frameCount + kFramesInFlight;
    for (uint32_t i = 0; i < frameCount; i++)
    {
        VkCommandBuffer cmd = ring.begin();
        beginFrame();
        collect(times);
        record(cmd);
        ring.submit();
    }
    ring.waitAll();
    return times;
}

// Nothing is submitted any more, so that a slow device costs no time and a fast one does not disturb the host.
double Run::timeRecording(engine::FrameRing& ring)
{
    std::vector<double> times;
    for (uint32_t i = 0; i < kRecordCount; i++)
    {
        VkCommandBuffer cmd = ring.begin();
        beginFrame();
        const auto start = std::chrono::steady_clock::now();
        record(cmd);
        times.push_back(std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count());
    }
    return quantile(std::move(times), 0.5);
}

Result Run::measure()
{
    createImages();
    const Emission emission = measureEmission(m_desc.denoiser, m_desc.size, m_desc.workload, m_slots);
    engine::FrameRing ring(m_desc.device, kFramesInFlight);
    const Times times = denoiseFrames(ring);
    Result result{m_desc.denoiser.name, m_desc.size, memory(), {}, {}, m_inputs->skyPercent(m_desc.device)};
    result.cpu = CpuResult{emission.microseconds, timeRecording(ring), m_createMs};
    if (times.totals.empty() || quantile(times.totals, 0.5) == 0.0) return result; // a device without timestamps
    result.gpu = GpuResult{quantile(times.totals, 0.5), quantile(times.totals, 0.1), quantile(times.totals, 0.9), {}};
    for (const PassTraffic& pass : emission.passes)
    {
        const auto isNamed = [&](const auto& timed) { return timed.first == pass.name; };
        const auto timed = std::find_if(times.passes.begin(), times.passes.end(), isNamed);
        if (timed == times.passes.end()) throw engine::Error("the pass " + pass.name + " was never timed");
        result.gpu->passes.push_back({pass.name, quantile(timed->second, 0.5), pass.byteCount});
    }
    return result;
}
} // namespace sample::bench
