#include "window/swapchain.h"

#include <algorithm>

namespace window
{
namespace
{
using engine::check;
using engine::describe;

engine::UniqueSemaphore createSemaphore(const engine::Device& device)
{
    const auto info = describe<VkSemaphoreCreateInfo>(VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO);
    VkSemaphore semaphore = VK_NULL_HANDLE;
    check(vkCreateSemaphore(device.handle(), &info, nullptr, &semaphore), "create a semaphore");
    return {device.handle(), semaphore};
}

engine::UniqueImageView createView(const engine::Device& device, VkImage image, VkFormat format)
{
    auto info = describe<VkImageViewCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO);
    info.image = image;
    info.viewType = VK_IMAGE_VIEW_TYPE_2D;
    info.format = format;
    info.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    VkImageView view = VK_NULL_HANDLE;
    check(vkCreateImageView(device.handle(), &info, nullptr, &view), "create a view of the window's image");
    return {device.handle(), view};
}

VkSurfaceCapabilitiesKHR capabilitiesOf(VkPhysicalDevice physical, VkSurfaceKHR surface)
{
    VkSurfaceCapabilitiesKHR capabilities = {};
    check(vkGetPhysicalDeviceSurfaceCapabilitiesKHR(physical, surface, &capabilities), "ask the window's surface");
    return capabilities;
}

// What the surface says, or what the window has where it follows the images.
VkExtent2D extentOf(const VkSurfaceCapabilitiesKHR& capabilities, glm::ivec2 pixels)
{
    if (capabilities.currentExtent.width != UINT32_MAX) return capabilities.currentExtent;
    return {std::clamp(uint32_t(pixels.x), capabilities.minImageExtent.width, capabilities.maxImageExtent.width),
            std::clamp(uint32_t(pixels.y), capabilities.minImageExtent.height, capabilities.maxImageExtent.height)};
}
} // namespace

Swapchain::Swapchain(const engine::Device& device, Window& window)
    : m_device(device), m_window(window), m_surface(window.createSurface(device)), m_ring(device, kFramesInFlight)
{
    VkBool32 isAble = VK_FALSE;
    vkGetPhysicalDeviceSurfaceSupportKHR(device.physical(), device.queueFamily(), m_surface, &isAble);
    if (!isAble) throw engine::Error("the device cannot present to the window");
    chooseFormat();
    for (uint32_t i = 0; i < kFramesInFlight; ++i) m_acquired.push_back(createSemaphore(device));
}

Swapchain::~Swapchain()
{
    vkDeviceWaitIdle(m_device.handle());
    m_views.clear();
    m_swapchain = {};
    vkDestroySurfaceKHR(m_device.instance(), m_surface, nullptr);
}

// Pictures are encoded for the screen before they get here, so the format must not encode them again.
void Swapchain::chooseFormat()
{
    uint32_t count = 0;
    vkGetPhysicalDeviceSurfaceFormatsKHR(m_device.physical(), m_surface, &count, nullptr);
    std::vector<VkSurfaceFormatKHR> formats(count);
    vkGetPhysicalDeviceSurfaceFormatsKHR(m_device.physical(), m_surface, &count, formats.data());
    for (VkFormat wanted : {VK_FORMAT_B8G8R8A8_UNORM, VK_FORMAT_R8G8B8A8_UNORM})
        for (const VkSurfaceFormatKHR& format : formats)
            if (format.format == wanted)
            {
                m_format = format;
                return;
            }
    throw engine::Error("the window has no 8-bit format without sRGB encoding");
}

void Swapchain::create()
{
    vkDeviceWaitIdle(m_device.handle());
    const VkSurfaceCapabilitiesKHR capabilities = capabilitiesOf(m_device.physical(), m_surface);
    m_extent = extentOf(capabilities, m_window.pixelSize());
    auto info = describe<VkSwapchainCreateInfoKHR>(VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR);
    info.surface = m_surface;
    info.minImageCount = capabilities.minImageCount + 1;
    if (capabilities.maxImageCount > 0) info.minImageCount = std::min(info.minImageCount, capabilities.maxImageCount);
    info.imageFormat = m_format.format;
    info.imageColorSpace = m_format.colorSpace;
    info.imageExtent = m_extent;
    info.imageArrayLayers = 1;
    // Blitted into, drawn over, and read by pictures of the window.
    info.imageUsage =
        VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    if ((capabilities.supportedUsageFlags & info.imageUsage) != info.imageUsage)
        throw engine::Error("the window's images cannot be copied to and from");
    info.preTransform = capabilities.currentTransform;
    info.compositeAlpha = VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR;
    info.presentMode = VK_PRESENT_MODE_FIFO_KHR;
    info.clipped = VK_TRUE;
    info.oldSwapchain = m_swapchain.get();
    VkSwapchainKHR swapchain = VK_NULL_HANDLE;
    check(vkCreateSwapchainKHR(m_device.handle(), &info, nullptr, &swapchain), "create the window's images");
    m_views.clear();
    m_swapchain = {m_device.handle(), swapchain};
    uint32_t count = 0;
    vkGetSwapchainImagesKHR(m_device.handle(), swapchain, &count, nullptr);
    m_images.resize(count);
    vkGetSwapchainImagesKHR(m_device.handle(), swapchain, &count, m_images.data());
    m_rendered.clear();
    for (VkImage image : m_images)
    {
        m_views.push_back(createView(m_device, image, m_format.format));
        m_rendered.push_back(createSemaphore(m_device));
    }
    m_isStale = false;
    ++m_generation;
}

bool Swapchain::isOutdated() const
{
    const VkExtent2D now = extentOf(capabilitiesOf(m_device.physical(), m_surface), m_window.pixelSize());
    return m_isStale || now.width != m_extent.width || now.height != m_extent.height;
}

std::optional<Swapchain::Frame> Swapchain::begin()
{
    if (m_window.pixelSize() == glm::ivec2(0)) return std::nullopt;
    const VkExtent2D now = extentOf(capabilitiesOf(m_device.physical(), m_surface), m_window.pixelSize());
    if (now.width == 0 || now.height == 0) return std::nullopt;
    if (isOutdated()) create();
    Frame frame;
    frame.cmd = m_ring.begin();
    frame.slot = m_ring.slot();
    const VkResult result = vkAcquireNextImageKHR(m_device.handle(), m_swapchain.get(), UINT64_MAX,
                                                  m_acquired[frame.slot].get(), VK_NULL_HANDLE, &frame.image);
    m_isStale = result == VK_SUBOPTIMAL_KHR;
    if (result == VK_ERROR_OUT_OF_DATE_KHR)
    {
        m_isStale = true;
        m_ring.submit(); // empty: the slot goes round
        return std::nullopt;
    }
    check(result, "get the window's next image");
    return frame;
}

void Swapchain::end(const Frame& frame)
{
    const VkSemaphore rendered = m_rendered[frame.image].get();
    // The picture is computed before the image is needed, for the blit.
    m_ring.submit({m_acquired[frame.slot].get(), VK_PIPELINE_STAGE_TRANSFER_BIT, rendered});
    const VkSwapchainKHR swapchain = m_swapchain.get();
    auto info = describe<VkPresentInfoKHR>(VK_STRUCTURE_TYPE_PRESENT_INFO_KHR);
    info.waitSemaphoreCount = 1;
    info.pWaitSemaphores = &rendered;
    info.swapchainCount = 1;
    info.pSwapchains = &swapchain;
    info.pImageIndices = &frame.image;
    const VkResult result = vkQueuePresentKHR(m_device.queue(), &info);
    if (result == VK_ERROR_OUT_OF_DATE_KHR || result == VK_SUBOPTIMAL_KHR)
        m_isStale = true;
    else
        check(result, "present");
}
} // namespace window
