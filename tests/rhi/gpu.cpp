#include "gpu.h"
#include "catch.h"
#include <algorithm>
#include <cstring>

namespace rhi::test
{
void run(Device& device, const std::function<void(CommandBuffer&)>& record)
{
    const auto commands = device.createCommandBuffer("test commands");
    const auto fence = device.createFence("test fence");
    commands->begin();
    record(*commands);
    commands->end();
    CommandBuffer* const list[] = {commands.get()};
    device.submit(list, fence.get());
    REQUIRE(fence->wait());
}

std::unique_ptr<Buffer> makeBuffer(Device& device, uint64_t size, BufferUsage usage, BufferMemory memory,
                                   const char* name)
{
    BufferDesc desc;
    desc.size = size;
    desc.usage = usage;
    desc.memory = memory;
    desc.name = name;
    return device.createBuffer(desc);
}

void upload(Device& device, const Texture& texture, uint32_t mip, const Bytes& bytes, const TextureState& after)
{
    REQUIRE(bytes.size() == texture.mipByteSize(mip));
    const auto staging =
        makeBuffer(device, bytes.size(), BufferUsage::TransferSrc, BufferMemory::Upload, "test upload");
    std::memcpy(staging->mapped(), bytes.data(), bytes.size());
    run(device,
        [&](CommandBuffer& commands)
        {
            commands.barrier(TextureBarrier{&texture, states::kUndefined, states::kTransferDst, {mip, 1}});
            commands.copyBufferToTexture({&texture, mip, staging.get(), 0});
            commands.barrier(TextureBarrier{&texture, states::kTransferDst, after, {mip, 1}});
        });
}

Bytes readBack(Device& device, const Texture& texture, uint32_t mip, const TextureState& before)
{
    Bytes bytes(texture.mipByteSize(mip));
    const auto staging =
        makeBuffer(device, bytes.size(), BufferUsage::TransferDst, BufferMemory::Readback, "test readback");
    run(device,
        [&](CommandBuffer& commands)
        {
            commands.barrier(TextureBarrier{&texture, before, states::kTransferSrc, {mip, 1}});
            commands.copyTextureToBuffer({&texture, mip, staging.get(), 0});
            commands.barrier(BufferBarrier{
                staging.get(), {Access::TransferWrite, Stage::Transfer}, {Access::HostRead, Stage::Host}});
        });
    std::memcpy(bytes.data(), staging->mapped(), bytes.size());
    return bytes;
}

Span<const uint32_t> spirvOf(Shader shader)
{
    const ShaderBlob blob = shaderBlob(shader);
    return {blob.words, blob.byteSize / sizeof(uint32_t)};
}

Pass::Pass(Device& device, Shader shader, Span<const BindingDesc> bindings, Span<const SpecConstant> constants,
           const char* name)
{
    PipelineDesc desc;
    desc.spirv = spirvOf(shader);
    desc.bindings = bindings;
    desc.constants = constants;
    desc.name = name;
    m_pipeline = device.createPipeline(desc);
    m_pool = device.createDescriptorPool({4, 4, 8, 8, 8, 8, "test pool"});
    uint32_t setCount = 0;
    for (const BindingDesc& binding : bindings) setCount = std::max(setCount, binding.set + 1);
    for (uint32_t set = 0; set < setCount; set++) m_sets.push_back(&m_pool->allocate(*m_pipeline, set));
}

void Pass::bind(CommandBuffer& commands, Span<const uint32_t> dynamicOffsets) const
{
    commands.bindPipeline(*m_pipeline);
    for (uint32_t set = 0; set < m_sets.size(); set++)
        commands.bindSet(set, *m_sets[set], set == 0 ? dynamicOffsets : Span<const uint32_t>());
}

void Pass::record(CommandBuffer& commands, uint32_t x, uint32_t y, uint32_t z) const
{
    bind(commands);
    commands.dispatch(x, y, z);
}

DescriptorWrite viewAt(uint32_t binding, const TextureView& view, Layout layout)
{
    DescriptorWrite write;
    write.binding = binding;
    write.view = &view;
    write.layout = layout;
    return write;
}

DescriptorWrite bufferAt(uint32_t binding, const Buffer& buffer, uint64_t offset, uint64_t size)
{
    DescriptorWrite write;
    write.binding = binding;
    write.buffer = &buffer;
    write.offset = offset;
    write.size = size == 0 ? buffer.desc().size - offset : size;
    return write;
}
} // namespace rhi::test
