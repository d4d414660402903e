#include "window/screen.h"

namespace window
{
namespace
{
struct Use
{
    VkImageLayout layout;
    VkAccessFlags access;
    VkPipelineStageFlags stage;
};
// The submission waits for the image at the stage of copies.
constexpr Use kAcquired = {VK_IMAGE_LAYOUT_UNDEFINED, 0, VK_PIPELINE_STAGE_TRANSFER_BIT};
constexpr Use kFilled = {VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_ACCESS_TRANSFER_WRITE_BIT,
                         VK_PIPELINE_STAGE_TRANSFER_BIT};
constexpr Use kDrawn = {VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                        VK_ACCESS_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT,
                        VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT};
constexpr Use kCopied = {VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_ACCESS_TRANSFER_READ_BIT,
                         VK_PIPELINE_STAGE_TRANSFER_BIT};
constexpr Use kPresented = {VK_IMAGE_LAYOUT_PRESENT_SRC_KHR, 0, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT};
constexpr VkImageSubresourceLayers kLayer = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
constexpr VkImageSubresourceRange kWhole = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};

void pass(VkCommandBuffer cmd, VkImage image, const Use& from, const Use& to)
{
    auto barrier = engine::describe<VkImageMemoryBarrier>(VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER);
    barrier.srcAccessMask = from.access;
    barrier.dstAccessMask = to.access;
    barrier.oldLayout = from.layout;
    barrier.newLayout = to.layout;
    barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image;
    barrier.subresourceRange = kWhole;
    vkCmdPipelineBarrier(cmd, from.stage, to.stage, 0, 0, nullptr, 0, nullptr, 1, &barrier);
}

VkOffset3D cornerOf(uint32_t width, uint32_t height) { return {int32_t(width), int32_t(height), 1}; }
} // namespace

Screen::Screen(const engine::Device& device, Window& window)
    : m_device(device), m_swapchain(device, window), m_gui(device, window, m_swapchain)
{
}

bool Screen::present(const RecordPicture& record, sample::Image* shot)
{
    const std::optional<Swapchain::Frame> frame = m_swapchain.begin();
    if (!frame)
    {
        m_gui.dropFrame();
        return false;
    }
    const VkImage image = m_swapchain.image(frame->image);
    drawPicture(*frame, record(frame->cmd, frame->slot));
    pass(frame->cmd, image, kFilled, kDrawn);
    m_gui.draw(m_swapchain, *frame);
    if (shot)
    {
        pass(frame->cmd, image, kDrawn, kCopied);
        copyOut(*frame);
        pass(frame->cmd, image, kCopied, kPresented);
    }
    else
        pass(frame->cmd, image, kDrawn, kPresented);
    m_swapchain.end(*frame);
    if (shot) *shot = readShot();
    return true;
}

void Screen::drawPicture(const Swapchain::Frame& frame, engine::Image* picture)
{
    const VkImage target = m_swapchain.image(frame.image);
    if (picture) transition(frame.cmd, *picture, engine::kCopySource);
    pass(frame.cmd, target, kAcquired, kFilled);
    if (!picture)
    {
        const VkClearColorValue black = {};
        vkCmdClearColorImage(frame.cmd, target, kFilled.layout, &black, 1, &kWhole);
        return;
    }
    VkImageBlit region = {};
    region.srcSubresource = region.dstSubresource = kLayer;
    region.srcOffsets[1] = cornerOf(picture->desc().width, picture->desc().height);
    region.dstOffsets[1] = cornerOf(m_swapchain.extent().width, m_swapchain.extent().height);
    const bool isEnlarged = picture->desc().width < m_swapchain.extent().width;
    vkCmdBlitImage(frame.cmd, picture->handle(), engine::kCopySource.layout, target, kFilled.layout, 1, &region,
                   isEnlarged ? VK_FILTER_NEAREST : VK_FILTER_LINEAR); // enlarged pixels are to be seen as such
}

void Screen::copyOut(const Swapchain::Frame& frame)
{
    m_shotExtent = m_swapchain.extent();
    engine::BufferDesc desc;
    desc.name = "picture of the window";
    desc.byteSize = VkDeviceSize(m_shotExtent.width) * m_shotExtent.height * 4;
    desc.isHostVisible = true;
    m_device.waitIdle(); // for the one before
    m_shot = engine::Buffer(m_device, desc);
    VkBufferImageCopy region = {};
    region.imageSubresource = kLayer;
    region.imageExtent = {m_shotExtent.width, m_shotExtent.height, 1};
    vkCmdCopyImageToBuffer(frame.cmd, m_swapchain.image(frame.image), kCopied.layout, m_shot.handle(), 1, &region);
    engine::memoryBarrier(frame.cmd);
}

sample::Image Screen::readShot() const
{
    m_device.waitIdle();
    const auto bytes = m_shot.mapped();
    const bool isBgr = m_swapchain.format() == VK_FORMAT_B8G8R8A8_UNORM;
    sample::Image picture(int(m_shotExtent.width), int(m_shotExtent.height));
    for (size_t i = 0; i < picture.rgba.size(); ++i)
    {
        const size_t c = i % 4;
        const size_t at = isBgr && c < 3 ? i - c + 2 - c : i;
        picture.rgba[i] = float(std::to_integer<int>(bytes[at])) / 255.0f;
    }
    return picture;
}
} // namespace window
