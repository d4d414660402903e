#include "pass_trace.h"
#include "pools.h"

namespace nrd
{
namespace
{
// Marks: 0 = no pass of the frame has begun, then two for each pass.
uint32_t markOfBegin(size_t pass) { return static_cast<uint32_t>(2 * pass + 1); }
uint32_t markOfEnd(size_t pass) { return static_cast<uint32_t>(2 * pass + 2); }

using rhi::Access;
using rhi::Stage;
constexpr rhi::BufferState kWritten = {Access::TransferWrite, Stage::Transfer};
constexpr rhi::BufferState kPassBefore = {Access::TransferWrite | Access::HostRead,
                                          Stage::Transfer | Stage::Compute | Stage::Host};
constexpr rhi::BufferState kPassAfter = {Access::HostRead, Stage::Compute | Stage::Host};
} // namespace

PassTrace::PassTrace(rhi::Device& device, const char* name, uint32_t passesPerFrame, uint32_t framesInFlight)
    : m_capacity(passesPerFrame)
{
    if (passesPerFrame == 0) return;
    m_slots.resize(framesInFlight);
    for (Slot& slot : m_slots) slot.names.reserve(passesPerFrame);
    const std::string tag = memoryTag(name, "buffers");
    m_marks = device.createBuffer({framesInFlight * sizeof(uint32_t), rhi::BufferUsage::TransferDst,
                                   rhi::BufferMemory::Readback, tag.c_str(), tag.c_str()});
    for (uint32_t slot = 0; slot < framesInFlight; slot++) marks()[slot] = 0;
}

void PassTrace::beginFrame(uint64_t frame, uint32_t slot)
{
    if (!m_marks) return;
    m_current = slot;
    m_slots[slot].frame = frame;
    m_slots[slot].names.clear();
    marks()[slot] = 0;
}

void PassTrace::beginPass(rhi::CommandBuffer& commands, const char* name)
{
    if (!m_marks || m_slots[m_current].names.size() == m_capacity) return;
    write(commands, markOfBegin(m_slots[m_current].names.size()));
    m_slots[m_current].names.push_back(name);
}

void PassTrace::endCall(rhi::CommandBuffer& commands)
{
    if (!m_marks || m_slots[m_current].names.empty()) return;
    write(commands, markOfEnd(m_slots[m_current].names.size() - 1));
}

void PassTrace::write(rhi::CommandBuffer& commands, uint32_t mark)
{
    commands.barrier(rhi::BufferBarrier{m_marks.get(), kPassBefore, kWritten});
    commands.fillBuffer(*m_marks, m_current * sizeof(uint32_t), sizeof(uint32_t), mark);
    commands.barrier(rhi::BufferBarrier{m_marks.get(), kWritten, kPassAfter});
}

LastPass PassTrace::last() const
{
    LastPass result;
    for (uint32_t slot = 0; slot < m_slots.size(); slot++)
    {
        const Slot& traced = m_slots[slot];
        const uint32_t mark = marks()[slot];
        const uint32_t pass = (mark - 1) / 2;
        if (mark == 0 || pass >= traced.names.size() || traced.frame < result.frame) continue;
        result = {traced.frame, traced.names[pass], mark == markOfEnd(pass)};
    }
    return result;
}
} // namespace nrd
