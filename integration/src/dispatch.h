// From dispatch descriptions to commands, in two steps: planning does all that can fail (pipelines, views, descriptor
// sets, constants) and decides the barriers; recording cannot fail.
#pragma once
#include "constant_ring.h"
#include "frame_sets.h"
#include "pass_trace.h"
#include "pipelines.h"
#include "pools.h"
#include "timing.h"
#include "view_cache.h"
#include <nrd/integration.h>
#include <optional>

namespace nrd
{
struct PlannedDispatch
{
    const char* name = "";
    const rhi::Pipeline* pipeline = nullptr;
    const rhi::DescriptorSet* constants = nullptr; // null: the pipeline has none
    uint32_t constantsOffset = 0;                  // bytes
    const rhi::DescriptorSet* resources = nullptr;
    uint32_t textureBarrierEnd = 0; // its barriers begin where those of the dispatch before end
    uint32_t bufferBarrierEnd = 0;
    uint32_t groups[2] = {};
    const rhi::Buffer* indirect = nullptr; // arguments; null: `groups`
    uint64_t indirectOffset = 0;           // bytes
};

/// Barriers of all dispatches in order, then those that restore the application's states.
struct Plan
{
    std::optional<rhi::MemoryBarrier> transientBefore; // of shared transient memory
    std::optional<rhi::MemoryBarrier> transientAfter;
    std::vector<PlannedDispatch> dispatches;
    std::vector<rhi::TextureBarrier> textureBarriers;
    std::vector<rhi::BufferBarrier> bufferBarriers;
    const FrameSets* sets = nullptr; // that the resources are of
    uint64_t setsGeneration = 0;     // of them

    void clear();
};
/// Recorded, both give the same commands.
bool isSame(const Plan& a, const Plan& b);

/// What planning reads and takes from; all borrowed for one call.
struct PlanContext
{
    rhi::Device& device;
    const InstanceDesc& instance;
    Pipelines& pipelines;
    ConstantRing& constants;
    Pools& pools;
    ViewCache& views;
    RetireQueue& retired;
    FrameSets& sets; // of the frame
    NrdUserPool& userPool;
    const NrdUserPool& arrival; // states to restore
    LayoutPolicy layoutPolicy;
    bool isTransientShared;
    uint64_t frame;
};

class Planner
{
public:
    explicit Planner(uint32_t maxResourceCount); // of a dispatch

    /// False if the plan is not the `expected` one, where there is such. Then, and where a Refusal or rhi::Error is
    /// thrown, the user pool and the states of the pools are as before.
    bool plan(const PlanContext& context, rhi::Span<const DispatchDesc> dispatches, const DenoiseOptions& options,
              const Plan* expected = nullptr);
    const Plan& latest() const { return m_plan; }

private:
    struct UserSlot
    {
        CachedImage* cached = nullptr;
        uint32_t state = 0; // index in Pools::states; slots with one image share it
        rhi::TextureState initial = {};
    };

    void takeTransientMemory(const PlanContext& context, const DenoiseOptions& options);
    void enterUserStates(const PlanContext& context);
    void restoreUserStates(const PlanContext& context);
    void leaveUserStates(const PlanContext& context) const;
    void planDispatch(const PlanContext& context, const DispatchDesc& dispatch);
    void planBarriers(const PlanContext& context, const DispatchDesc& dispatch);
    void planBufferUse(const PlanContext& context, uint32_t buffer, const rhi::BufferState& after);
    void planDescriptors(const PlanContext& context, const DispatchDesc& dispatch, PlannedDispatch& planned);
    void planConstants(const PlanContext& context, const DispatchDesc& dispatch, PlannedDispatch& planned);
    uint32_t stateIndex(const PlanContext& context, const ResourceDesc& resource) const;
    const rhi::Texture& textureOf(const PlanContext& context, uint32_t stateIndex);
    const rhi::TextureView& viewOf(const PlanContext& context, const ResourceDesc& resource);
    CachedImage& cachedImage(const PlanContext& context, ResourceType slot);

    Plan m_plan;
    UserSlot m_slots[NrdUserPool::kSlotsNum];
    std::vector<Transition> m_transitions;
    std::vector<rhi::DescriptorWrite> m_writes;
    StateTracker m_savedStates;
    std::vector<rhi::BufferState> m_savedBufferStates;
    bool m_hasConstants = false;    // an earlier dispatch of this call stored some,
    uint32_t m_constantsOffset = 0; // here
};

/// What watches passes while they run; each may be off.
struct PassObservers
{
    FrameTimer& timer;
    PassTrace& trace;
};

/// `label` names the whole call.
void record(rhi::CommandBuffer& commands, const Plan& plan, const InstanceDesc& instance,
            const PassObservers& observers, const char* label);
} // namespace nrd
