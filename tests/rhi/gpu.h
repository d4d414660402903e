// Shorthands for tests: run commands and wait, fill textures, read them back, run one pass.
#pragma once
#include "nrd_rhi_test_shaders.h"
#include <functional>
#include <rhi/rhi.h>

namespace rhi::test
{
using Bytes = std::vector<std::byte>;

/// Records, submits and waits.
void run(Device& device, const std::function<void(CommandBuffer&)>& record);

std::unique_ptr<Buffer> makeBuffer(Device& device, uint64_t size, BufferUsage usage, BufferMemory memory,
                                   const char* name);
template <class T> Span<T> mappedAs(const Buffer& buffer)
{
    return {static_cast<T*>(buffer.mapped()), static_cast<size_t>(buffer.desc().size / sizeof(T))};
}

/// Fills one mip, whose contents were undefined, and leaves it in `after`.
void upload(Device& device, const Texture& texture, uint32_t mip, const Bytes& bytes, const TextureState& after);
/// Reads one mip that is in `before`, and leaves it as a transfer source.
Bytes readBack(Device& device, const Texture& texture, uint32_t mip, const TextureState& before);

Span<const uint32_t> spirvOf(Shader shader);

/// A pipeline with one pool, and one descriptor set per set number.
class Pass
{
public:
    Pass(Device& device, Shader shader, Span<const BindingDesc> bindings, Span<const SpecConstant> constants = {},
         const char* name = "pass");
    void write(uint32_t set, Span<const DescriptorWrite> writes) { m_sets.at(set)->write(writes); }
    void bind(CommandBuffer& commands, Span<const uint32_t> dynamicOffsets = {}) const; // offsets for set 0
    void record(CommandBuffer& commands, uint32_t x, uint32_t y = 1, uint32_t z = 1) const;
    const Pipeline& pipeline() const { return *m_pipeline; }
    DescriptorSet& set(uint32_t index) const { return *m_sets.at(index); }
    DescriptorPool& pool() const { return *m_pool; }

private:
    std::unique_ptr<Pipeline> m_pipeline;
    std::unique_ptr<DescriptorPool> m_pool;
    std::vector<DescriptorSet*> m_sets; // null where the pipeline has none
};

DescriptorWrite viewAt(uint32_t binding, const TextureView& view, Layout layout = Layout::ShaderReadOnly);
DescriptorWrite bufferAt(uint32_t binding, const Buffer& buffer, uint64_t offset = 0, uint64_t size = 0); // 0 = all
} // namespace rhi::test
