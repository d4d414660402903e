// Constants of the dispatches: each frame in flight has its own part of one mapped buffer.
#pragma once
#include <cstdint>
#include <memory>
#include <rhi/device.h>

namespace nrd
{
struct ConstantRingDesc
{
    const char* name = "";
    uint32_t maxDataSize = 0; // bytes of one block; 0 = no constants at all
    uint32_t blocksPerFrame = 0;
    uint32_t framesInFlight = 1;
    uint32_t set = 0;     // where the pipelines expect the block, with the samplers
    uint32_t binding = 0; // in that set
    uint32_t samplerCount = 0;
};

class ConstantRing
{
public:
    ConstantRing(rhi::Device& device, const ConstantRingDesc& desc);

    /// `slot` < framesInFlight: drops what the frame that used this slot before had stored.
    void beginFrame(uint32_t slot);
    uint32_t freeBlockCount() const { return m_blocksPerFrame - m_usedBlocks; }
    /// Copies a block and returns its dynamic offset, bytes. Throws a Refusal if there is no room: data of this and
    /// of other frames is never overwritten.
    uint32_t push(const void* data, uint32_t byteSize);

    /// Takes back what was pushed since there were `freeBlockCount` free blocks.
    void rewind(uint32_t freeBlockCount) { m_usedBlocks = m_blocksPerFrame - freeBlockCount; }

    /// The one set that shows the buffer, for all frames and all pipelines that have constants.
    const rhi::DescriptorSet& descriptorSet(const rhi::Pipeline& pipeline);

private:
    uint32_t m_maxDataSize;
    uint32_t m_set;
    uint32_t m_binding;
    uint32_t m_stride; // bytes, aligned
    uint32_t m_blocksPerFrame;
    uint32_t m_framesInFlight;
    uint32_t m_slot = 0;
    uint32_t m_usedBlocks = 0;
    std::unique_ptr<rhi::Buffer> m_buffer; // null without constants
    std::unique_ptr<rhi::DescriptorPool> m_pool;
    rhi::DescriptorSet* m_descriptorSet = nullptr; // of m_pool, made with the first pipeline; never written again
};
} // namespace nrd
