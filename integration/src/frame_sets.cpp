#include "frame_sets.h"
#include <algorithm>
#include <utility>

namespace nrd
{
namespace
{
rhi::DescriptorPoolDesc tripled(rhi::DescriptorPoolDesc desc)
{
    for (uint32_t* room : {&desc.sets, &desc.uniformBuffersDynamic, &desc.samplers, &desc.sampledTextures,
                           &desc.storageTextures, &desc.storageBuffers})
        *room *= 3;
    return desc;
}

bool isSame(const rhi::DescriptorWrite& a, const rhi::DescriptorWrite& b)
{
    return a.binding == b.binding && a.view == b.view && a.layout == b.layout && a.buffer == b.buffer &&
           a.offset == b.offset && a.size == b.size;
}
} // namespace

FrameSets::FrameSets(rhi::Device& device, rhi::DescriptorPoolDesc room)
    : m_pool(device.createDescriptorPool(tripled(room)))
{
    m_entries.reserve(3 * size_t{room.sets});
    m_writes.reserve(3 * (size_t{room.sampledTextures} + room.storageTextures + room.storageBuffers));
}

void FrameSets::beginFrame()
{
    const uint64_t visit = m_visit + 1;
    const auto isOld = [visit](const Entry& entry) { return entry.lastVisit + 2 < visit; };
    if (std::any_of(m_entries.begin(), m_entries.end(), isOld))
    {
        m_pool->reset();
        m_entries.clear();
        m_writes.clear();
    }
    m_visit = visit;
    m_taken = m_kept = 0;
}

const rhi::DescriptorSet& FrameSets::take(const rhi::Pipeline& pipeline, uint32_t set,
                                          rhi::Span<const rhi::DescriptorWrite> writes, uint64_t generation)
{
    for (size_t i = m_taken; i < m_entries.size(); i++)
    {
        const Entry& entry = m_entries[i];
        if (entry.pipeline == &pipeline && entry.generation == generation &&
            std::equal(entry.writes.begin(), entry.writes.end(), writes.begin(), writes.end(), isSame))
            return takeAt(i);
    }
    const size_t index = findEmpty(pipeline, set);
    Entry& entry = m_entries[index];
    entry.set->write(writes);
    const size_t first = m_writes.size();
    m_writes.insert(m_writes.end(), writes.begin(), writes.end());
    entry.writes = {m_writes.data() + first, writes.size()};
    entry.generation = generation;
    return takeAt(index);
}

// One that a call left which failed before it was written, or a new one.
size_t FrameSets::findEmpty(const rhi::Pipeline& pipeline, uint32_t set)
{
    for (size_t i = m_taken; i < m_entries.size(); i++)
        if (m_entries[i].pipeline == &pipeline && m_entries[i].writes.empty()) return i;
    m_entries.push_back({&pipeline, &m_pool->allocate(pipeline, set), {}, 0, m_visit}); // there is room for it
    return m_entries.size() - 1;
}

const rhi::DescriptorSet& FrameSets::takeAt(size_t index)
{
    std::swap(m_entries[index], m_entries[m_taken]);
    m_entries[m_taken].lastVisit = m_visit;
    return *m_entries[m_taken++].set;
}
} // namespace nrd
