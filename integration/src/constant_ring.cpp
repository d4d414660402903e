#include "constant_ring.h"
#include "pools.h"
#include "refusal.h"
#include <cstring>
#include <limits>

namespace nrd
{
ConstantRing::ConstantRing(rhi::Device& device, const ConstantRingDesc& desc)
    : m_maxDataSize(desc.maxDataSize), m_set(desc.set), m_binding(desc.binding), m_blocksPerFrame(desc.blocksPerFrame),
      m_framesInFlight(desc.framesInFlight)
{
    const uint32_t alignment = device.limits().uniformOffsetAlignment;
    m_stride = (desc.maxDataSize + alignment - 1) / alignment * alignment;
    const uint64_t size = uint64_t(m_stride) * m_blocksPerFrame * m_framesInFlight;
    if (size == 0) return;
    if (size > std::numeric_limits<uint32_t>::max()) // dynamic offsets have 32 bits
        throw Refusal(Result::INVALID_ARGUMENT,
                      sentence("framesInFlight and maxDenoiseCallsPerFrame ask for %llu bytes of constants, more than "
                               "the 4 GiB there can be",
                               static_cast<unsigned long long>(size)));
    const std::string tag = memoryTag(desc.name, "constants");
    m_buffer =
        device.createBuffer({size, rhi::BufferUsage::Uniform, rhi::BufferMemory::Upload, tag.c_str(), tag.c_str()});
    rhi::DescriptorPoolDesc pool;
    pool.sets = 1;
    pool.uniformBuffersDynamic = 1;
    pool.samplers = desc.samplerCount;
    pool.name = tag.c_str();
    m_pool = device.createDescriptorPool(pool);
}

const rhi::DescriptorSet& ConstantRing::descriptorSet(const rhi::Pipeline& pipeline)
{
    if (m_descriptorSet) return *m_descriptorSet;
    m_pool->reset(); // an attempt that failed half-way may have kept the room
    rhi::DescriptorSet& set = m_pool->allocate(pipeline, m_set);
    rhi::DescriptorWrite write;
    write.binding = m_binding;
    write.buffer = m_buffer.get();
    write.size = m_maxDataSize;
    set.write({write});
    m_descriptorSet = &set;
    return set;
}

void ConstantRing::beginFrame(uint32_t slot)
{
    m_slot = slot;
    m_usedBlocks = 0;
}

uint32_t ConstantRing::push(const void* data, uint32_t byteSize)
{
    if (byteSize > m_maxDataSize)
        throw Refusal(Result::FAILURE, sentence("a dispatch has %u bytes of constants, but the instance announced at "
                                                "most %u",
                                                byteSize, m_maxDataSize));
    if (freeBlockCount() == 0)
        throw Refusal(Result::FAILURE,
                      sentence("this frame's %u blocks of constants are used up: raise maxDenoiseCallsPerFrame",
                               m_blocksPerFrame));
    const uint32_t offset = (m_slot * m_blocksPerFrame + m_usedBlocks) * m_stride;
    std::memcpy(static_cast<uint8_t*>(m_buffer->mapped()) + offset, data, byteSize);
    m_usedBlocks++;
    return offset;
}
} // namespace nrd
