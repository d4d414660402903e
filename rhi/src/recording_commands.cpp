#include "checks.h"
#include "recording.h"

namespace rhi::recording
{
void CommandBuffer::begin()
{
    if (m_wrapped) throwInvalid(sentence("command buffer '%s': begin() on a wrapped command buffer", name()));
    m_journal.add(CallType::Begin, name());
}

void CommandBuffer::end()
{
    if (m_wrapped) throwInvalid(sentence("command buffer '%s': end() on a wrapped command buffer", name()));
    m_journal.add(CallType::End, name());
}

void CommandBuffer::bindPipeline(const rhi::Pipeline& pipeline)
{
    m_journal.add(CallType::BindPipeline, pipeline.name());
}

void CommandBuffer::bindSet(uint32_t set, const rhi::DescriptorSet& descriptorSet, Span<const uint32_t> dynamicOffsets)
{
    RecordedCall& call = m_journal.add(CallType::BindSet, descriptorSet.name());
    call.index = set;
    call.handle = descriptorSet.nativeHandle();
    call.dynamicOffsets.assign(dynamicOffsets.begin(), dynamicOffsets.end());
}

void CommandBuffer::dispatch(uint32_t x, uint32_t y, uint32_t z)
{
    if (x == 0 || y == 0 || z == 0) return;
    RecordedCall& call = m_journal.add(CallType::Dispatch, name());
    call.groups[0] = x;
    call.groups[1] = y;
    call.groups[2] = z;
}

void CommandBuffer::dispatchIndirect(const rhi::Buffer& arguments, uint64_t offset)
{
    m_journal.add(CallType::DispatchIndirect, arguments.name()).offset = offset;
}

void CommandBuffer::barriers(Span<const TextureBarrier> textures, Span<const BufferBarrier> buffers)
{
    if (textures.empty() && buffers.empty()) return;
    RecordedCall& call = m_journal.add(CallType::Barriers, name());
    for (const TextureBarrier& b : textures)
        call.barriers.push_back({b.texture->name(), true, b.before, b.after, b.mips});
    for (const BufferBarrier& b : buffers)
        call.barriers.push_back({b.buffer->name(),
                                 false,
                                 {b.before.access, Layout::Undefined, b.before.stages},
                                 {b.after.access, Layout::Undefined, b.after.stages},
                                 {}});
}

void CommandBuffer::barrier(const MemoryBarrier& memory)
{
    m_journal.add(CallType::MemoryBarrier, name()).memory = memory;
}

void CommandBuffer::copyBufferToTexture(const TextureCopy& copy, Layout)
{
    RecordedCall& call = m_journal.add(CallType::CopyBufferToTexture, copy.buffer->name());
    call.other = copy.texture->name();
    call.index = copy.mip;
    call.offset = copy.bufferOffset;
}

void CommandBuffer::copyTextureToBuffer(const TextureCopy& copy, Layout)
{
    RecordedCall& call = m_journal.add(CallType::CopyTextureToBuffer, copy.texture->name());
    call.other = copy.buffer->name();
    call.index = copy.mip;
    call.offset = copy.bufferOffset;
}

void CommandBuffer::copyTexture(const rhi::Texture& src, const rhi::Texture& dst)
{
    m_journal.add(CallType::CopyTexture, src.name()).other = dst.name();
}

void CommandBuffer::copyBuffer(const BufferCopy& copy)
{
    RecordedCall& call = m_journal.add(CallType::CopyBuffer, copy.src->name());
    call.other = copy.dst->name();
    call.offset = copy.dstOffset;
    call.size = copy.size;
}

void CommandBuffer::fillBuffer(const rhi::Buffer& buffer, uint64_t offset, uint64_t size, uint32_t value)
{
    RecordedCall& call = m_journal.add(CallType::FillBuffer, buffer.name());
    call.offset = offset;
    call.size = size;
    call.value = value;
}

void CommandBuffer::clearTexture(const rhi::Texture& texture, MipRange mips, const ClearColor& color, Layout)
{
    RecordedCall& call = m_journal.add(CallType::ClearTexture, texture.name());
    const MipRange range = resolveMips(mips, texture.desc().mipCount);
    call.index = range.first;
    call.size = range.count;
    call.clear = color;
}

void CommandBuffer::resetQueries(const rhi::QueryPool& pool, uint32_t first, uint32_t count)
{
    RecordedCall& call = m_journal.add(CallType::ResetQueries, pool.name());
    call.index = first;
    call.size = count;
}

void CommandBuffer::writeTimestamp(const rhi::QueryPool& pool, uint32_t query, Stage)
{
    m_journal.add(CallType::WriteTimestamp, pool.name()).index = query;
}

void CommandBuffer::beginLabel(const char* text) { m_journal.add(CallType::BeginLabel, text); }

void CommandBuffer::endLabel() { m_journal.add(CallType::EndLabel, name()); }
} // namespace rhi::recording
