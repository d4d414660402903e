// The descriptor sets of one ring slot, kept from frame to frame: one that says what is needed is bound as it is.
#pragma once
#include <rhi/device.h>
#include <vector>

namespace nrd
{
class FrameSets
{
public:
    /// `room`: for the sets of one frame. Three times that is held: what ping-pong textures make of two visits of the
    /// slot, and a frame that needs all others.
    FrameSets(rhi::Device& device, rhi::DescriptorPoolDesc room);

    /// The GPU is done with the slot's last frame. Throws rhi::Error.
    void beginFrame();
    /// Takes back what a call that failed has taken in this frame.
    void beginCall() { m_taken = m_kept; }
    void endCall() { m_kept = m_taken; }

    /// A set that no other dispatch of the frame has. `generation` of the views: sets of another one are never bound
    /// again, for a new view may have the address of an old one. Throws rhi::Error.
    const rhi::DescriptorSet& take(const rhi::Pipeline& pipeline, uint32_t set,
                                   rhi::Span<const rhi::DescriptorWrite> writes, uint64_t generation);

private:
    struct Entry
    {
        const rhi::Pipeline* pipeline = nullptr;
        rhi::DescriptorSet* set = nullptr;
        rhi::Span<const rhi::DescriptorWrite> writes; // of m_writes
        uint64_t generation = 0;
        uint64_t lastVisit = 0; // that took it
    };
    size_t findEmpty(const rhi::Pipeline& pipeline, uint32_t set);
    const rhi::DescriptorSet& takeAt(size_t index);

    uint64_t m_visit = 0; // frames that had this slot
    std::unique_ptr<rhi::DescriptorPool> m_pool;
    std::vector<Entry> m_entries;               // those taken in this frame come first
    std::vector<rhi::DescriptorWrite> m_writes; // of all entries, never more than was reserved
    size_t m_taken = 0;
    size_t m_kept = 0; // taken by calls that succeeded
};
} // namespace nrd
