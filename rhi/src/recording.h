// The objects of the recording device.
#pragma once
#include "ledger.h"
#include <rhi/recording.h>

namespace rhi::recording
{
/// What all objects of one device share; they append to it.
struct Journal
{
    std::vector<RecordedCall> calls;
    uint32_t objectCount = 0;
    uint64_t lastHandle = 0;
    uint64_t ticks = 0;
    uint32_t failAt = 0; // creations until the failure, 0 = none
    ErrorCode failCode = ErrorCode::Failure;
    MemoryLedger ledger;

    RecordedCall& add(CallType type, const char* name);
    /// Throws if this is the creation that was to fail; otherwise records it.
    RecordedCall& create(CallType type, const char* name);
};

/// Notes the end of an object's life, and gives it a number as its native handle.
class Alive
{
public:
    Alive(Journal& journal, std::string name);
    Alive(const Alive&) = delete;
    Alive& operator=(const Alive&) = delete;
    ~Alive();
    uint64_t handle() const { return m_handle; }

private:
    Journal& m_journal;
    std::string m_name;
    uint64_t m_handle;
};

/// An object with nothing but a life.
template <class Base> class Plain final : public Base
{
public:
    template <class... Arguments>
    explicit Plain(Journal& journal, Arguments&&... arguments)
        : Base(std::forward<Arguments>(arguments)...), m_alive(journal, this->name())
    {
    }
    uint64_t nativeHandle() const override { return m_alive.handle(); }

private:
    Alive m_alive;
};

class Texture final : public rhi::Texture
{
public:
    Texture(Journal& journal, const TextureDesc& desc, MemoryLedger::Entry entry, uint64_t wrapped)
        : rhi::Texture(desc), m_alive(journal, name()), m_entry(std::move(entry)), m_wrapped(wrapped)
    {
    }
    uint64_t nativeHandle() const override { return m_wrapped ? m_wrapped : m_alive.handle(); }

private:
    Alive m_alive;
    MemoryLedger::Entry m_entry;
    uint64_t m_wrapped; // the engine's handle, 0 if the texture is ours
};

class Memory final : public rhi::Memory
{
public:
    Memory(Journal& journal, const MemoryDesc& desc, MemoryLedger::Entry entry, uint64_t wrapped)
        : rhi::Memory(desc), m_alive(journal, name()), m_entry(std::move(entry)), m_wrapped(wrapped)
    {
    }
    uint64_t nativeHandle() const override { return m_wrapped ? m_wrapped : m_alive.handle(); }
    uint32_t memoryTypeBits() const override { return 1; } // there is but one type

private:
    Alive m_alive;
    MemoryLedger::Entry m_entry;
    uint64_t m_wrapped; // the engine's handle, 0 if the memory is ours
};

class Buffer final : public rhi::Buffer
{
public:
    Buffer(Journal& journal, const BufferDesc& desc, uint64_t wrapped);
    void* mapped() const override { return m_bytes.empty() ? nullptr : m_bytes.data(); }
    uint64_t nativeHandle() const override { return m_wrapped ? m_wrapped : m_alive.handle(); }

private:
    Alive m_alive;
    MemoryLedger::Entry m_entry;
    mutable std::vector<std::byte> m_bytes; // of Upload and Readback buffers
    uint64_t m_wrapped;
};

class Pipeline final : public rhi::Pipeline
{
public:
    Pipeline(Journal& journal, const PipelineDesc& desc)
        : rhi::Pipeline(desc.name), m_alive(journal, name()), m_bindings(desc.bindings.begin(), desc.bindings.end())
    {
    }
    uint64_t nativeHandle() const override { return m_alive.handle(); }
    const std::vector<BindingDesc>& bindings() const { return m_bindings; }

private:
    Alive m_alive;
    std::vector<BindingDesc> m_bindings;
};

class DescriptorSet final : public rhi::DescriptorSet
{
public:
    DescriptorSet(Journal& journal, const char* name, uint64_t handle)
        : rhi::DescriptorSet(name), m_journal(journal), m_handle(handle)
    {
    }
    void write(Span<const DescriptorWrite> writes) override;
    uint64_t nativeHandle() const override { return m_handle; }

private:
    Journal& m_journal;
    uint64_t m_handle;
};

class DescriptorPool final : public rhi::DescriptorPool
{
public:
    DescriptorPool(Journal& journal, const DescriptorPoolDesc& desc);
    rhi::DescriptorSet& allocate(const rhi::Pipeline& pipeline, uint32_t set) override;
    void reset() override;
    uint64_t nativeHandle() const override { return m_alive.handle(); }

private:
    Journal& m_journal;
    Alive m_alive;
    DescriptorPoolDesc m_capacity;
    DescriptorPoolDesc m_used;
    std::vector<std::unique_ptr<DescriptorSet>> m_sets;
};

class QueryPool final : public rhi::QueryPool
{
public:
    QueryPool(Journal& journal, const QueryPoolDesc& desc)
        : rhi::QueryPool(desc), m_journal(journal), m_alive(journal, name())
    {
    }
    bool read(uint32_t first, Span<uint64_t> ticks) const override;
    double nanoseconds(uint64_t begin, uint64_t end) const override { return static_cast<double>(end - begin); }
    uint64_t nativeHandle() const override { return m_alive.handle(); }

private:
    Journal& m_journal;
    Alive m_alive;
};

class Fence final : public rhi::Fence
{
public:
    Fence(Journal& journal, const char* name) : rhi::Fence(name), m_alive(journal, this->name()) {}
    bool isSignaled() const override { return m_isSignaled; }
    bool wait(uint64_t) override { return m_isSignaled; }
    void reset() override { m_isSignaled = false; }
    uint64_t nativeHandle() const override { return m_alive.handle(); }
    void signal() { m_isSignaled = true; }

private:
    Alive m_alive;
    bool m_isSignaled = false;
};

class CommandBuffer final : public rhi::CommandBuffer
{
public:
    CommandBuffer(Journal& journal, const char* name, uint64_t wrapped)
        : rhi::CommandBuffer(name), m_journal(journal), m_alive(journal, this->name()), m_wrapped(wrapped)
    {
    }
    uint64_t nativeHandle() const override { return m_wrapped ? m_wrapped : m_alive.handle(); }

    void begin() override;
    void end() override;
    void bindPipeline(const rhi::Pipeline& pipeline) override;
    void bindSet(uint32_t set, const rhi::DescriptorSet& descriptorSet, Span<const uint32_t> dynamicOffsets) override;
    void dispatch(uint32_t x, uint32_t y, uint32_t z) override;
    void dispatchIndirect(const rhi::Buffer& arguments, uint64_t offset) override;
    void barriers(Span<const TextureBarrier> textures, Span<const BufferBarrier> buffers) override;
    void barrier(const MemoryBarrier& memory) override;
    void copyBufferToTexture(const TextureCopy& copy, Layout layout) override;
    void copyTextureToBuffer(const TextureCopy& copy, Layout layout) override;
    void copyTexture(const rhi::Texture& src, const rhi::Texture& dst) override;
    void copyBuffer(const BufferCopy& copy) override;
    void fillBuffer(const rhi::Buffer& buffer, uint64_t offset, uint64_t size, uint32_t value) override;
    void clearTexture(const rhi::Texture& texture, MipRange mips, const ClearColor& color, Layout layout) override;
    void resetQueries(const rhi::QueryPool& pool, uint32_t first, uint32_t count) override;
    void writeTimestamp(const rhi::QueryPool& pool, uint32_t query, Stage stage) override;
    void beginLabel(const char* text) override;
    void endLabel() override;

private:
    Journal& m_journal;
    Alive m_alive;
    uint64_t m_wrapped;
};
} // namespace rhi::recording
