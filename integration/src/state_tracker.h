// Which barriers a sequence of uses needs: pure, knows textures by number only.
// A state says how a texture was last used or which use the last barrier made it ready for. One step = one dispatch,
// and at most one barrier per texture and step.
#pragma once
#include <cstdint>
#include <rhi/states.h>
#include <vector>

namespace nrd
{
struct Transition
{
    uint32_t texture = 0;
    rhi::TextureState before = {};
    rhi::TextureState after = {};
};

/// Whether a use as `after` must wait for, or see, what `before` stands for.
bool needsBarrier(const rhi::TextureState& before, const rhi::TextureState& after);

/// The one state that serves two uses of a texture in the same dispatch.
rhi::TextureState combineUses(const rhi::TextureState& a, const rhi::TextureState& b);

class StateTracker
{
public:
    explicit StateTracker(uint32_t textureCount = 0); // all undefined

    const rhi::TextureState& state(uint32_t texture) const { return m_entries[texture].state; }
    void setState(uint32_t texture, const rhi::TextureState& state) { m_entries[texture].state = state; }

    /// Announces a use by the next step.
    void use(uint32_t texture, const rhi::TextureState& state);
    /// The state that the uses announced so far ask for; meaningful after use() of this texture in this step.
    const rhi::TextureState& needed(uint32_t texture) const { return m_entries[texture].needed; }
    /// Ends the step: appends its batch of transitions and takes the textures into their new states.
    void endStep(std::vector<Transition>& transitions);

private:
    struct Entry
    {
        rhi::TextureState state;
        rhi::TextureState needed;
        bool isUsed = false; // in this step
    };
    std::vector<Entry> m_entries;
    std::vector<uint32_t> m_used; // in this step; room for all from the start
};
} // namespace nrd
