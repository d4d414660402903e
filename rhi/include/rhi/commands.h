// Command buffers and queries. A command buffer is used by one thread at a time. Recording reports no errors: the
// validating decorator finds misuse, and the device reports what remains on submission.
#pragma once
#include <cstdint>
#include <rhi/pipeline.h>
#include <rhi/resources.h>
#include <rhi/states.h>

namespace rhi
{
struct TextureBarrier
{
    const Texture* texture = nullptr;
    TextureState before = {};
    TextureState after = {};
    MipRange mips = {};
};

struct BufferBarrier
{
    const Buffer* buffer = nullptr; // the whole buffer
    BufferState before = {};
    BufferState after = {};
};

struct ClearColor
{
    bool isUint = false; // true for the integer formats
    float f[4] = {0.0f, 0.0f, 0.0f, 0.0f};
    uint32_t u[4] = {0, 0, 0, 0}; // signed formats: the bits
};

/// Part of a copy between a buffer (rows tightly packed) and a whole mip of a texture.
struct TextureCopy
{
    const Texture* texture = nullptr;
    uint32_t mip = 0;
    const Buffer* buffer = nullptr;
    uint64_t bufferOffset = 0; // bytes, a multiple of the texel size and of 4
};

struct BufferCopy
{
    const Buffer* src = nullptr;
    uint64_t srcOffset = 0; // bytes
    const Buffer* dst = nullptr;
    uint64_t dstOffset = 0; // bytes
    uint64_t size = 0;      // bytes, > 0
};

/// All memory at once. It orders the uses of what aliases a texture, which the texture's own barriers don't see.
struct MemoryBarrier
{
    MemoryState before = {};
    MemoryState after = {};
};

/// What dispatchIndirect() reads from its buffer.
struct DispatchArguments
{
    uint32_t x = 0;
    uint32_t y = 0;
    uint32_t z = 0;
};

struct QueryPoolDesc
{
    uint32_t count = 0; // timestamps, > 0
    const char* name = "query pool";
};

/// Timestamps. A query is reset on the GPU before it is written again.
class QueryPool : public Object
{
public:
    uint32_t count() const { return m_count; }
    /// Reads ticks of consecutive queries without waiting; false if one of them has not been written yet, and `ticks`
    /// is then unspecified.
    virtual bool read(uint32_t first, Span<uint64_t> ticks) const = 0;
    /// Nanoseconds from one tick count to a later one; the counter may have wrapped around once in between.
    virtual double nanoseconds(uint64_t begin, uint64_t end) const = 0;

protected:
    explicit QueryPool(const QueryPoolDesc& desc) : Object(desc.name), m_count(desc.count) {}

private:
    uint32_t m_count;
};

class CommandBuffer : public Object
{
public:
    /// Starts recording and drops what was recorded before. Not for wrapped buffers: those are recorded by the engine.
    virtual void begin() = 0;
    virtual void end() = 0;

    /// Sets stay bound as long as the next pipeline has equal bindings in this set and in all before it.
    virtual void bindPipeline(const Pipeline& pipeline) = 0;
    /// After bindPipeline(). One offset in bytes for each UniformBufferDynamic of the set, by binding number,
    /// a multiple of limits().uniformOffsetAlignment.
    virtual void bindSet(uint32_t set, const DescriptorSet& descriptorSet, Span<const uint32_t> dynamicOffsets) = 0;
    /// Workgroups in each dimension; 0 in any of them does nothing.
    virtual void dispatch(uint32_t x, uint32_t y, uint32_t z) = 0;
    /// Workgroup counts from a DispatchArguments at `offset` (bytes, a multiple of 4) of an Indirect buffer.
    virtual void dispatchIndirect(const Buffer& arguments, uint64_t offset) = 0;

    /// One batch: all `before` scopes happen before all `after` scopes.
    virtual void barriers(Span<const TextureBarrier> textures, Span<const BufferBarrier> buffers) = 0;
    void barrier(const TextureBarrier& texture) { barriers(Span<const TextureBarrier>(&texture, 1), {}); }
    void barrier(const BufferBarrier& buffer) { barriers({}, Span<const BufferBarrier>(&buffer, 1)); }
    virtual void barrier(const MemoryBarrier& memory) = 0;

    /// `layout` is the one the texture is in: TransferDst (TransferSrc for the source of a copy) or General.
    virtual void copyBufferToTexture(const TextureCopy& copy, Layout layout = Layout::TransferDst) = 0;
    virtual void copyTextureToBuffer(const TextureCopy& copy, Layout layout = Layout::TransferSrc) = 0;
    /// Copies mip 0 of `src` to mip 0 of `dst`, which has the same size and texel size; layouts TransferSrc,
    /// TransferDst.
    virtual void copyTexture(const Texture& src, const Texture& dst) = 0;
    virtual void copyBuffer(const BufferCopy& copy) = 0;
    /// Fills `size` bytes (a multiple of 4) at `offset` (a multiple of 4) with repetitions of `value`.
    virtual void fillBuffer(const Buffer& buffer, uint64_t offset, uint64_t size, uint32_t value) = 0;
    virtual void clearTexture(const Texture& texture, MipRange mips, const ClearColor& color,
                              Layout layout = Layout::TransferDst) = 0;

    virtual void resetQueries(const QueryPool& pool, uint32_t first, uint32_t count) = 0;
    /// Written when all commands before it have passed `stage`: Compute, Transfer or AllCommands.
    virtual void writeTimestamp(const QueryPool& pool, uint32_t query, Stage stage = Stage::AllCommands) = 0;

    /// Names a range of commands for RenderDoc, Nsight and validation messages; nothing where there are no labels.
    virtual void beginLabel(const char* text) = 0;
    virtual void endLabel() = 0;

protected:
    using Object::Object;
};
} // namespace rhi
