#include "../checks.h"
#include "commands.h"
#include <algorithm>

namespace rhi::validation
{
class ValidDevice final : public Device
{
public:
    ValidDevice(std::unique_ptr<Device> owned, Device& inner, ValidationSink sink)
        : m_owned(std::move(owned)), m_inner(inner), m_validator(std::move(sink))
    {
    }
    ~ValidDevice() override;

    const DeviceInfo& info() const override { return m_inner.info(); }
    FormatSupport formatSupport(Format format) const override { return m_inner.formatSupport(format); }
    std::vector<MemoryReportLine> memoryReport() const override { return m_inner.memoryReport(); }
    const Device& backend() const override { return m_inner.backend(); }

    std::unique_ptr<Texture> createTexture(const TextureDesc& desc) override;
    MemoryRequirements textureMemoryRequirements(const TextureDesc& desc) override;
    std::unique_ptr<Memory> createMemory(const MemoryDesc& desc) override;
    std::unique_ptr<Texture> createPlacedTexture(const TextureDesc& desc, Memory& memory, uint64_t offset) override;
    std::unique_ptr<TextureView> createView(const Texture& texture, const TextureViewDesc& desc) override;
    std::unique_ptr<Buffer> createBuffer(const BufferDesc& desc) override;
    std::unique_ptr<Pipeline> createPipeline(const PipelineDesc& desc) override;
    std::unique_ptr<DescriptorPool> createDescriptorPool(const DescriptorPoolDesc& desc) override;
    std::unique_ptr<QueryPool> createQueryPool(const QueryPoolDesc& desc) override;
    std::unique_ptr<CommandBuffer> createCommandBuffer(const char* name) override;
    std::unique_ptr<Fence> createFence(const char* name) override;

    std::unique_ptr<Texture> wrapTexture(uint64_t handle, const TextureDesc& desc) override;
    std::unique_ptr<Buffer> wrapBuffer(uint64_t handle, const BufferDesc& desc) override;
    std::unique_ptr<Memory> wrapMemory(uint64_t handle, const MemoryDesc& desc) override;
    std::unique_ptr<CommandBuffer> wrapCommandBuffer(uint64_t handle, const char* name) override;

    void submit(Span<CommandBuffer* const> commandBuffers, Fence* fence) override;
    void waitIdle() override;

private:
    std::unique_ptr<ValidTexture> decorate(std::unique_ptr<Texture> inner);
    void requireUsable(const Object* object, const char* kind, const std::string& user) const;
    bool isSubmittable(const CommandBuffer* commandBuffer, size_t index, Span<CommandBuffer* const> all) const;
    bool isSubmittable(const Fence* fence) const;

    std::unique_ptr<Device> m_owned; // null if the inner device is borrowed
    Device& m_inner;
    Validator m_validator;
};

ValidDevice::~ValidDevice()
{
    m_validator.reportLeaks();
    if (m_validator.completed() < m_validator.lastSubmission()) m_inner.waitIdle();
    m_validator.buryAll();
}

void ValidDevice::requireUsable(const Object* object, const char* kind, const std::string& user) const
{
    if (!m_validator.isUsable(object, kind, user)) throwInvalid(user + ": the " + kind + " cannot be used");
}

std::unique_ptr<ValidTexture> ValidDevice::decorate(std::unique_ptr<Texture> inner)
{
    auto facts = std::make_shared<TextureFacts>(*inner);
    const TextureDesc desc = inner->desc();
    return std::make_unique<ValidTexture>(m_validator, std::move(inner), std::move(facts), desc);
}

std::unique_ptr<Texture> ValidDevice::createTexture(const TextureDesc& desc)
{
    return m_validator.guarded(
        [&]
        {
            checkTexture(desc, limits(), formatSupport(desc.format));
            return decorate(m_inner.createTexture(desc));
        });
}

MemoryRequirements ValidDevice::textureMemoryRequirements(const TextureDesc& desc)
{
    return m_validator.guarded(
        [&]
        {
            checkTexture(desc, limits(), formatSupport(desc.format));
            return m_inner.textureMemoryRequirements(desc);
        });
}

std::unique_ptr<Memory> ValidDevice::createMemory(const MemoryDesc& desc)
{
    return m_validator.guarded(
        [&]
        {
            checkMemory(desc);
            auto inner = m_inner.createMemory(desc);
            return std::make_unique<ValidMemory>(m_validator, std::move(inner),
                                                 std::make_shared<MemoryFacts>(safeName(desc.name)), desc);
        });
}

std::unique_ptr<Texture> ValidDevice::createPlacedTexture(const TextureDesc& desc, Memory& memory, uint64_t offset)
{
    requireUsable(&memory, "memory", sentence("texture '%s'", safeName(desc.name)));
    return m_validator.guarded(
        [&]
        {
            checkTexture(desc, limits(), formatSupport(desc.format));
            const MemoryRequirements needs = m_inner.textureMemoryRequirements(desc);
            checkPlacement(desc, needs, memory, offset);
            const auto& valid = static_cast<const ValidMemory&>(memory);
            auto texture = decorate(m_inner.createPlacedTexture(desc, valid.inner(), offset));
            texture->facts()->memory = valid.facts();
            texture->facts()->place = {offset, offset + needs.size};
            valid.facts()->textures.push_back(texture->facts().get());
            return texture;
        });
}

std::unique_ptr<TextureView> ValidDevice::createView(const Texture& texture, const TextureViewDesc& desc)
{
    requireUsable(&texture, "texture", "view");
    return m_validator.guarded(
        [&]
        {
            const TextureViewDesc resolved = checkView(texture.desc(), desc);
            const auto& valid = static_cast<const ValidTexture&>(texture);
            auto inner = m_inner.createView(valid.inner(), resolved);
            auto facts = std::make_shared<ViewFacts>(valid.facts(), resolved);
            return std::make_unique<ValidView>(m_validator, std::move(inner), std::move(facts), texture.name(),
                                               resolved);
        });
}

std::unique_ptr<Buffer> ValidDevice::createBuffer(const BufferDesc& desc)
{
    return m_validator.guarded(
        [&]
        {
            checkBuffer(desc);
            auto inner = m_inner.createBuffer(desc);
            auto facts = std::make_shared<BufferFacts>(*inner);
            return std::make_unique<ValidBuffer>(m_validator, std::move(inner), std::move(facts), desc);
        });
}

std::unique_ptr<Pipeline> ValidDevice::createPipeline(const PipelineDesc& desc)
{
    return m_validator.guarded(
        [&]
        {
            checkPipeline(desc, limits());
            auto inner = m_inner.createPipeline(desc);
            return std::make_unique<ValidPipeline>(m_validator, std::move(inner), std::make_shared<PipelineFacts>(desc),
                                                   desc.name);
        });
}

std::unique_ptr<DescriptorPool> ValidDevice::createDescriptorPool(const DescriptorPoolDesc& desc)
{
    return m_validator.guarded(
        [&]
        {
            checkDescriptorPool(desc);
            auto inner = m_inner.createDescriptorPool(desc);
            return std::make_unique<ValidPool>(m_validator, limits(), std::move(inner), safeName(desc.name));
        });
}

std::unique_ptr<QueryPool> ValidDevice::createQueryPool(const QueryPoolDesc& desc)
{
    return m_validator.guarded(
        [&]
        {
            checkQueryPool(desc, limits());
            auto inner = m_inner.createQueryPool(desc);
            auto facts = std::make_shared<QueryFacts>(*inner);
            return std::make_unique<ValidQueryPool>(m_validator, std::move(inner), std::move(facts), desc);
        });
}

std::unique_ptr<CommandBuffer> ValidDevice::createCommandBuffer(const char* name)
{
    return std::make_unique<ValidCommandBuffer>(m_validator, limits(), m_inner.createCommandBuffer(name), false);
}

std::unique_ptr<Fence> ValidDevice::createFence(const char* name)
{
    auto inner = m_inner.createFence(name);
    auto facts = std::make_shared<FenceFacts>(safeName(name));
    return std::make_unique<ValidFence>(m_validator, std::move(inner), std::move(facts), name);
}

std::unique_ptr<Texture> ValidDevice::wrapTexture(uint64_t handle, const TextureDesc& desc)
{
    return m_validator.guarded(
        [&]
        {
            checkTexture(desc, limits(), formatSupport(desc.format));
            auto texture = decorate(m_inner.wrapTexture(handle, desc));
            for (MipTracker& mip : texture->facts()->mips) mip.forget();
            return texture;
        });
}

std::unique_ptr<Buffer> ValidDevice::wrapBuffer(uint64_t handle, const BufferDesc& desc)
{
    return m_validator.guarded(
        [&]
        {
            checkBuffer(desc);
            auto inner = m_inner.wrapBuffer(handle, desc);
            auto facts = std::make_shared<BufferFacts>(*inner);
            return std::make_unique<ValidBuffer>(m_validator, std::move(inner), std::move(facts), desc);
        });
}

std::unique_ptr<Memory> ValidDevice::wrapMemory(uint64_t handle, const MemoryDesc& desc)
{
    return m_validator.guarded(
        [&]
        {
            checkWrappedMemory(handle, desc);
            auto inner = m_inner.wrapMemory(handle, desc);
            auto facts = std::make_shared<MemoryFacts>(safeName(desc.name));
            return std::make_unique<ValidMemory>(m_validator, std::move(inner), std::move(facts), desc);
        });
}

std::unique_ptr<CommandBuffer> ValidDevice::wrapCommandBuffer(uint64_t handle, const char* name)
{
    return m_validator.guarded(
        [&]
        {
            auto inner = m_inner.wrapCommandBuffer(handle, name);
            return std::make_unique<ValidCommandBuffer>(m_validator, limits(), std::move(inner), true);
        });
}

bool ValidDevice::isSubmittable(const CommandBuffer* commandBuffer, size_t index, Span<CommandBuffer* const> all) const
{
    if (!m_validator.isUsable(commandBuffer, "command buffer", "submit()")) return false;
    const CommandFacts& facts = *static_cast<const ValidCommandBuffer*>(commandBuffer)->facts();
    std::string error;
    if (facts.isWrapped)
        error = " is wrapped, and the engine submits it";
    else if (facts.phase != Phase::Executable)
        error = facts.phase == Phase::Recording ? " was not ended" : " was not recorded";
    else if (m_validator.isPending(facts))
        error = " is pending already";
    for (const auto& resource : facts.used)
        if (error.empty() && !resource->isAlive) error = " uses " + resource->text() + ", which was destroyed";
    for (size_t i = 0; i < index; i++)
        if (all[i] == commandBuffer) error = " is in the submission twice";
    if (!error.empty()) m_validator.report("submit(): " + facts.text() + error);
    return error.empty();
}

bool ValidDevice::isSubmittable(const Fence* fence) const
{
    if (!fence) return true;
    if (!m_validator.isUsable(fence, "fence", "submit()")) return false;
    const FenceFacts& facts = *static_cast<const ValidFence*>(fence)->facts();
    if (facts.isSubmitted) m_validator.report("submit(): " + facts.text() + " was not reset since its last submission");
    return !facts.isSubmitted;
}

void ValidDevice::submit(Span<CommandBuffer* const> commandBuffers, Fence* fence)
{
    for (size_t i = 0; i < commandBuffers.size(); i++)
        if (!isSubmittable(commandBuffers[i], i, commandBuffers)) return;
    if (!isSubmittable(fence)) return;
    std::vector<CommandBuffer*> inner;
    for (const CommandBuffer* commandBuffer : commandBuffers)
        inner.push_back(&static_cast<const ValidCommandBuffer*>(commandBuffer)->inner());
    auto* validFence = static_cast<ValidFence*>(fence);
    m_inner.submit(inner, validFence ? &validFence->inner() : nullptr);

    const uint64_t submission = m_validator.nextSubmission();
    for (const CommandBuffer* commandBuffer : commandBuffers)
    {
        CommandFacts& facts = *static_cast<const ValidCommandBuffer*>(commandBuffer)->facts();
        facts.lastSubmission = submission;
        facts.recording->submission = submission;
        for (const auto& resource : facts.used) resource->lastSubmission = submission;
    }
    if (!validFence) return;
    validFence->facts()->lastSubmission = submission;
    validFence->facts()->isSubmitted = true;
}

void ValidDevice::waitIdle()
{
    m_inner.waitIdle();
    m_validator.complete(m_validator.lastSubmission());
}
} // namespace rhi::validation

namespace rhi
{
std::unique_ptr<Device> makeValidatingDevice(std::unique_ptr<Device> device, ValidationSink sink)
{
    if (!device) throwInvalid("the device to validate is null");
    Device& inner = *device;
    return std::make_unique<validation::ValidDevice>(std::move(device), inner, std::move(sink));
}

std::unique_ptr<Device> makeValidatingDevice(Device& device, ValidationSink sink)
{
    return std::make_unique<validation::ValidDevice>(nullptr, device, std::move(sink));
}
} // namespace rhi
