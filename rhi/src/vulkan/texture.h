#pragma once
#include "memory.h"

namespace rhi::vulkan
{
/// An image without memory yet.
UniqueImage createImage(const Context& context, const TextureDesc& desc);
MemoryRequirements memoryRequirements(const Context& context, const UniqueImage& image);

class Texture final : public rhi::Texture
{
public:
    /// Borrows the image of an engine.
    Texture(const TextureDesc& desc, VkImage image) : rhi::Texture(desc), m_image(image) {}
    /// With memory of its own.
    Texture(const Context& context, const TextureDesc& desc);
    /// Placed in memory that outlives it.
    Texture(const Context& context, const TextureDesc& desc, const Memory& memory, uint64_t offset);

    uint64_t nativeHandle() const override { return rhi::detail::toHandle(m_image); }
    VkImage image() const { return m_image; }

private:
    Allocation m_allocation; // empty for placed and borrowed images
    UniqueImage m_owned;     // empty when the application lent us the image
    VkImage m_image = VK_NULL_HANDLE;
};

class TextureView final : public rhi::TextureView
{
public:
    TextureView(const Context& context, const Texture& texture, const TextureViewDesc& desc);
    uint64_t nativeHandle() const override { return rhi::detail::toHandle(m_view.get()); }
    VkImageView view() const { return m_view.get(); }

private:
    UniqueImageView m_view;
};
} // namespace rhi::vulkan
