#include "dispatch.h"
#include "convert.h"
#include "refusal.h"
#include <algorithm>
#include <utility>

namespace nrd
{
namespace
{
bool isUserSlot(ResourceType type) { return static_cast<uint32_t>(type) < NrdUserPool::kSlotsNum; }
ResourceType slotAt(uint32_t index) { return static_cast<ResourceType>(index); }

uint32_t poolTextureCount(const Pools& pools) { return pools.permanent().size() + pools.transient().size(); }

// UNDEFINED and PREINITIALIZED cannot be returned to.
bool canRestore(VkImageLayout layout)
{
    return layout != VK_IMAGE_LAYOUT_UNDEFINED && layout != VK_IMAGE_LAYOUT_PREINITIALIZED;
}

bool isSameDispatch(const PlannedDispatch& a, const PlannedDispatch& b)
{
    return a.pipeline == b.pipeline && a.constants == b.constants && a.constantsOffset == b.constantsOffset &&
           a.resources == b.resources && a.textureBarrierEnd == b.textureBarrierEnd &&
           a.bufferBarrierEnd == b.bufferBarrierEnd && a.groups[0] == b.groups[0] && a.groups[1] == b.groups[1] &&
           a.indirect == b.indirect && a.indirectOffset == b.indirectOffset;
}

bool isSameTextureBarrier(const rhi::TextureBarrier& a, const rhi::TextureBarrier& b)
{
    return a.texture == b.texture && a.before == b.before && a.after == b.after; // always of all mips
}

bool isSameMemoryBarrier(const std::optional<rhi::MemoryBarrier>& a, const std::optional<rhi::MemoryBarrier>& b)
{
    return a.has_value() == b.has_value() && (!a || (a->before == b->before && a->after == b->after));
}

bool isSameBufferBarrier(const rhi::BufferBarrier& a, const rhi::BufferBarrier& b)
{
    return a.buffer == b.buffer && a.before.access == b.before.access && a.before.stages == b.before.stages &&
           a.after.access == b.after.access && a.after.stages == b.after.stages;
}
} // namespace

bool isSame(const Plan& a, const Plan& b)
{
    return a.sets == b.sets && a.setsGeneration == b.setsGeneration &&
           isSameMemoryBarrier(a.transientBefore, b.transientBefore) &&
           isSameMemoryBarrier(a.transientAfter, b.transientAfter) &&
           std::equal(a.dispatches.begin(), a.dispatches.end(), b.dispatches.begin(), b.dispatches.end(),
                      isSameDispatch) &&
           std::equal(a.textureBarriers.begin(), a.textureBarriers.end(), b.textureBarriers.begin(),
                      b.textureBarriers.end(), isSameTextureBarrier) &&
           std::equal(a.bufferBarriers.begin(), a.bufferBarriers.end(), b.bufferBarriers.begin(),
                      b.bufferBarriers.end(), isSameBufferBarrier);
}

void Plan::clear()
{
    transientBefore.reset();
    transientAfter.reset();
    dispatches.clear();
    textureBarriers.clear();
    bufferBarriers.clear();
}

Planner::Planner(uint32_t maxResourceCount) { m_writes.reserve(maxResourceCount); }

bool Planner::plan(const PlanContext& context, rhi::Span<const DispatchDesc> dispatches, const DenoiseOptions& options,
                   const Plan* expected)
{
    // Puts the states back if planning fails half-way; dismissed at the end.
    struct Rollback
    {
        Planner& planner;
        Pools& pools;
        ConstantRing& constants;
        uint32_t freeBlockCount = constants.freeBlockCount();
        bool isArmed = true;
        ~Rollback()
        {
            if (!isArmed) return;
            std::swap(pools.states, planner.m_savedStates);
            std::swap(pools.bufferStates, planner.m_savedBufferStates);
            constants.rewind(freeBlockCount);
        }
    };
    m_plan.clear();
    m_hasConstants = false;
    m_savedStates = context.pools.states;
    m_savedBufferStates = context.pools.bufferStates;
    context.sets.beginCall();
    m_plan.sets = &context.sets;
    m_plan.setsGeneration = context.sets.generation();
    Rollback rollback{*this, context.pools, context.constants};

    if (context.isTransientShared) takeTransientMemory(context, options);
    enterUserStates(context);
    for (const DispatchDesc& dispatch : dispatches) planDispatch(context, dispatch);
    if (options.restoreInitialStates) restoreUserStates(context);
    if (expected && !isSame(m_plan, *expected)) return false;
    leaveUserStates(context);
    rollback.isArmed = false;
    context.sets.endCall();
    return true;
}

// Barriers of images see what went through them, so memory that others used is ordered by barriers of all memory. Its
// images are then undefined, and their own barriers go on from that one.
void Planner::takeTransientMemory(const PlanContext& context, const DenoiseOptions& options)
{
    constexpr rhi::MemoryState kOurs = {rhi::Access::SampledRead | rhi::Access::StorageRead | rhi::Access::StorageWrite,
                                        rhi::Stage::Compute};
    constexpr rhi::TextureState kTaken = {rhi::Access::StorageWrite, rhi::Layout::Undefined, rhi::Stage::Compute};
    NrdMemoryUse before = options.transientBefore;
    const uint32_t first = context.pools.permanent().size(), end = poolTextureCount(context.pools);
    bool isUntouched = true; // by these textures: those of before a Resize() may have been in the same memory
    for (uint32_t i = first; i < end; i++) isUntouched &= context.pools.states.state(i) == rhi::states::kUndefined;
    if (before.stages != 0 || isUntouched)
    {
        if (before.stages == 0) before.access = 0;
        before.access |= VK_ACCESS_SHADER_WRITE_BIT; // our own use before that
        before.stages |= VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT;
        m_plan.transientBefore = {toRhi(before), kOurs};
        for (uint32_t i = first; i < end; i++) context.pools.states.setState(i, kTaken);
    }
    if (options.transientAfter.stages != 0) m_plan.transientAfter = {kOurs, toRhi(options.transientAfter)};
}

void Planner::enterUserStates(const PlanContext& context)
{
    const uint32_t first = poolTextureCount(context.pools);
    for (uint32_t i = 0; i < NrdUserPool::kSlotsNum; i++)
    {
        const NrdUserImage& image = context.userPool[slotAt(i)];
        m_slots[i] = {nullptr, first + i, toRhi(context.arrival[slotAt(i)].state)};
        if (image.image == VK_NULL_HANDLE) continue;
        for (uint32_t j = 0; j < i; j++)
            if (context.userPool[slotAt(j)].image == image.image)
                m_slots[i].state = std::min(m_slots[i].state, first + j);
        context.pools.states.setState(m_slots[i].state, toRhi(image.state));
    }
}

void Planner::restoreUserStates(const PlanContext& context)
{
    const uint32_t first = poolTextureCount(context.pools);
    StateTracker& states = context.pools.states;
    m_plan.textureBarriers.reserve(m_plan.textureBarriers.size() + NrdUserPool::kSlotsNum);
    for (uint32_t i = 0; i < NrdUserPool::kSlotsNum; i++)
    {
        const UserSlot& slot = m_slots[i];
        const rhi::TextureState left = states.state(slot.state);
        if (slot.state != first + i || left == slot.initial) continue; // done under its first slot, or as it came
        if (!canRestore(context.arrival[slotAt(i)].state.layout)) continue;
        m_plan.textureBarriers.push_back({&textureOf(context, slot.state), left, slot.initial});
        states.setState(slot.state, slot.initial);
    }
}

void Planner::leaveUserStates(const PlanContext& context) const
{
    const StateTracker& states = context.pools.states;
    for (uint32_t i = 0; i < NrdUserPool::kSlotsNum; i++)
    {
        NrdUserImage& image = context.userPool[slotAt(i)];
        if (image.image != VK_NULL_HANDLE) image.state = toImageState(states.state(m_slots[i].state));
    }
}

void Planner::planDispatch(const PlanContext& context, const DispatchDesc& dispatch)
{
    PlannedDispatch planned;
    planned.name = dispatch.name;
    planned.pipeline = &context.pipelines.get(context.instance, dispatch.pipelineIndex);
    planBarriers(context, dispatch);
    planDescriptors(context, dispatch, planned);
    planConstants(context, dispatch, planned);
    planned.textureBarrierEnd = static_cast<uint32_t>(m_plan.textureBarriers.size());
    planned.bufferBarrierEnd = static_cast<uint32_t>(m_plan.bufferBarriers.size());
    planned.groups[0] = dispatch.gridWidth;
    planned.groups[1] = dispatch.gridHeight;
    if (dispatch.indirectBufferIndex != kNoBuffer)
    {
        planned.indirect = &context.pools.buffer(dispatch.indirectBufferIndex);
        planned.indirectOffset = dispatch.indirectBufferOffset;
    }
    m_plan.dispatches.push_back(planned);
}

void Planner::planBarriers(const PlanContext& context, const DispatchDesc& dispatch)
{
    for (uint32_t i = 0; i < dispatch.resourcesNum; i++)
    {
        const ResourceDesc& resource = dispatch.resources[i];
        if (resource.descriptorType == DescriptorType::STORAGE_BUFFER)
        {
            planBufferUse(context, resource.indexInPool, toBufferState(resource.state));
            continue;
        }
        if (isUserSlot(resource.type) && context.userPool[resource.type].image == VK_NULL_HANDLE)
            throw Refusal(Result::INVALID_ARGUMENT,
                          sentence("%s: the slot is empty, but '%s' needs it", toString(resource.type), dispatch.name));
        context.pools.states.use(stateIndex(context, resource), toRhi(resource.state, context.layoutPolicy));
    }
    if (dispatch.indirectBufferIndex != kNoBuffer)
        planBufferUse(context, dispatch.indirectBufferIndex, toBufferState(ResourceState::INDIRECT_ARGUMENTS));
    m_transitions.clear();
    context.pools.states.endStep(m_transitions);
    for (const Transition& transition : m_transitions)
        m_plan.textureBarriers.push_back(
            {&textureOf(context, transition.texture), transition.before, transition.after});
}

void Planner::planBufferUse(const PlanContext& context, uint32_t buffer, const rhi::BufferState& after)
{
    rhi::BufferState& state = context.pools.bufferStates[buffer];
    const rhi::TextureState before = {state.access, rhi::Layout::General, state.stages};
    if (state.access != rhi::Access::None && needsBarrier(before, {after.access, rhi::Layout::General, after.stages}))
        m_plan.bufferBarriers.push_back({&context.pools.buffer(buffer), state, after});
    else if (state.access != rhi::Access::None)
        return; // already readable
    state = after;
}

void Planner::planDescriptors(const PlanContext& context, const DispatchDesc& dispatch, PlannedDispatch& planned)
{
    if (dispatch.resourcesNum == 0) return;
    m_writes.clear();
    for (uint32_t i = 0; i < dispatch.resourcesNum; i++)
    {
        const ResourceDesc& resource = dispatch.resources[i];
        rhi::DescriptorWrite write;
        write.binding = i;
        if (resource.descriptorType == DescriptorType::STORAGE_BUFFER)
        {
            write.buffer = &context.pools.buffer(resource.indexInPool);
            write.size = write.buffer->desc().size;
        }
        else
        {
            write.view = &viewOf(context, resource);
            write.layout = context.pools.states.needed(stateIndex(context, resource)).layout;
        }
        m_writes.push_back(write);
    }
    planned.resources =
        &context.sets.take(*planned.pipeline, context.instance.resourcesSet, m_writes, context.views.generation());
}

void Planner::planConstants(const PlanContext& context, const DispatchDesc& dispatch, PlannedDispatch& planned)
{
    if (!context.instance.pipelines[dispatch.pipelineIndex].hasConstantData) return;
    if (!m_hasConstants || !dispatch.constantBufferDataMatchesPreviousDispatch)
        m_constantsOffset = context.constants.push(dispatch.constantBufferData, dispatch.constantBufferDataSize);
    m_hasConstants = true;
    planned.constants = &context.constants.descriptorSet(*planned.pipeline);
    planned.constantsOffset = m_constantsOffset;
}

uint32_t Planner::stateIndex(const PlanContext& context, const ResourceDesc& resource) const
{
    if (resource.type == ResourceType::PERMANENT_POOL) return resource.indexInPool;
    if (resource.type == ResourceType::TRANSIENT_POOL) return context.pools.permanent().size() + resource.indexInPool;
    return m_slots[static_cast<uint32_t>(resource.type)].state;
}

const rhi::Texture& Planner::textureOf(const PlanContext& context, uint32_t stateIndex)
{
    const uint32_t permanentCount = context.pools.permanent().size();
    const uint32_t poolCount = poolTextureCount(context.pools);
    if (stateIndex < permanentCount) return context.pools.permanent().texture(stateIndex);
    if (stateIndex < poolCount) return context.pools.transient().texture(stateIndex - permanentCount);
    return cachedImage(context, slotAt(stateIndex - poolCount)).texture();
}

const rhi::TextureView& Planner::viewOf(const PlanContext& context, const ResourceDesc& resource)
{
    const bool isStorage = resource.descriptorType == DescriptorType::STORAGE_TEXTURE;
    const rhi::ViewType type = isStorage ? rhi::ViewType::Storage : rhi::ViewType::Sampled;
    if (resource.type == ResourceType::PERMANENT_POOL)
        return context.pools.permanent().view(resource.indexInPool, type);
    if (resource.type == ResourceType::TRANSIENT_POOL)
        return context.pools.transient().view(resource.indexInPool, type);
    return cachedImage(context, resource.type).view(context.device, type);
}

CachedImage& Planner::cachedImage(const PlanContext& context, ResourceType slot)
{
    CachedImage*& cached = m_slots[static_cast<uint32_t>(slot)].cached;
    if (!cached)
        cached = &context.views.acquire(context.userPool[slot], toString(slot), context.frame, context.retired);
    return *cached;
}

void record(rhi::CommandBuffer& commands, const Plan& plan, const InstanceDesc& instance,
            const PassObservers& observers, const char* label)
{
    const rhi::TextureBarrier* const textures = plan.textureBarriers.data();
    const rhi::BufferBarrier* const buffers = plan.bufferBarriers.data();
    uint32_t textureBegin = 0;
    uint32_t bufferBegin = 0;
    const rhi::Pipeline* pipeline = nullptr;
    const rhi::DescriptorSet* constants = nullptr; // bound, with the offset below
    uint32_t constantsOffset = 0;

    commands.beginLabel(label);
    observers.timer.beginCall(commands, static_cast<uint32_t>(plan.dispatches.size()));
    if (plan.transientBefore) commands.barrier(*plan.transientBefore);
    for (const PlannedDispatch& dispatch : plan.dispatches)
    {
        commands.beginLabel(dispatch.name);
        observers.trace.beginPass(commands, dispatch.name);
        if (dispatch.textureBarrierEnd != textureBegin || dispatch.bufferBarrierEnd != bufferBegin)
            commands.barriers({textures + textureBegin, dispatch.textureBarrierEnd - textureBegin},
                              {buffers + bufferBegin, dispatch.bufferBarrierEnd - bufferBegin});
        if (dispatch.pipeline != pipeline) commands.bindPipeline(*dispatch.pipeline);
        if (dispatch.constants && (!constants || dispatch.constantsOffset != constantsOffset))
            commands.bindSet(instance.constantsAndSamplersSet, *dispatch.constants, {dispatch.constantsOffset});
        if (dispatch.resources) commands.bindSet(instance.resourcesSet, *dispatch.resources, {});
        if (dispatch.indirect)
            commands.dispatchIndirect(*dispatch.indirect, dispatch.indirectOffset);
        else
            commands.dispatch(dispatch.groups[0], dispatch.groups[1], 1);
        commands.endLabel();
        observers.timer.endPass(commands, dispatch.name);
        pipeline = dispatch.pipeline;
        constants = dispatch.constants; // a pipeline without constants disturbs their set
        constantsOffset = dispatch.constantsOffset;
        textureBegin = dispatch.textureBarrierEnd;
        bufferBegin = dispatch.bufferBarrierEnd;
    }
    observers.trace.endCall(commands);
    if (plan.textureBarriers.size() != textureBegin)
        commands.barriers({textures + textureBegin, plan.textureBarriers.size() - textureBegin}, {});
    if (plan.transientAfter) commands.barrier(*plan.transientAfter);
    commands.endLabel();
}
} // namespace nrd
