#include "recording.h"
#include "checks.h"
#include <algorithm>

namespace rhi::recording
{
namespace
{
// Close to what devices do: whole 64 KiB would hide placement mistakes, texel-exact sizes would invent precision.
constexpr uint64_t kAlignment = 256;

uint64_t textureByteSize(const TextureDesc& desc)
{
    uint64_t size = 0;
    for (uint32_t mip = 0; mip < desc.mipCount; mip++)
        size += uint64_t{std::max(desc.width >> mip, 1u)} * std::max(desc.height >> mip, 1u) *
                formatInfo(desc.format).texelSize;
    return (size + kAlignment - 1) / kAlignment * kAlignment;
}
} // namespace

class Device final : public RecordingDevice
{
public:
    explicit Device(const RecordingDeviceDesc& desc) : m_desc(desc)
    {
        m_info.name = "recording device";
        m_info.limits = desc.limits;
        m_info.hasDebugLabels = true;
    }

    const std::vector<RecordedCall>& calls() const override { return m_journal.calls; }
    void clearCalls() override { m_journal.calls.clear(); }
    void failCreation(uint32_t n, ErrorCode code) override
    {
        m_journal.failAt = n;
        m_journal.failCode = code;
    }
    uint32_t objectCount() const override { return m_journal.objectCount; }

    const DeviceInfo& info() const override { return m_info; }
    FormatSupport formatSupport(Format format) const override
    {
        const auto& none = m_desc.unsupportedFormats;
        const bool isNone =
            formatInfo(format).texelSize == 0 || std::find(none.begin(), none.end(), format) != none.end();
        return isNone ? FormatSupport::None : m_desc.defaultFormatSupport;
    }
    std::vector<MemoryReportLine> memoryReport() const override { return m_journal.ledger.report(); }

    std::unique_ptr<rhi::Texture> createTexture(const TextureDesc& desc) override
    {
        noteTexture(CallType::CreateTexture, desc);
        MemoryLedger::Entry entry(m_journal.ledger, desc.memoryTag, textureByteSize(desc));
        return std::make_unique<Texture>(m_journal, desc, std::move(entry), 0);
    }
    MemoryRequirements textureMemoryRequirements(const TextureDesc& desc) override
    {
        checkTexture(desc, limits(), formatSupport(desc.format));
        return {textureByteSize(desc), kAlignment, 1};
    }
    std::unique_ptr<rhi::Memory> createMemory(const MemoryDesc& desc) override
    {
        checkMemory(desc);
        m_journal.create(CallType::CreateMemory, desc.name).size = desc.size;
        MemoryLedger::Entry entry(m_journal.ledger, desc.memoryTag, desc.size);
        return std::make_unique<Memory>(m_journal, desc, std::move(entry), 0);
    }
    std::unique_ptr<rhi::Texture> createPlacedTexture(const TextureDesc& desc, rhi::Memory& memory,
                                                      uint64_t offset) override
    {
        checkPlacement(desc, textureMemoryRequirements(desc), memory, offset);
        RecordedCall& call = noteTexture(CallType::CreatePlacedTexture, desc);
        call.other = memory.name();
        call.offset = offset;
        call.size = textureByteSize(desc);
        return std::make_unique<Texture>(m_journal, desc, MemoryLedger::Entry(), 0);
    }
    std::unique_ptr<rhi::TextureView> createView(const rhi::Texture& texture, const TextureViewDesc& desc) override
    {
        const TextureViewDesc resolved = checkView(texture.desc(), desc);
        RecordedCall& call = m_journal.create(CallType::CreateView, texture.name());
        call.index = resolved.mips.first;
        call.size = resolved.mips.count;
        return std::make_unique<Plain<rhi::TextureView>>(m_journal, texture.name(), resolved);
    }
    std::unique_ptr<rhi::Buffer> createBuffer(const BufferDesc& desc) override
    {
        checkBuffer(desc);
        m_journal.create(CallType::CreateBuffer, desc.name).size = desc.size;
        return std::make_unique<Buffer>(m_journal, desc, 0);
    }
    std::unique_ptr<rhi::Pipeline> createPipeline(const PipelineDesc& desc) override
    {
        checkPipeline(desc, limits());
        RecordedCall& call = m_journal.create(CallType::CreatePipeline, desc.name);
        call.constants.assign(desc.constants.begin(), desc.constants.end());
        return std::make_unique<Pipeline>(m_journal, desc);
    }
    std::unique_ptr<rhi::DescriptorPool> createDescriptorPool(const DescriptorPoolDesc& desc) override
    {
        checkDescriptorPool(desc);
        m_journal.create(CallType::CreateDescriptorPool, desc.name).size = desc.sets;
        return std::make_unique<DescriptorPool>(m_journal, desc);
    }
    std::unique_ptr<rhi::QueryPool> createQueryPool(const QueryPoolDesc& desc) override
    {
        checkQueryPool(desc, limits());
        m_journal.create(CallType::CreateQueryPool, desc.name).size = desc.count;
        return std::make_unique<QueryPool>(m_journal, desc);
    }
    std::unique_ptr<rhi::CommandBuffer> createCommandBuffer(const char* name) override
    {
        m_journal.create(CallType::CreateCommandBuffer, name);
        return std::make_unique<CommandBuffer>(m_journal, name, 0);
    }
    std::unique_ptr<rhi::Fence> createFence(const char* name) override
    {
        m_journal.create(CallType::CreateFence, name);
        return std::make_unique<Fence>(m_journal, name);
    }

    std::unique_ptr<rhi::Texture> wrapTexture(uint64_t handle, const TextureDesc& desc) override
    {
        if (handle == 0) throwInvalid(sentence("texture '%s': the image to wrap is null", safeName(desc.name)));
        noteTexture(CallType::WrapTexture, desc).handle = handle;
        return std::make_unique<Texture>(m_journal, desc, MemoryLedger::Entry(), handle);
    }
    std::unique_ptr<rhi::Buffer> wrapBuffer(uint64_t handle, const BufferDesc& desc) override
    {
        if (handle == 0) throwInvalid(sentence("buffer '%s': the buffer to wrap is null", safeName(desc.name)));
        checkBuffer(desc);
        m_journal.create(CallType::WrapBuffer, desc.name).handle = handle;
        return std::make_unique<Buffer>(m_journal, desc, handle);
    }
    std::unique_ptr<rhi::Memory> wrapMemory(uint64_t handle, const MemoryDesc& desc) override
    {
        checkWrappedMemory(handle, desc);
        m_journal.create(CallType::WrapMemory, desc.name).handle = handle;
        return std::make_unique<Memory>(m_journal, desc, MemoryLedger::Entry(), handle);
    }
    std::unique_ptr<rhi::CommandBuffer> wrapCommandBuffer(uint64_t handle, const char* name) override
    {
        if (handle == 0) throwInvalid(sentence("command buffer '%s': the handle to wrap is null", safeName(name)));
        m_journal.create(CallType::WrapCommandBuffer, name).handle = handle;
        return std::make_unique<CommandBuffer>(m_journal, name, handle);
    }

    void submit(Span<rhi::CommandBuffer* const> commandBuffers, rhi::Fence* fence) override
    {
        m_journal.add(CallType::Submit, fence ? fence->name() : "").size = commandBuffers.size();
        if (fence) static_cast<Fence*>(fence)->signal();
    }
    void waitIdle() override { m_journal.add(CallType::WaitIdle, ""); }

private:
    RecordedCall& noteTexture(CallType type, const TextureDesc& desc)
    {
        checkTexture(desc, limits(), formatSupport(desc.format));
        RecordedCall& call = m_journal.create(type, desc.name);
        call.texture = desc;
        call.texture.name = call.texture.memoryTag = "";
        return call;
    }

    RecordingDeviceDesc m_desc;
    DeviceInfo m_info;
    Journal m_journal;
};
} // namespace rhi::recording

namespace rhi
{
std::unique_ptr<RecordingDevice> makeRecordingDevice(const RecordingDeviceDesc& desc)
{
    return std::make_unique<recording::Device>(desc);
}
} // namespace rhi
