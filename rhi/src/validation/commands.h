#pragma once
#include "descriptors.h"

namespace rhi::validation
{
enum class Phase : uint8_t
{
    Initial,
    Recording,
    Executable,
};

struct CommandFacts : Resource
{
    CommandFacts(const char* objectName, bool isEngines)
        : Resource("command buffer", objectName), isWrapped(isEngines),
          phase(isEngines ? Phase::Recording : Phase::Initial)
    {
    }
    bool isWrapped;
    Phase phase;
    std::shared_ptr<Recording> recording;
    std::vector<std::shared_ptr<Resource>> used;
};

class ValidCommandBuffer final : public Decorator<CommandBuffer, CommandFacts>
{
public:
    ValidCommandBuffer(Validator& validator, const DeviceLimits& limits, std::unique_ptr<CommandBuffer> inner,
                       bool isWrapped);

    void begin() override;
    void end() override;
    void bindPipeline(const Pipeline& pipeline) override;
    void bindSet(uint32_t set, const DescriptorSet& descriptorSet, Span<const uint32_t> dynamicOffsets) override;
    void dispatch(uint32_t x, uint32_t y, uint32_t z) override;
    void dispatchIndirect(const Buffer& arguments, uint64_t offset) override;
    void barriers(Span<const TextureBarrier> textures, Span<const BufferBarrier> buffers) override;
    void barrier(const MemoryBarrier& memory) override;
    void copyBufferToTexture(const TextureCopy& copy, Layout layout) override;
    void copyTextureToBuffer(const TextureCopy& copy, Layout layout) override;
    void copyTexture(const Texture& src, const Texture& dst) override;
    void copyBuffer(const BufferCopy& copy) override;
    void fillBuffer(const Buffer& buffer, uint64_t offset, uint64_t size, uint32_t value) override;
    void clearTexture(const Texture& texture, MipRange mips, const ClearColor& color, Layout layout) override;
    void resetQueries(const QueryPool& pool, uint32_t first, uint32_t count) override;
    void writeTimestamp(const QueryPool& pool, uint32_t query, Stage stage) override;
    void beginLabel(const char* text) override;
    void endLabel() override;

private:
    struct BoundSet
    {
        const ValidSet* set = nullptr;
        std::shared_ptr<SetFacts> facts;
        std::array<uint32_t, kMaxDynamicOffsets> offsets = {};
    };
    struct TextureUse
    {
        std::shared_ptr<TextureFacts> texture;
        uint32_t mip = 0;
        Use use;
    };
    struct BufferUse
    {
        std::shared_ptr<BufferFacts> buffer;
        ByteRange range;
        Use use;
    };

    // Each returns false after a report. The name of the call is noted by isReady(), for the sentences.
    bool isReady(const char* call);
    bool fail(const std::string& text) const;
    std::string where() const;
    Moment now() const { return {m_facts->recording, m_validator.completed()}; }

    std::shared_ptr<TextureFacts> find(const Texture* texture) const; // null after a report
    std::shared_ptr<BufferFacts> find(const Buffer* buffer) const;
    bool useTexture(const std::shared_ptr<TextureFacts>& texture, MipRange mips, const Use& use,
                    const std::string& user);
    bool useBuffer(const std::shared_ptr<BufferFacts>& buffer, ByteRange range, const Use& use,
                   const std::string& user);
    void touch(const std::shared_ptr<Resource>& resource);
    void commitUses();

    bool checkSets();
    bool checkBound(uint32_t set, const BoundSet& bound);
    bool useView(const BoundResource& resource, const Binding& binding, const std::string& user);
    bool useBoundBuffer(const BoundResource& resource, const Binding& binding, uint32_t dynamicOffset,
                        const std::string& user);
    bool checkOffsets(const SetFacts& facts, Span<const uint32_t> dynamicOffsets) const;
    bool checkBarrier(const TextureBarrier& barrier, size_t index, Span<const TextureBarrier> all) const;
    bool checkBarrier(const BufferBarrier& barrier) const;
    bool checkAliases(const TextureBarrier& barrier, const TextureFacts& facts) const;
    void applyBarrier(const TextureBarrier& barrier);
    bool checkCopy(const TextureCopy& copy, TextureUsage textureUsage, BufferUsage bufferUsage);
    bool checkRange(const BufferFacts& buffer, uint64_t offset, uint64_t size, BufferUsage usage) const;
    bool checkQueries(const QueryPool& pool, uint32_t first, uint32_t count) const;

    const DeviceLimits& m_limits;
    const char* m_call = "";
    const ValidPipeline* m_pipeline = nullptr;
    std::shared_ptr<PipelineFacts> m_pipelineFacts;
    std::array<BoundSet, kMaxSets> m_sets;
    std::vector<TextureUse> m_textureUses; // of the call under check, applied when all of it is right
    std::vector<BufferUse> m_bufferUses;
    uint32_t m_labelCount = 0;
};
} // namespace rhi::validation
