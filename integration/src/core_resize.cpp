// The part of Core that changes the resource size, and takes the history along.
#include "core.h"
#include <algorithm>

namespace nrd
{
namespace
{
bool hasHistory(const Pools& pools)
{
    for (uint32_t i = 0; i < pools.permanent().size(); i++)
        if (pools.states.state(i) != rhi::states::kUndefined) return true;
    return false;
}
} // namespace

void checkResourceSize(uint32_t width, uint32_t height)
{
    if (width == 0) throw Refusal(Result::INVALID_ARGUMENT, "resourceWidth is 0, must be at least 1");
    if (height == 0) throw Refusal(Result::INVALID_ARGUMENT, "resourceHeight is 0, must be at least 1");
}

void Core::resize(uint32_t width, uint32_t height, const NrdMemory& transientMemory)
{
    checkResourceSize(width, height);
    const bool isSameMemory = transientMemory.memory == VK_NULL_HANDLE;
    if (width == m_desc.resourceWidth && height == m_desc.resourceHeight && isSameMemory) return;
    const PoolsDesc desc = {m_name.c_str(), width, height, isSameMemory ? m_desc.transientMemory : transientMemory,
                            &m_memory};
    auto pools = std::make_unique<Pools>(m_device, desc, description());
    m_retired.reserve(4);
    // From here on nothing fails.
    pools.swap(m_pools);
    m_retired.retire(m_frame, pools->takeTransient());
    // Of several in a row, the first has the history.
    if (m_transfer && !m_transfer->isPending()) m_transfer.reset();
    if (!m_transfer && hasHistory(*pools))
        m_transfer.emplace(std::move(pools), m_frame);
    else
        m_retired.retire(m_frame, std::move(pools));
    m_views.outdate();
    m_recordings.clear();
    endDiagnosis();
    if (m_dump) m_dump->stop("Resize() was called, but a capture has one size");
    m_desc.resourceWidth = static_cast<uint16_t>(width);
    m_desc.resourceHeight = static_cast<uint16_t>(height);
    m_desc.transientMemory = desc.transientMemory;
    m_settingsFrame = 0;
}

void Core::dropHistory()
{
    m_transfer->drop(m_retired);
    if (m_frame >= m_desc.framesInFlight) m_retired.collect(m_frame - m_desc.framesInFlight);
    m_transfer.reset();
    for (DenoiserState& denoiser : m_denoisers) denoiser.isHistoryBroken = true;
}

void Core::planTransfer()
{
    m_retired.reserve(2 + m_views.size()); // planning what follows may retire views
    m_transfer->plan(m_device, m_transferPipelines, m_desc.layoutPolicy, *m_pools);
}

void Core::recordTransfer(rhi::CommandBuffer& commands)
{
    m_transfer->record(commands);
    m_transfer->finish(m_frame, m_retired);
}
} // namespace nrd
