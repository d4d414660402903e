#include "frame_sets.h"
#include <algorithm>
#include <utility>

namespace nrd
{
namespace
{
// Kept for two frames, between which ping-pong textures change places.
constexpr size_t kKeptFrames = 2;

size_t writeCountOf(const rhi::DescriptorPoolDesc& room)
{
    return size_t{room.sampledTextures} + room.storageTextures + room.storageBuffers;
}

// Of each kind as much as all kinds together take, since what is kept may be of one kind.
rhi::DescriptorPoolDesc roomFor(const rhi::DescriptorPoolDesc& frame)
{
    rhi::DescriptorPoolDesc result = frame;
    result.sets = std::max(static_cast<uint32_t>((kKeptFrames + 1) * writeCountOf(frame)), frame.sets);
    for (uint32_t* room : {&result.sampledTextures, &result.storageTextures, &result.storageBuffers})
        if (*room > 0) *room = result.sets;
    return result;
}

bool isSame(const rhi::DescriptorWrite& a, const rhi::DescriptorWrite& b)
{
    return a.binding == b.binding && a.view == b.view && a.layout == b.layout && a.buffer == b.buffer &&
           a.offset == b.offset && a.size == b.size;
}
} // namespace

FrameSets::FrameSets(rhi::Device& device, const rhi::DescriptorPoolDesc& room)
    : m_frameWriteCount(writeCountOf(room)), m_pool(device.createDescriptorPool(roomFor(room)))
{
    m_entries.reserve((kKeptFrames + 1) * m_frameWriteCount);
    m_writes.reserve((kKeptFrames + 1) * m_frameWriteCount);
}

void FrameSets::beginFrame()
{
    dropIfMany();
    m_taken = m_kept = 0;
}

void FrameSets::beginCall()
{
    if (m_kept == 0) dropIfMany(); // else calls of this frame have recorded sets
    m_taken = m_kept;
}

void FrameSets::dropIfMany()
{
    if (m_writes.size() <= kKeptFrames * m_frameWriteCount) return;
    m_generation++;
    m_pool->reset();
    m_entries.clear();
    m_writes.clear();
}

rhi::Span<const rhi::DescriptorWrite> FrameSets::writesOf(const Entry& entry) const
{
    return {m_writes.data() + entry.firstWrite, entry.writeCount};
}

const rhi::DescriptorSet& FrameSets::take(const rhi::Pipeline& pipeline, uint32_t set,
                                          rhi::Span<const rhi::DescriptorWrite> writes, uint64_t generation)
{
    for (size_t i = m_taken; i < m_entries.size(); i++)
    {
        const Entry& entry = m_entries[i];
        const rhi::Span<const rhi::DescriptorWrite> own = writesOf(entry);
        if (entry.pipeline == &pipeline && entry.generation == generation &&
            std::equal(own.begin(), own.end(), writes.begin(), writes.end(), isSame))
            return takeAt(i);
    }
    const size_t index = findEmpty(pipeline, set);
    const size_t first = m_writes.size();
    m_writes.reserve(first + writes.size()); // there is room, unless calls of one frame fail again and again
    m_entries[index].set->write(writes);
    m_writes.insert(m_writes.end(), writes.begin(), writes.end());
    m_entries[index] = {&pipeline, m_entries[index].set, first, writes.size(), generation};
    return takeAt(index);
}

// One that a call left which failed before it was written, or a new one.
size_t FrameSets::findEmpty(const rhi::Pipeline& pipeline, uint32_t set)
{
    for (size_t i = m_taken; i < m_entries.size(); i++)
        if (m_entries[i].pipeline == &pipeline && m_entries[i].writeCount == 0) return i;
    m_entries.reserve(m_entries.size() + 1); // before there is a set to lose
    m_entries.push_back({&pipeline, &m_pool->allocate(pipeline, set), 0, 0, 0});
    return m_entries.size() - 1;
}

const rhi::DescriptorSet& FrameSets::takeAt(size_t index)
{
    std::swap(m_entries[index], m_entries[m_taken]);
    return *m_entries[m_taken++].set;
}
} // namespace nrd
