#include "texture.h"
#include "checks.h"
#include "convert.h"

namespace rhi::vulkan
{
UniqueImage createImage(const Context& context, const TextureDesc& desc)
{
    auto info = vkStruct<VkImageCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO);
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = rhi::toVulkan(desc.format);
    info.extent = {desc.width, desc.height, 1};
    info.mipLevels = desc.mipCount;
    info.arrayLayers = 1;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.tiling = VK_IMAGE_TILING_OPTIMAL;
    info.usage = toVulkan(desc.usage);
    info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
    info.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    VkImage image = VK_NULL_HANDLE;
    check(context.fn.createImage(context.device, &info, context.callbacks, &image), "texture", desc.name);
    return UniqueImage(context, image);
}

MemoryRequirements memoryRequirements(const Context& context, const UniqueImage& image)
{
    VkMemoryRequirements needs = {};
    context.fn.getImageMemoryRequirements(context.device, image.get(), &needs);
    return {needs.size, needs.alignment, needs.memoryTypeBits};
}

Texture::Texture(const Context& context, const TextureDesc& desc)
    : rhi::Texture(desc), m_owned(createImage(context, desc)), m_image(m_owned.get())
{
    const MemoryRequirements needs = memoryRequirements(context, m_owned);
    m_allocation = allocateMemory(context, {{needs.size, needs.alignment, needs.memoryTypeBits},
                                            BufferMemory::Device,
                                            "texture",
                                            name(),
                                            safeName(desc.memoryTag)});
    check(context.fn.bindImageMemory(context.device, m_image, m_allocation.memory.get(), 0), "texture", name());
    context.setName(VK_OBJECT_TYPE_IMAGE, m_image, name());
}

Texture::Texture(const Context& context, const TextureDesc& desc, const Memory& memory, uint64_t offset)
    : rhi::Texture(desc), m_owned(createImage(context, desc)), m_image(m_owned.get())
{
    const MemoryRequirements needs = memoryRequirements(context, m_owned);
    checkPlacement(desc, needs, memory, offset);
    if (!(needs.memoryTypeBits & memory.memoryTypeBits()))
        throwInvalid(sentence("texture '%s': memory '%s' is of a type it cannot use", name(), memory.name()));
    check(context.fn.bindImageMemory(context.device, m_image, memory.memory(), offset), "texture", name());
    context.setName(VK_OBJECT_TYPE_IMAGE, m_image, name());
}

TextureView::TextureView(const Context& context, const Texture& texture, const TextureViewDesc& desc)
    : rhi::TextureView(texture.name(), desc)
{
    // The usage is narrowed to what the view is for: an sRGB image may be sampled though it cannot be written.
    auto usage = vkStruct<VkImageViewUsageCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_VIEW_USAGE_CREATE_INFO);
    usage.usage = desc.type == ViewType::Storage ? VK_IMAGE_USAGE_STORAGE_BIT : VK_IMAGE_USAGE_SAMPLED_BIT;
    auto info = vkStruct<VkImageViewCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO);
    info.pNext = &usage;
    info.image = texture.image();
    info.viewType = VK_IMAGE_VIEW_TYPE_2D;
    info.format = rhi::toVulkan(texture.desc().format);
    info.subresourceRange = {aspectOf(texture.desc().format), desc.mips.first, desc.mips.count, 0, 1};
    VkImageView view = VK_NULL_HANDLE;
    check(context.fn.createImageView(context.device, &info, context.callbacks, &view), "view of texture", name());
    m_view = UniqueImageView(context, view);
    context.setName(VK_OBJECT_TYPE_IMAGE_VIEW, view, name());
}
} // namespace rhi::vulkan
