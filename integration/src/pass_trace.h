// Where the GPU is, for the report of a lost device: each pass writes its number into mapped memory as it begins,
// behind the end of the one before.
#pragma once
#include <nrd/integration.h>
#include <rhi/device.h>
#include <vector>

namespace nrd
{
class PassTrace
{
public:
    /// Does nothing if `passesPerFrame` is 0.
    PassTrace(rhi::Device& device, const char* name, uint32_t passesPerFrame, uint32_t framesInFlight);

    void beginFrame(uint64_t frame, uint32_t slot);
    /// `name` must live until the slot comes round again.
    void beginPass(rhi::CommandBuffer& commands, const char* name);
    void endCall(rhi::CommandBuffer& commands);

    LastPass last() const;

private:
    struct Slot
    {
        uint64_t frame = 0;
        std::vector<const char*> names; // in the order of recording
    };
    void write(rhi::CommandBuffer& commands, uint32_t mark);
    uint32_t* marks() const { return static_cast<uint32_t*>(m_marks->mapped()); }

    std::unique_ptr<rhi::Buffer> m_marks; // one mark per slot; null: no trace
    std::vector<Slot> m_slots;
    uint32_t m_capacity = 0; // passes of a frame
    uint32_t m_current = 0;  // slot
};
} // namespace nrd
