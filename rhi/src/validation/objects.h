// The decorators of resources: each owns the object it stands for, and shares its facts with whoever refers to it.
#pragma once
#include "validator.h"
#include <array>

namespace rhi::validation
{
struct TextureFacts;

struct MemoryFacts : Resource
{
    explicit MemoryFacts(const char* objectName) : Resource("memory", objectName) {}
    std::vector<TextureFacts*> textures; // alive and placed in it
};

struct TextureFacts : Resource
{
    explicit TextureFacts(const Texture& texture);
    TextureDesc desc;
    std::vector<MipTracker> mips;
    uint32_t viewCount = 0;              // alive
    std::shared_ptr<MemoryFacts> memory; // of a placed texture, else null
    ByteRange place;                     // in that memory

    /// Other textures alive that share bytes with this one.
    std::vector<TextureFacts*> aliases() const;
};

struct ViewFacts : Resource
{
    ViewFacts(std::shared_ptr<TextureFacts> of, const TextureViewDesc& viewDesc)
        : Resource("view of texture", of->name.c_str()), texture(std::move(of)), desc(viewDesc)
    {
        texture->viewCount++;
    }
    std::shared_ptr<TextureFacts> texture;
    TextureViewDesc desc;
};

struct BufferFacts : Resource
{
    explicit BufferFacts(const Buffer& buffer) : Resource("buffer", buffer.name()), desc(buffer.desc()) {}
    BufferDesc desc; // its names are not to be read
    BufferTracker tracker;
};

struct Binding
{
    BindingDesc desc;        // its set is 0, so that sets of any number compare
    bool isUsed = false;     // the shader declares it; the optimiser may have removed it
    bool isReadOnly = false; // and declares it readonly
};

struct PipelineFacts : Resource
{
    explicit PipelineFacts(const PipelineDesc& desc);
    std::array<std::vector<Binding>, kMaxSets> sets; // by binding number
};
/// Whether a set made for one list of bindings serves another.
bool areCompatible(const std::vector<Binding>& a, const std::vector<Binding>& b);

struct QueryFacts : Resource
{
    explicit QueryFacts(const QueryPool& pool) : Resource("query pool", pool.name()), isReset(pool.count(), false) {}
    std::vector<bool> isReset; // and not written since
};

struct FenceFacts : Resource
{
    explicit FenceFacts(const char* objectName) : Resource("fence", objectName) {}
    bool isSubmitted = false; // since it was made or reset; lastSubmission says by which
};

/// What is wrong with destroying the object now, empty if nothing is; a pending submission is found elsewhere.
inline std::string misuseOfDestruction(const Resource&) { return ""; }
std::string misuseOfDestruction(const TextureFacts& facts);
std::string misuseOfDestruction(const MemoryFacts& facts);
inline void onDestruction(const Resource&) {}
void onDestruction(const TextureFacts& facts);
void onDestruction(const ViewFacts& facts);

/// A decorator of `Base` whose facts are `Facts`.
template <class Base, class Facts> class Decorator : public Base
{
public:
    template <class... Arguments>
    Decorator(Validator& validator, std::unique_ptr<Base> inner, std::shared_ptr<Facts> facts, Arguments&&... base)
        : Base(std::forward<Arguments>(base)...), m_validator(validator), m_inner(std::move(inner)),
          m_facts(std::move(facts))
    {
        validator.add(this, m_facts);
    }
    ~Decorator() override
    {
        const std::string misuse = misuseOfDestruction(*m_facts);
        onDestruction(*m_facts);
        m_validator.remove(this, std::move(m_inner), misuse);
    }
    uint64_t nativeHandle() const override { return m_inner->nativeHandle(); }
    Base& inner() const { return *m_inner; }
    const std::shared_ptr<Facts>& facts() const { return m_facts; }

protected:
    Validator& m_validator;
    std::unique_ptr<Base> m_inner;
    std::shared_ptr<Facts> m_facts;
};

using ValidTexture = Decorator<Texture, TextureFacts>;
using ValidView = Decorator<TextureView, ViewFacts>;
using ValidPipeline = Decorator<Pipeline, PipelineFacts>;

class ValidMemory final : public Decorator<Memory, MemoryFacts>
{
public:
    using Decorator::Decorator;
    uint32_t memoryTypeBits() const override { return m_inner->memoryTypeBits(); }
};

class ValidBuffer final : public Decorator<Buffer, BufferFacts>
{
public:
    using Decorator::Decorator;
    void* mapped() const override { return m_inner->mapped(); }
};

class ValidQueryPool final : public Decorator<QueryPool, QueryFacts>
{
public:
    using Decorator::Decorator;
    bool read(uint32_t first, Span<uint64_t> ticks) const override;
    double nanoseconds(uint64_t begin, uint64_t end) const override { return m_inner->nanoseconds(begin, end); }
};

class ValidFence final : public Decorator<Fence, FenceFacts>
{
public:
    using Decorator::Decorator;
    bool isSignaled() const override;
    bool wait(uint64_t timeout) override;
    void reset() override;
};
} // namespace rhi::validation
