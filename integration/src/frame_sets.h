// The descriptor sets of one ring slot, kept from frame to frame: one that says what is needed is bound as it is.
#pragma once
#include <rhi/device.h>
#include <vector>

namespace nrd
{
class FrameSets
{
public:
    /// `room`: for the sets of one frame.
    FrameSets(rhi::Device& device, const rhi::DescriptorPoolDesc& room);

    /// The GPU is done with the slot's last frame. Throws rhi::Error.
    void beginFrame();
    /// Takes back what a call that failed has taken in this frame. Throws rhi::Error.
    void beginCall();
    void endCall() { m_kept = m_taken; }
    /// Changes when sets are taken from what was recorded with them.
    uint64_t generation() const { return m_generation; }

    /// A set that no other dispatch of the frame has. `generation` of the views: sets of another one are never bound
    /// again, for a new view may have the address of an old one. Throws rhi::Error.
    const rhi::DescriptorSet& take(const rhi::Pipeline& pipeline, uint32_t set,
                                   rhi::Span<const rhi::DescriptorWrite> writes, uint64_t generation);

private:
    struct Entry
    {
        const rhi::Pipeline* pipeline = nullptr;
        rhi::DescriptorSet* set = nullptr;
        size_t firstWrite = 0;
        size_t writeCount = 0; // 0 = nothing was written yet
        uint64_t generation = 0;
    };
    void dropIfMany();
    rhi::Span<const rhi::DescriptorWrite> writesOf(const Entry& entry) const;
    size_t findEmpty(const rhi::Pipeline& pipeline, uint32_t set);
    const rhi::DescriptorSet& takeAt(size_t index);

    size_t m_frameWriteCount; // of a frame, at most
    std::unique_ptr<rhi::DescriptorPool> m_pool;
    std::vector<Entry> m_entries; // those taken in this frame come first
    std::vector<rhi::DescriptorWrite> m_writes;
    size_t m_taken = 0;
    size_t m_kept = 0; // taken by calls that succeeded
    uint64_t m_generation = 0;
};
} // namespace nrd
