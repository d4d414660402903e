#include "state_tracker.h"

namespace nrd
{
namespace
{
constexpr rhi::Access kWrites =
    rhi::Access::StorageWrite | rhi::Access::TransferWrite | rhi::Access::HostWrite | rhi::Access::MemoryWrite;
} // namespace

bool needsBarrier(const rhi::TextureState& before, const rhi::TextureState& after)
{
    // What only the engine knows may contain anything; it happens once per image and call.
    if (before.layout == rhi::Layout::Native || after.layout == rhi::Layout::Native) return before != after;
    if (before.layout != after.layout) return true;
    if (rhi::hasAny(before.access, kWrites) || rhi::hasAny(after.access, kWrites)) return true;
    // Read after read: the writer's barrier may have covered another stage only, as the engine's fragment stage.
    return !rhi::hasAll(before.stages, after.stages) || !rhi::hasAll(before.access, after.access);
}

rhi::TextureState combineUses(const rhi::TextureState& a, const rhi::TextureState& b)
{
    const rhi::Layout layout = a.layout == b.layout ? a.layout : rhi::Layout::General;
    return {a.access | b.access, layout, a.stages | b.stages};
}

StateTracker::StateTracker(uint32_t textureCount) : m_entries(textureCount) { m_used.reserve(textureCount); }

void StateTracker::use(uint32_t texture, const rhi::TextureState& state)
{
    Entry& entry = m_entries[texture];
    if (entry.isUsed)
    {
        entry.needed = combineUses(entry.needed, state);
        return;
    }
    entry.isUsed = true;
    entry.needed = state;
    m_used.push_back(texture);
}

void StateTracker::endStep(std::vector<Transition>& transitions)
{
    for (const uint32_t texture : m_used)
    {
        Entry& entry = m_entries[texture];
        entry.isUsed = false;
        if (!needsBarrier(entry.state, entry.needed)) continue;
        transitions.push_back({texture, entry.state, entry.needed});
        entry.state = entry.needed;
    }
    m_used.clear();
}
} // namespace nrd
