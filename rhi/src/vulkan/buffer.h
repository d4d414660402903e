#pragma once
#include "memory.h"

namespace rhi::vulkan
{
class Buffer final : public rhi::Buffer
{
public:
    /// Borrows the buffer of an engine.
    Buffer(const BufferDesc& desc, VkBuffer buffer) : rhi::Buffer(desc), m_buffer(buffer) {}
    Buffer(const Context& context, const BufferDesc& desc);

    void* mapped() const override { return m_mapped; }
    uint64_t nativeHandle() const override { return rhi::detail::toHandle(m_buffer); }
    VkBuffer buffer() const { return m_buffer; }

private:
    Allocation m_allocation; // unmapped by being freed
    UniqueBuffer m_owned;    // empty when the application lent us the buffer
    VkBuffer m_buffer = VK_NULL_HANDLE;
    void* m_mapped = nullptr;
};
} // namespace rhi::vulkan
