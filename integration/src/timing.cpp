#include "timing.h"
#include "refusal.h"

namespace nrd
{
FrameTimer::FrameTimer(rhi::Device& device, const char* name, uint32_t passesPerFrame, uint32_t framesInFlight)
{
    if (passesPerFrame == 0 || device.limits().timestampValidBits == 0) return;
    m_capacity = passesPerFrame * 2; // a call has one more than passes, and at least one pass
    m_ticks.resize(m_capacity);
    m_passes.reserve(passesPerFrame);
    m_slots.resize(framesInFlight);
    for (Slot& slot : m_slots)
    {
        const std::string queryName = sentence("%s timestamps", name);
        slot.queries = device.createQueryPool({m_capacity, queryName.c_str()});
        slot.marks.reserve(m_capacity);
    }
}

void FrameTimer::beginFrame(uint64_t frame, uint32_t slot)
{
    if (m_slots.empty()) return;
    m_current = &m_slots[slot];
    m_current->marks.clear();
    m_current->frame = frame;
}

void FrameTimer::collect(uint32_t slotIndex)
{
    if (m_slots.empty() || m_slots[slotIndex].marks.empty()) return;
    const Slot& slot = m_slots[slotIndex];
    const rhi::Span<uint64_t> ticks(m_ticks.data(), slot.marks.size());
    if (!slot.queries->read(0, ticks)) return; // a command buffer that was never submitted
    m_passes.clear();
    m_frame = slot.frame;
    m_total = 0.0f;
    for (size_t i = 1; i < slot.marks.size(); i++)
    {
        if (!slot.marks[i].name) continue;
        const float milliseconds = static_cast<float>(slot.queries->nanoseconds(ticks[i - 1], ticks[i]) * 1e-6);
        m_passes.push_back({slot.marks[i].name, milliseconds});
        m_total += milliseconds;
    }
}

void FrameTimer::beginCall(rhi::CommandBuffer& commands, uint32_t passCount)
{
    m_isCallTimed = m_current && m_current->marks.size() + passCount + 1 <= m_capacity;
    if (!m_isCallTimed) return;
    const uint32_t first = static_cast<uint32_t>(m_current->marks.size());
    commands.resetQueries(*m_current->queries, first, passCount + 1);
    commands.writeTimestamp(*m_current->queries, first);
    m_current->marks.push_back({nullptr});
}

void FrameTimer::endPass(rhi::CommandBuffer& commands, const char* name)
{
    if (!m_isCallTimed) return;
    commands.writeTimestamp(*m_current->queries, static_cast<uint32_t>(m_current->marks.size()));
    m_current->marks.push_back({name});
}

Timings FrameTimer::timings() const
{
    return {m_frame, m_passes.data(), static_cast<uint32_t>(m_passes.size()), m_total};
}
} // namespace nrd
