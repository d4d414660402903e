// The part of Core that runs for every call of Denoise().
#include "core.h"
#include "user_pool.h"
#include <algorithm>
#include <optional>
#include <rhi/vulkan.h>

namespace nrd
{
void Core::denoise(VkCommandBuffer commandBuffer, rhi::Span<const Identifier> identifiers, NrdUserPool& userPool,
                   const DenoiseOptions& options)
{
    if (commandBuffer == VK_NULL_HANDLE) throw Refusal(Result::INVALID_ARGUMENT, "commandBuffer is null");
    checkRequest(identifiers, userPool);
    if (identifiers.empty()) return;
    rhi::CommandBuffer& commands = wrap(commandBuffer);
    rhi::Span<const DispatchDesc> dispatches;
    const bool hasDump = isDumped(identifiers);
    const bool hasTransfer = isTransferPending();
    // Before a dump enters other states: what they are restored to, also if planning fails.
    std::optional<NrdUserPool> arrival;
    if (hasDump) arrival = userPool;
    try
    {
        if (hasDump) planDump(identifiers, userPool); // first, as its failure breaks no history
        if (hasTransfer) planTransfer();
        dispatches = request(identifiers);
        m_planner->plan(planContext(userPool, arrival ? *arrival : userPool), dispatches, options);
    }
    catch (...)
    {
        if (arrival) userPool = *arrival;
        if (hasTransfer) m_transfer->cancel(*m_pools);
        throw;
    }
    if (hasTransfer) recordTransfer(commands);
    if (hasDump) m_dump->record(commands, copyContext());
    record(commands, m_planner->latest(), description(), {*m_timer, *m_trace}, m_desc.name);
    const bool isRepeatable = options.recording != 0 && !hasDump && !hasTransfer && !isObserved();
    if (isRepeatable)
        m_recordings.keep(options.recording, m_planner->latest());
    else
        m_recordings.forget(options.recording);
    finishCall(identifiers, dispatches.size());
}

bool Core::repeat(rhi::Span<const Identifier> identifiers, NrdUserPool& userPool, const DenoiseOptions& options)
{
    if (options.recording == 0)
        throw Refusal(Result::INVALID_ARGUMENT, "options.recording is 0, must be the number that Denoise() was given");
    checkRequest(identifiers, userPool);
    if (identifiers.empty()) return true;
    const Plan* const kept = m_recordings.find(options.recording);
    if (!kept || isObserved() || isDumped(identifiers) || isTransferPending()) return false;
    const rhi::Span<const DispatchDesc> dispatches = request(identifiers);
    m_requested.assign(identifiers.begin(), identifiers.end());
    m_requestedDispatches = dispatches;
    if (!m_planner->plan(planContext(userPool, userPool), dispatches, options, kept)) return false;
    finishCall(identifiers, dispatches.size());
    return true;
}

rhi::Span<const DispatchDesc> Core::request(rhi::Span<const Identifier> identifiers)
{
    const bool isKnown = !m_requested.empty() &&
                         std::equal(identifiers.begin(), identifiers.end(), m_requested.begin(), m_requested.end());
    if (isKnown) return m_requestedDispatches;
    m_requested.clear();
    const bool isRepaired = repairHistory(identifiers);
    const DispatchDesc* dispatches = nullptr;
    uint32_t dispatchCount = 0;
    check(GetComputeDispatches(*m_instance, identifiers.data(), static_cast<uint32_t>(identifiers.size()), dispatches,
                               dispatchCount));
    for (const Identifier identifier : identifiers)
        find(identifier).isHistoryBroken = true;                     // until it is recorded or repeated
    if (isRepaired) check(SetCommonSettings(*m_instance, m_common)); // other identifiers of this frame keep theirs
    return {dispatches, dispatchCount};
}

void Core::finishCall(rhi::Span<const Identifier> identifiers, size_t dispatchCount)
{
    m_requested.clear();
    m_dispatchesLeft -= std::min(m_dispatchesLeft, static_cast<uint32_t>(dispatchCount));
    for (const Identifier identifier : identifiers)
    {
        DenoiserState& denoiser = find(identifier);
        denoiser.isHistoryBroken = false;
        denoiser.lastFrame = m_frame;
    }
}

void Core::checkRequest(rhi::Span<const Identifier> identifiers, const NrdUserPool& userPool)
{
    if (m_frame == 0) throw Refusal(Result::INVALID_ARGUMENT, "NewFrame() must be called before Denoise()");
    if (m_settingsFrame != m_frame)
        throw Refusal(Result::INVALID_ARGUMENT,
                      "SetCommonSettings() must be called between NewFrame() or Resize() and Denoise()");
    if (identifiers.size() != 0 && identifiers.data() == nullptr)
        throw Refusal(Result::INVALID_ARGUMENT, sentence("identifiers is null, but identifiersNum is %u",
                                                         static_cast<uint32_t>(identifiers.size())));
    for (size_t i = 0; i < identifiers.size(); i++)
    {
        const DenoiserState& denoiser = find(identifiers[i]);
        const bool isListedTwice =
            std::find(identifiers.begin(), identifiers.begin() + i, identifiers[i]) != identifiers.begin() + i;
        if (isListedTwice || (denoiser.lastFrame == m_frame && denoiser.desc.hasHistory))
            throw Refusal(Result::INVALID_ARGUMENT,
                          sentence("identifier %u (%s) is denoised twice in one frame, which would spoil its history",
                                   identifiers[i], denoiser.name()));
        checkUserPool(denoiser, userPool);
    }
    const std::string conflict = findStateConflict(userPool);
    if (!conflict.empty()) throw Refusal(Result::INVALID_ARGUMENT, conflict);
    if (m_dispatchesLeft < description().descriptorPoolDesc.setsMaxNum)
        throw Refusal(Result::INVALID_ARGUMENT,
                      sentence("Denoise() is called more often in this frame than maxDenoiseCallsPerFrame = %u allows",
                               m_desc.maxDenoiseCallsPerFrame));
}

void Core::checkUserPool(const DenoiserState& denoiser, const NrdUserPool& userPool) const
{
    const ResourceRequirement* needs = nullptr;
    uint32_t needCount = 0;
    check(GetRequiredResources(*m_instance, denoiser.desc.identifier, needs, needCount));
    for (uint32_t i = 0; i < needCount; i++)
    {
        const uint32_t divisor = needs[i].sizeDivisor;
        const SlotRules rules = {(m_desc.resourceWidth + divisor - 1) / divisor,
                                 (m_desc.resourceHeight + divisor - 1) / divisor, description().normalEncoding};
        const std::string error = findError(userPool[needs[i].type], needs[i], rules, denoiser.name());
        if (!error.empty()) throw Refusal(Result::INVALID_ARGUMENT, error);
    }
    const std::string overlap = findOverlap(userPool, {needs, needCount});
    if (!overlap.empty()) throw Refusal(Result::INVALID_ARGUMENT, overlap);
}

bool Core::repairHistory(rhi::Span<const Identifier> identifiers)
{
    bool isBroken = false;
    for (const Identifier identifier : identifiers) isBroken |= find(identifier).isHistoryBroken;
    if (!isBroken) return false;
    CommonSettings settings = m_common;
    settings.accumulationMode = AccumulationMode::CLEAR_AND_RESTART;
    check(SetCommonSettings(*m_instance, settings));
    return true;
}

PlanContext Core::planContext(NrdUserPool& userPool, const NrdUserPool& arrival)
{
    return {
        m_device, description(), m_pipelines,         *m_constants,        *m_pools, m_views, m_retired, frameSets(),
        userPool, arrival,       m_desc.layoutPolicy, isTransientShared(), m_frame};
}

rhi::CommandBuffer& Core::wrap(VkCommandBuffer commandBuffer)
{
    for (const WrappedCommands& wrapped : m_wrappedCommands)
        if (wrapped.handle == commandBuffer) return *wrapped.commands;
    WrappedCommands& wrapped = m_wrappedCommands[m_nextWrapped];
    wrapped.commands = rhi::wrapVulkanCommandBuffer(m_device, commandBuffer);
    wrapped.handle = commandBuffer;
    m_nextWrapped = (m_nextWrapped + 1) % m_wrappedCommands.size();
    return *wrapped.commands;
}
} // namespace nrd
