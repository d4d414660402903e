#include "engine/resources.h"

namespace engine
{
namespace
{
uint64_t toObject(VkImage image) { return reinterpret_cast<uint64_t>(image); }
uint64_t toObject(VkBuffer buffer) { return reinterpret_cast<uint64_t>(buffer); }

UniqueMemory allocate(const Device& device, const VkMemoryRequirements& needs, VkMemoryPropertyFlags flags,
                      const std::string& name)
{
    auto info = describe<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
    info.allocationSize = needs.size;
    info.memoryTypeIndex = device.findMemoryType(needs.memoryTypeBits, flags);
    VkDeviceMemory memory = VK_NULL_HANDLE;
    check(vkAllocateMemory(device.handle(), &info, nullptr, &memory),
          "allocate " + std::to_string(needs.size) + " bytes for '" + name + "'");
    return {device.handle(), memory};
}

UniqueImage createImage(const Device& device, const ImageDesc& desc)
{
    auto info = describe<VkImageCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO);
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = desc.format;
    info.extent = {desc.width, desc.height, 1};
    info.mipLevels = 1;
    info.arrayLayers = 1;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.tiling = VK_IMAGE_TILING_OPTIMAL;
    info.usage = desc.usage;
    VkImage image = VK_NULL_HANDLE;
    check(vkCreateImage(device.handle(), &info, nullptr, &image), "create image '" + desc.name + "'");
    return {device.handle(), image};
}

UniqueImageView createView(const Device& device, VkImage image, const ImageDesc& desc)
{
    auto info = describe<VkImageViewCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO);
    info.image = image;
    info.viewType = VK_IMAGE_VIEW_TYPE_2D;
    info.format = desc.format;
    info.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    VkImageView view = VK_NULL_HANDLE;
    check(vkCreateImageView(device.handle(), &info, nullptr, &view), "create a view of image '" + desc.name + "'");
    return {device.handle(), view};
}
} // namespace

uint32_t texelByteSize(VkFormat format)
{
    switch (format)
    {
    case VK_FORMAT_R8_UNORM:
        return 1;
    case VK_FORMAT_R16_SFLOAT:
    case VK_FORMAT_R8G8_UNORM:
        return 2;
    case VK_FORMAT_R32_SFLOAT:
    case VK_FORMAT_R32_UINT:
    case VK_FORMAT_R16G16_SFLOAT:
    case VK_FORMAT_R8G8B8A8_UNORM:
    case VK_FORMAT_R8G8B8A8_SNORM:
    case VK_FORMAT_A2B10G10R10_UNORM_PACK32:
    case VK_FORMAT_B10G11R11_UFLOAT_PACK32:
        return 4;
    case VK_FORMAT_R32G32_SFLOAT:
    case VK_FORMAT_R16G16B16A16_UNORM:
    case VK_FORMAT_R16G16B16A16_SNORM:
    case VK_FORMAT_R16G16B16A16_SFLOAT:
        return 8;
    case VK_FORMAT_R32G32B32A32_SFLOAT:
        return 16;
    default:
        throw Error("VkFormat " + std::to_string(static_cast<int>(format)) + " is not one the sample uses");
    }
}

Image::Image(const Device& device, const ImageDesc& desc) : m_desc(desc)
{
    if (desc.width == 0 || desc.height == 0) throw Error("image '" + desc.name + "' has no pixels");
    m_image = createImage(device, desc);
    device.setName(VK_OBJECT_TYPE_IMAGE, toObject(m_image.get()), desc.name);
    VkMemoryRequirements needs = {};
    vkGetImageMemoryRequirements(device.handle(), m_image.get(), &needs);
    m_memory = allocate(device, needs, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, desc.name);
    check(vkBindImageMemory(device.handle(), m_image.get(), m_memory.get(), 0), "bind image '" + desc.name + "'");
    m_view = createView(device, m_image.get(), desc);
}

VkDeviceSize Image::byteSize() const
{
    return VkDeviceSize(m_desc.width) * m_desc.height * texelByteSize(m_desc.format);
}

Buffer::Buffer(const Device& device, const BufferDesc& desc) : m_desc(desc)
{
    if (desc.byteSize == 0) throw Error("buffer '" + desc.name + "' has no bytes");
    auto info = describe<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
    info.size = desc.byteSize;
    info.usage = desc.usage | VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    VkBuffer buffer = VK_NULL_HANDLE;
    check(vkCreateBuffer(device.handle(), &info, nullptr, &buffer), "create buffer '" + desc.name + "'");
    m_buffer = {device.handle(), buffer};
    device.setName(VK_OBJECT_TYPE_BUFFER, toObject(buffer), desc.name);
    VkMemoryRequirements needs = {};
    vkGetBufferMemoryRequirements(device.handle(), buffer, &needs);
    const VkMemoryPropertyFlags flags = desc.isHostVisible
                                            ? VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT
                                            : VkMemoryPropertyFlags(VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    m_memory = allocate(device, needs, flags, desc.name);
    check(vkBindBufferMemory(device.handle(), buffer, m_memory.get(), 0), "bind buffer '" + desc.name + "'");
    if (desc.isHostVisible)
    {
        void* data = nullptr;
        check(vkMapMemory(device.handle(), m_memory.get(), 0, VK_WHOLE_SIZE, 0, &data), "map '" + desc.name + "'");
        m_mapped = static_cast<std::byte*>(data);
    }
    if (desc.texelFormat == VK_FORMAT_UNDEFINED) return;
    auto view = describe<VkBufferViewCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO);
    view.buffer = buffer;
    view.format = desc.texelFormat;
    view.range = VK_WHOLE_SIZE;
    VkBufferView texelView = VK_NULL_HANDLE;
    check(vkCreateBufferView(device.handle(), &view, nullptr, &texelView), "create a view of '" + desc.name + "'");
    m_texelView = {device.handle(), texelView};
}

void transition(VkCommandBuffer cmd, Image& image, const ImageState& next)
{
    const ImageState& last = image.state;
    constexpr VkAccessFlags kWrites = VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT;
    const bool isReadAfterRead = !(last.access & kWrites) && !(next.access & kWrites);
    if (last.layout == next.layout && isReadAfterRead && last.stage == next.stage) return;
    auto barrier = describe<VkImageMemoryBarrier>(VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER);
    barrier.srcAccessMask = last.access & kWrites;
    barrier.dstAccessMask = next.access;
    barrier.oldLayout = last.layout;
    barrier.newLayout = next.layout;
    barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image.handle();
    barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    vkCmdPipelineBarrier(cmd, last.stage, next.stage, 0, 0, nullptr, 0, nullptr, 1, &barrier);
    image.state = next;
}

void memoryBarrier(VkCommandBuffer cmd)
{
    constexpr VkPipelineStageFlags kWork = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT;
    auto barrier = describe<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
    barrier.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_UNIFORM_READ_BIT |
                            VK_ACCESS_TRANSFER_READ_BIT | VK_ACCESS_TRANSFER_WRITE_BIT | VK_ACCESS_HOST_READ_BIT;
    vkCmdPipelineBarrier(cmd, kWork, kWork | VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &barrier, 0, nullptr, 0, nullptr);
}
} // namespace engine
