#include "core.h"
#include "convert.h"
#include "user_pool.h"
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <rhi/vulkan.h>

namespace nrd
{
namespace
{
constexpr uint32_t kMaxFramesInFlight = 16;
constexpr uint32_t kMaxDenoiseCalls = 1024;
// Frames that an image may stay unused before its views go: enough for applications that rotate their images.
constexpr uint64_t kIdleFrames = 8;
constexpr size_t kWrappedCommandBuffers = 16;

const IntegrationCreationDesc& checked(const IntegrationCreationDesc& desc)
{
    checkResourceSize(desc.resourceWidth, desc.resourceHeight);
    if (desc.framesInFlight == 0 || desc.framesInFlight > kMaxFramesInFlight)
        throw Refusal(Result::INVALID_ARGUMENT,
                      sentence("framesInFlight is %u, must be in [1; %u]", desc.framesInFlight, kMaxFramesInFlight));
    if (desc.maxDenoiseCallsPerFrame == 0 || desc.maxDenoiseCallsPerFrame > kMaxDenoiseCalls)
        throw Refusal(Result::INVALID_ARGUMENT, sentence("maxDenoiseCallsPerFrame is %u, must be in [1; %u]",
                                                         desc.maxDenoiseCallsPerFrame, kMaxDenoiseCalls));
    if (desc.layoutPolicy >= LayoutPolicy::MAX_NUM)
        throw Refusal(Result::INVALID_ARGUMENT,
                      sentence("layoutPolicy is %u, which is no LayoutPolicy", unsigned(desc.layoutPolicy)));
    return desc;
}

uint32_t maxResourceCount(const InstanceDesc& instance)
{
    uint32_t result = 0;
    for (uint32_t i = 0; i < instance.pipelinesNum; i++)
    {
        const PipelineDesc& pipeline = instance.pipelines[i];
        result = std::max(result, pipeline.texturesNum + pipeline.storageTexturesNum + pipeline.storageBuffersNum);
    }
    return result;
}

// A camera at the origin, so that the library emits what default settings need.
CommonSettings typicalSettings(uint32_t width, uint32_t height)
{
    CommonSettings result;
    for (float* matrix : {result.worldToViewMatrix, result.worldToViewMatrixPrev})
        for (int i = 0; i < 4; i++) matrix[i * 5] = 1.0f;
    for (float* matrix : {result.viewToClipMatrix, result.viewToClipMatrixPrev})
    {
        matrix[0] = matrix[5] = matrix[11] = 1.0f; // x, y slopes of 45 degrees, w = z
        matrix[14] = 0.1f;                         // reversed infinite depth
    }
    const uint16_t size[2] = {static_cast<uint16_t>(width), static_cast<uint16_t>(height)};
    for (uint16_t* field : {result.resourceSize, result.resourceSizePrev, result.rectSize, result.rectSizePrev})
        std::copy_n(size, 2, field);
    return result;
}
} // namespace

void Core::CreationMessage::report(void* userArg, Result, const char* text)
{
    CreationMessage& self = *static_cast<CreationMessage*>(userArg);
    std::snprintf(self.text, sizeof(self.text), "%s", text);
}

Core::Core(rhi::Device& device, const IntegrationCreationDesc& desc, const InstanceCreationDesc& instanceDesc)
    : m_device(device), m_name(desc.name ? desc.name : "NRD"), m_desc(checked(desc)),
      m_instanceDesc(forDevice(instanceDesc, device)), m_denoisers(denoisersOf(instanceDesc)),
      m_instance(createInstance(m_instanceDesc, m_creationMessage)),
      m_memory(device, desc.deviceMemory),
      m_pipelines(device, m_name.c_str(), description().pipelinesNum, {desc.findShader, desc.findShaderArg}),
      m_views(device), m_transferPipelines(device, m_name.c_str())
{
    m_desc.name = m_name.c_str();
    m_desc.native = {};
    m_instanceDesc.denoisers = nullptr; // the caller's; m_denoisers has the copy
    const PoolsDesc pools = {m_name.c_str(), desc.resourceWidth, desc.resourceHeight, desc.transientMemory, &m_memory};
    m_pools = std::make_unique<Pools>(m_device, pools, description());
    createFrameResources();
    if (desc.createDefaultPipelines) createDefaultPipelines();
}

InstanceCreationDesc Core::forDevice(InstanceCreationDesc desc, const rhi::Device& device)
{
    desc.isSoftwareDevice = desc.isSoftwareDevice || device.info().isSoftware;
    return desc;
}

UniqueInstance Core::createInstance(InstanceCreationDesc desc, CreationMessage& message)
{
    desc.messageSink = {CreationMessage::report, &message};
    Instance* instance = nullptr;
    const Result result = CreateInstance(desc, instance);
    if (result != Result::SUCCESS) throw Refusal(result, message.text);
    return UniqueInstance(instance);
}

std::vector<Core::DenoiserState> Core::denoisersOf(const InstanceCreationDesc& desc)
{
    std::vector<DenoiserState> denoisers;
    for (uint32_t i = 0; desc.denoisers && i < desc.denoisersNum; i++) denoisers.push_back({desc.denoisers[i], {}});
    if (desc.confidenceTileSize > 0)
        denoisers.push_back({{kConfidenceIdentifier, Denoiser::MAX_NUM, desc.confidenceTileSize, false}, {}});
    return denoisers;
}

UniqueInstance Core::createScratchInstance()
{
    std::vector<DenoiserDesc> denoisers;
    for (const DenoiserState& denoiser : m_denoisers)
        if (!denoiser.isConfidence()) denoisers.push_back(denoiser.desc);
    InstanceCreationDesc desc = m_instanceDesc;
    desc.denoisers = denoisers.data();
    return createInstance(desc, m_creationMessage);
}

void Core::createFrameResources()
{
    const InstanceDesc& instance = description();
    const DescriptorPoolDesc& totals = instance.descriptorPoolDesc;
    const uint32_t calls = m_desc.maxDenoiseCallsPerFrame;
    ConstantRingDesc ring;
    ring.name = m_desc.name;
    ring.maxDataSize = instance.constantBufferMaxDataSize;
    ring.blocksPerFrame = totals.setsMaxNum * calls;
    ring.framesInFlight = m_desc.framesInFlight;
    ring.set = instance.constantsAndSamplersSet;
    ring.binding = instance.constantBufferBinding;
    ring.samplerCount = instance.samplersNum;
    m_constants.emplace(m_device, ring);
    const uint32_t timedPasses = m_desc.isGpuTimingEnabled ? totals.setsMaxNum * calls : 0;
    m_timer.emplace(m_device, m_desc.name, timedPasses, m_desc.framesInFlight);
    const uint32_t tracedPasses = m_desc.isPassTracingEnabled ? totals.setsMaxNum * calls : 0;
    m_trace.emplace(m_device, m_desc.name, tracedPasses, m_desc.framesInFlight);
    m_planner.emplace(maxResourceCount(instance));

    rhi::DescriptorPoolDesc pool;
    pool.sets = std::max(totals.setsMaxNum * calls, 1u);
    pool.sampledTextures = totals.texturesMaxNum * calls;
    pool.storageTextures = totals.storageTexturesMaxNum * calls;
    pool.storageBuffers = totals.storageBuffersMaxNum * calls;
    for (uint32_t i = 0; i < m_desc.framesInFlight; i++)
    {
        const std::string name = sentence("%s descriptors %u", m_desc.name, i);
        pool.name = name.c_str();
        m_frameSets.emplace_back(m_device, pool);
    }
    m_wrappedCommands.resize(kWrappedCommandBuffers);
}

void Core::createDefaultPipelines()
{
    // On an instance of its own: asking for dispatches advances the history of the denoisers that are asked.
    const UniqueInstance scratch = createScratchInstance();
    std::vector<Identifier> identifiers;
    for (const DenoiserState& denoiser : m_denoisers) identifiers.push_back(denoiser.desc.identifier);
    CommonSettings settings = typicalSettings(m_desc.resourceWidth, m_desc.resourceHeight);
    for (settings.frameIndex = 0; settings.frameIndex < 2; settings.frameIndex++) // with and without the first clears
    {
        const DispatchDesc* dispatches = nullptr;
        uint32_t dispatchCount = 0;
        if (SetCommonSettings(*scratch, settings) != Result::SUCCESS ||
            GetComputeDispatches(*scratch, identifiers.data(), static_cast<uint32_t>(identifiers.size()), dispatches,
                                 dispatchCount) != Result::SUCCESS)
            throw Refusal(Result::FAILURE, sentence("createDefaultPipelines: %s", nrd::GetLastMessage(*scratch)));
        for (uint32_t i = 0; i < dispatchCount; i++) m_pipelines.get(description(), dispatches[i].pipelineIndex);
    }
}

PoolMemoryRequirements Core::memoryRequirements(rhi::Device& device, const IntegrationCreationDesc& desc,
                                                const InstanceCreationDesc& instanceDesc)
{
    CreationMessage message; // must outlive the instance
    const UniqueInstance instance = createInstance(instanceDesc, message);
    const PoolsDesc pools = {"NRD", checked(desc).resourceWidth, desc.resourceHeight, {}, nullptr};
    return poolMemoryRequirements(device, pools, GetInstanceDesc(*instance));
}

void Core::newFrame()
{
    // What can fail comes first: a frame that did not begin must not count, or the next one would take a slot in use.
    const uint64_t frame = m_frame + 1;
    const uint32_t slot = static_cast<uint32_t>(frame % m_desc.framesInFlight);
    m_timer->collect(slot);
    if (frame > m_desc.framesInFlight + kIdleFrames)
        m_views.collect(frame - m_desc.framesInFlight - kIdleFrames, m_retired);
    m_frameSets[slot].beginFrame();
    m_frame = frame;
    if (m_transfer && !m_transfer->isPending()) m_transfer.reset();
    m_requested.clear();
    m_constants->beginFrame(slot);
    m_timer->beginFrame(m_frame, slot);
    m_trace->beginFrame(m_frame, slot);
    m_dispatchesLeft = description().descriptorPoolDesc.setsMaxNum * m_desc.maxDenoiseCallsPerFrame;
    if (m_frame >= m_desc.framesInFlight) m_retired.collect(m_frame - m_desc.framesInFlight);
}

void Core::setCommonSettings(const CommonSettings& settings)
{
    if (m_frame == 0) throw Refusal(Result::INVALID_ARGUMENT, "NewFrame() must be called before SetCommonSettings()");
    if (settings.resourceSize[0] != m_desc.resourceWidth || settings.resourceSize[1] != m_desc.resourceHeight)
        throw Refusal(Result::INVALID_ARGUMENT,
                      sentence("resourceSize is %u x %u, but the integration was created or resized for %u x %u",
                               settings.resourceSize[0], settings.resourceSize[1], m_desc.resourceWidth,
                               m_desc.resourceHeight));
    if (m_hasFrameIndex && m_frameIndexFrame != m_frame && settings.frameIndex == m_common.frameIndex)
        throw Refusal(Result::INVALID_ARGUMENT,
                      sentence("frameIndex is %u as in the previous frame, it must grow by 1 with each frame",
                               settings.frameIndex));
    const bool isContinued = m_transfer && m_transfer->isContinuedBy(settings);
    const CommonSettings common = isContinued ? m_transfer->adapt(settings) : settings;
    const bool isDropped = isTransferPending() && !isContinued;
    if (isDropped) m_retired.reserve(2);
    check(SetCommonSettings(*m_instance, common));
    if (isDropped) dropHistory();
    m_requested.clear();
    m_common = common;
    m_hasFrameIndex = true;
    m_frameIndexFrame = m_frame;
    m_settingsFrame = m_frame;
}

Core::DenoiserState& Core::find(Identifier identifier)
{
    for (DenoiserState& denoiser : m_denoisers)
        if (denoiser.desc.identifier == identifier) return denoiser;
    if (identifier == kConfidenceIdentifier)
        throw Refusal(Result::INVALID_ARGUMENT, "confidenceTileSize is 0, must be in [1; 8] for confidence to be made");
    throw Refusal(Result::INVALID_ARGUMENT, sentence("identifier %u names no denoiser of this instance", identifier));
}

void Core::check(Result result) const
{
    if (result != Result::SUCCESS) throw Refusal(result, nrd::GetLastMessage(*m_instance));
}

MemoryStatistics Core::memoryStatistics() const
{
    MemoryStatistics result;
    result.permanent = m_pools->permanent().byteSize();
    result.transient = m_pools->transient().byteSize();
    result.total = m_memory.byteSize();
    for (const rhi::MemoryReportLine& line : m_device.memoryReport())
        for (const char* const part : {"permanent", "transient", "constants", "buffers"})
            if (line.tag == memoryTag(m_desc.name, part)) result.total += line.byteSize;
    return result;
}

NrdMemory Core::transientMemory() const { return isTransientShared() ? m_pools->transient().memory() : NrdMemory(); }

IntegrationStatistics Core::statistics() const
{
    return {m_views.size(), m_retired.size(), m_pipelines.createdCount()};
}
} // namespace nrd
