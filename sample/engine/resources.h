// Images and buffers that own their memory, and the barriers between their uses.
#pragma once
#include "engine/device.h"
#include "engine/unique.h"

#include <cstddef>
#include <span>

namespace engine
{
/// Where and how an image was used last; what a barrier has to wait for.
struct ImageState
{
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
    VkAccessFlags access = 0;
    VkPipelineStageFlags stage = VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT;
};

constexpr ImageState kSampled = {VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_ACCESS_SHADER_READ_BIT,
                                 VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT};
constexpr ImageState kStorage = {VK_IMAGE_LAYOUT_GENERAL, VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT,
                                 VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT};
constexpr ImageState kCopySource = {VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_ACCESS_TRANSFER_READ_BIT,
                                    VK_PIPELINE_STAGE_TRANSFER_BIT};
constexpr ImageState kCopyTarget = {VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_ACCESS_TRANSFER_WRITE_BIT,
                                    VK_PIPELINE_STAGE_TRANSFER_BIT};

struct ImageDesc
{
    std::string name;    // for debuggers and errors
    uint32_t width = 0;  // pixels, > 0
    uint32_t height = 0; // pixels, > 0
    VkFormat format = VK_FORMAT_R32G32B32A32_SFLOAT;
    VkImageUsageFlags usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_STORAGE_BIT |
                              VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
};

/// Bytes of one texel of the uncompressed formats the sample uses; throws Error for others.
uint32_t texelByteSize(VkFormat format);

/// A 2D image with one mip and one layer in device memory, with its view. Remembers the state it was left in.
class Image
{
public:
    Image() = default;
    Image(const Device& device, const ImageDesc& desc);

    VkImage handle() const { return m_image.get(); }
    VkImageView view() const { return m_view.get(); }
    const ImageDesc& desc() const { return m_desc; }
    VkDeviceSize byteSize() const;

    /// The state the last recorded command leaves the image in; whoever records commands elsewhere sets it.
    ImageState state;

private:
    ImageDesc m_desc;
    UniqueMemory m_memory;
    UniqueImage m_image;
    UniqueImageView m_view;
};

struct BufferDesc
{
    std::string name;
    VkDeviceSize byteSize = 0; // > 0
    VkBufferUsageFlags usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    bool isHostVisible = false;                 // mapped and coherent for its whole life
    VkFormat texelFormat = VK_FORMAT_UNDEFINED; // with a format there is a view of the whole for texel buffers
};

/// A buffer with its memory; transfer usage both ways is always added.
class Buffer
{
public:
    Buffer() = default;
    Buffer(const Device& device, const BufferDesc& desc);

    VkBuffer handle() const { return m_buffer.get(); }
    VkBufferView texelView() const { return m_texelView.get(); } // null without texelFormat
    VkDeviceSize byteSize() const { return m_desc.byteSize; }
    const BufferDesc& desc() const { return m_desc; }

    /// The mapped bytes; empty unless isHostVisible.
    std::span<std::byte> mapped() const { return {m_mapped, m_mapped ? m_desc.byteSize : 0}; }

private:
    BufferDesc m_desc;
    UniqueMemory m_memory; // freeing unmaps
    UniqueBuffer m_buffer;
    UniqueBufferView m_texelView;
    std::byte* m_mapped = nullptr;
};

/// Records a barrier that brings `image` from the state it was left in to `next`, also between equal storage states.
void transition(VkCommandBuffer cmd, Image& image, const ImageState& next);

/// Records a barrier for all memory from any write of shaders and copies to any later use by them (and the host).
void memoryBarrier(VkCommandBuffer cmd);
} // namespace engine
