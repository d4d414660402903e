#include "tracker.h"
#include "../checks.h"
#include <algorithm>

namespace rhi::validation
{
namespace
{
constexpr Access kWrites = Access::StorageWrite | Access::TransferWrite | Access::HostWrite | Access::MemoryWrite;

bool coversAccess(Access granted, Access needed)
{
    const uint32_t writes = static_cast<uint32_t>(kWrites);
    uint32_t bits = static_cast<uint32_t>(granted);
    if (hasAny(granted, Access::MemoryWrite)) bits |= writes;
    if (hasAny(granted, Access::MemoryRead)) bits |= ~writes;
    return (static_cast<uint32_t>(needed) & ~bits) == 0;
}

bool coversStages(Stage granted, Stage needed)
{
    return hasAny(granted, Stage::AllCommands) || hasAll(granted, needed);
}

bool isOver(const std::shared_ptr<const Recording>& user, const Moment& now)
{
    return !user || user->isDropped || (user->submission != 0 && user->submission <= now.completed);
}

template <class E> std::string joinNames(E value, std::initializer_list<std::pair<E, const char*>> rows)
{
    std::string text;
    for (const auto& [bit, name] : rows)
    {
        if (!hasAny(value, bit)) continue;
        if (!text.empty()) text += '|';
        text += name;
    }
    return text.empty() ? "None" : text;
}
} // namespace

std::string describe(Access access)
{
    return joinNames<Access>(access, {{Access::UniformRead, "UniformRead"},
                                      {Access::SampledRead, "SampledRead"},
                                      {Access::StorageRead, "StorageRead"},
                                      {Access::StorageWrite, "StorageWrite"},
                                      {Access::IndirectRead, "IndirectRead"},
                                      {Access::TransferRead, "TransferRead"},
                                      {Access::TransferWrite, "TransferWrite"},
                                      {Access::HostRead, "HostRead"},
                                      {Access::HostWrite, "HostWrite"},
                                      {Access::MemoryRead, "MemoryRead"},
                                      {Access::MemoryWrite, "MemoryWrite"}});
}

std::string describe(Stage stages)
{
    return joinNames<Stage>(stages, {{Stage::Compute, "Compute"},
                                     {Stage::Transfer, "Transfer"},
                                     {Stage::Indirect, "Indirect"},
                                     {Stage::Host, "Host"},
                                     {Stage::AllCommands, "AllCommands"}});
}

const char* describe(Layout layout)
{
    switch (layout)
    {
    case Layout::Undefined:
        return "Undefined";
    case Layout::General:
        return "General";
    case Layout::ShaderReadOnly:
        return "ShaderReadOnly";
    case Layout::TransferSrc:
        return "TransferSrc";
    case Layout::TransferDst:
        return "TransferDst";
    case Layout::Native:
        return "Native";
    }
    return "unknown";
}

std::string describe(const TextureState& state)
{
    if (state.layout == Layout::Native) return sentence("native layout %u", state.native.layout);
    return sentence("{%s, %s, %s}", describe(state.access).c_str(), describe(state.layout),
                    describe(state.stages).c_str());
}

std::string describe(const BufferState& state)
{
    return sentence("{%s, %s}", describe(state.access).c_str(), describe(state.stages).c_str());
}

void MipTracker::discard()
{
    m_isKnown = true;
    m_state = {};
    m_usedStages = Stage::None;
    m_isWritten = false;
    m_user = nullptr;
}

bool MipTracker::isStale(const Moment& now) const { return isOver(m_user, now); }

Stage MipTracker::usedStages(const Moment& now) const { return isStale(now) ? Stage::None : m_usedStages; }

std::string MipTracker::findError(const Use& use, const Moment& now) const
{
    if (!m_isKnown) return "";
    if (m_state.layout != use.layout)
        return sentence("is in layout %s but %s is needed", describe(m_state.layout), describe(use.layout));
    if (!coversAccess(m_state.access, use.access) || !coversStages(m_state.stages, use.stage))
        return sentence("is in state %s but %s at %s is needed", describe(m_state).c_str(),
                        describe(use.access).c_str(), describe(use.stage).c_str());
    if (isStale(now)) return "";
    if (m_isWritten) return "was written since its last barrier";
    if (use.isWrite && m_usedStages != Stage::None) return "was read since its last barrier";
    return "";
}

void MipTracker::apply(const Use& use, const Moment& now)
{
    if (isStale(now))
    {
        m_usedStages = Stage::None;
        m_isWritten = false;
    }
    if (!m_isKnown) m_state = {use.access, use.layout, use.stage, {}};
    m_isKnown = true;
    m_usedStages |= use.stage;
    m_isWritten = m_isWritten || use.isWrite;
    m_user = now.recording;
}

std::string MipTracker::findError(const TextureState& before, const Moment& now) const
{
    const Stage used = usedStages(now);
    if (before.layout == Layout::Undefined)
    {
        if (coversStages(before.stages, used)) return "";
        return sentence("drops its contents without waiting for its use at %s", describe(used).c_str());
    }
    if (!m_isKnown) return "";
    const bool isNative = before.layout == Layout::Native;
    const bool isSame = isNative ? before == m_state
                                 : before.layout == m_state.layout && coversAccess(before.access, m_state.access) &&
                                       coversStages(before.stages, m_state.stages);
    if (isSame) return "";
    return sentence("says %s but the state is %s", describe(before).c_str(), describe(m_state).c_str());
}

void MipTracker::apply(const TextureState& after)
{
    discard();
    m_state = after;
}

std::string BufferTracker::findError(const Use& use, ByteRange range, const Moment& now) const
{
    if (m_isKnown && (!coversAccess(m_state.access, use.access) || !coversStages(m_state.stages, use.stage)))
        return sentence("is in state %s but %s at %s is needed", describe(m_state).c_str(),
                        describe(use.access).c_str(), describe(use.stage).c_str());
    for (const Entry& entry : m_uses)
    {
        const bool isConflict = entry.use.isWrite || use.isWrite;
        if (!isConflict || range.begin >= entry.range.end || entry.range.begin >= range.end) continue;
        if (isOver(entry.user, now)) continue;
        return entry.use.isWrite ? "was written since its last barrier" : "was read since its last barrier";
    }
    return "";
}

void BufferTracker::apply(const Use& use, ByteRange range, const Moment& now)
{
    std::erase_if(m_uses, [&](const Entry& entry) { return isOver(entry.user, now); });
    for (Entry& entry : m_uses) // touching ranges of the same kind grow together, or rings would never end
    {
        const bool isSame = entry.use.isWrite == use.isWrite && entry.use.stage == use.stage;
        if (!isSame || range.begin > entry.range.end || entry.range.begin > range.end) continue;
        entry.range = {std::min(range.begin, entry.range.begin), std::max(range.end, entry.range.end)};
        entry.use.access |= use.access;
        entry.user = now.recording;
        return;
    }
    m_uses.push_back({use, range, now.recording});
}

std::string BufferTracker::findError(const BufferState& before, const Moment& now) const
{
    BufferState needed;
    if (m_isKnown) needed = m_state;
    for (const Entry& entry : m_uses)
    {
        if (isOver(entry.user, now)) continue;
        needed.access |= entry.use.access;
        needed.stages |= entry.use.stage;
    }
    if (coversAccess(before.access, needed.access) && coversStages(before.stages, needed.stages)) return "";
    return sentence("says %s but the state is %s", describe(before).c_str(), describe(needed).c_str());
}

void BufferTracker::apply(const BufferState& after)
{
    m_isKnown = true;
    m_state = after;
    m_uses.clear();
}
} // namespace rhi::validation
