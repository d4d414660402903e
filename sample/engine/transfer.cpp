#include "engine/transfer.h"

#include "engine/commands.h"

#include <cstring>

namespace engine
{
namespace
{
Buffer createStaging(const Device& device, VkDeviceSize byteSize)
{
    BufferDesc desc;
    desc.name = "staging";
    desc.byteSize = byteSize;
    desc.usage = 0;
    desc.isHostVisible = true;
    return Buffer(device, desc);
}

VkBufferImageCopy wholeImage(const Image& image)
{
    VkBufferImageCopy region = {};
    region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    region.imageExtent = {image.desc().width, image.desc().height, 1};
    return region;
}
} // namespace

void upload(const Device& device, Image& image, std::span<const std::byte> bytes)
{
    if (bytes.size() != image.byteSize())
        throw Error("upload of " + std::to_string(bytes.size()) + " bytes to image '" + image.desc().name +
                    "', which holds " + std::to_string(image.byteSize()));
    const Buffer staging = createStaging(device, bytes.size());
    std::memcpy(staging.mapped().data(), bytes.data(), bytes.size());
    submitAndWait(device,
                  [&](VkCommandBuffer cmd)
                  {
                      transition(cmd, image, kCopyTarget);
                      const VkBufferImageCopy region = wholeImage(image);
                      vkCmdCopyBufferToImage(cmd, staging.handle(), image.handle(), kCopyTarget.layout, 1, &region);
                      transition(cmd, image, kSampled);
                  });
}

void upload(const Device& device, Buffer& buffer, std::span<const std::byte> bytes)
{
    if (bytes.empty()) return;
    if (bytes.size() > buffer.byteSize())
        throw Error("upload of " + std::to_string(bytes.size()) + " bytes to buffer '" + buffer.desc().name +
                    "', which holds " + std::to_string(buffer.byteSize()));
    if (!buffer.mapped().empty())
    {
        std::memcpy(buffer.mapped().data(), bytes.data(), bytes.size());
        return;
    }
    const Buffer staging = createStaging(device, bytes.size());
    std::memcpy(staging.mapped().data(), bytes.data(), bytes.size());
    submitAndWait(device,
                  [&](VkCommandBuffer cmd)
                  {
                      const VkBufferCopy region = {0, 0, bytes.size()};
                      vkCmdCopyBuffer(cmd, staging.handle(), buffer.handle(), 1, &region);
                      memoryBarrier(cmd);
                  });
}

std::vector<std::byte> readBack(const Device& device, Image& image)
{
    const Buffer staging = createStaging(device, image.byteSize());
    const ImageState before = image.state;
    submitAndWait(device,
                  [&](VkCommandBuffer cmd)
                  {
                      transition(cmd, image, kCopySource);
                      const VkBufferImageCopy region = wholeImage(image);
                      vkCmdCopyImageToBuffer(cmd, image.handle(), kCopySource.layout, staging.handle(), 1, &region);
                      memoryBarrier(cmd);
                      if (before.layout != VK_IMAGE_LAYOUT_UNDEFINED) transition(cmd, image, before);
                  });
    const auto bytes = staging.mapped();
    return {bytes.begin(), bytes.end()};
}

std::vector<std::byte> readBack(const Device& device, const Buffer& buffer)
{
    if (!buffer.mapped().empty())
    {
        device.waitIdle();
        return {buffer.mapped().begin(), buffer.mapped().end()};
    }
    const Buffer staging = createStaging(device, buffer.byteSize());
    submitAndWait(device,
                  [&](VkCommandBuffer cmd)
                  {
                      memoryBarrier(cmd);
                      const VkBufferCopy region = {0, 0, buffer.byteSize()};
                      vkCmdCopyBuffer(cmd, buffer.handle(), staging.handle(), 1, &region);
                      memoryBarrier(cmd);
                  });
    const auto bytes = staging.mapped();
    return {bytes.begin(), bytes.end()};
}

std::vector<std::array<float, 4>> readTexels(const Device& device, const std::vector<Image*>& images, uint32_t x,
                                             uint32_t y)
{
    constexpr VkDeviceSize kTexel = sizeof(std::array<float, 4>);
    const Buffer staging = createStaging(device, images.size() * kTexel);
    std::memset(staging.mapped().data(), 0, staging.byteSize());
    submitAndWait(device,
                  [&](VkCommandBuffer cmd)
                  {
                      for (size_t i = 0; i < images.size(); ++i)
                      {
                          const ImageState before = images[i]->state;
                          transition(cmd, *images[i], kCopySource);
                          VkBufferImageCopy region = wholeImage(*images[i]);
                          region.bufferOffset = i * kTexel;
                          region.imageOffset = {int32_t(x), int32_t(y), 0};
                          region.imageExtent = {1, 1, 1};
                          vkCmdCopyImageToBuffer(cmd, images[i]->handle(), kCopySource.layout, staging.handle(), 1,
                                                 &region);
                          if (before.layout != VK_IMAGE_LAYOUT_UNDEFINED) transition(cmd, *images[i], before);
                      }
                      memoryBarrier(cmd);
                  });
    std::vector<std::array<float, 4>> texels(images.size());
    std::memcpy(texels.data(), staging.mapped().data(), staging.byteSize());
    return texels;
}

Buffer createFilled(const Device& device, BufferDesc desc, std::span<const std::byte> bytes)
{
    desc.byteSize = bytes.size();
    Buffer buffer(device, desc);
    upload(device, buffer, bytes);
    return buffer;
}
} // namespace engine
