// The images of the window, one after the other, and the frames in flight that fill them.
#pragma once
#include "engine/commands.h"
#include "window/window.h"

#include <optional>

namespace window
{
class Swapchain
{
public:
    static constexpr uint32_t kFramesInFlight = 2;

    /// Throws engine::Error when the device cannot present to the window.
    Swapchain(const engine::Device& device, Window& window);
    ~Swapchain(); // waits for the device
    Swapchain(const Swapchain&) = delete;
    Swapchain& operator=(const Swapchain&) = delete;

    /// Begins a frame, after making the images anew where the window has another size. nullopt: there is nothing to
    /// draw into now; try again after the next poll().
    struct Frame
    {
        VkCommandBuffer cmd = VK_NULL_HANDLE;
        uint32_t slot = 0;  // [0; kFramesInFlight)
        uint32_t image = 0; // [0; imageCount())
    };
    std::optional<Frame> begin();
    /// Submits and presents. The image must be in the layout PRESENT_SRC_KHR.
    void end(const Frame& frame);

    VkFormat format() const { return m_format.format; }
    VkExtent2D extent() const { return m_extent; }
    uint32_t imageCount() const { return static_cast<uint32_t>(m_images.size()); }
    VkImage image(uint32_t index) const { return m_images[index]; }
    VkImageView view(uint32_t index) const { return m_views[index].get(); }
    /// Another number after each time the images were made.
    uint32_t generation() const { return m_generation; }

private:
    void chooseFormat();
    void create();
    bool isOutdated() const;

    const engine::Device& m_device;
    Window& m_window;
    VkSurfaceKHR m_surface = VK_NULL_HANDLE;
    VkSurfaceFormatKHR m_format = {};
    VkExtent2D m_extent = {};
    engine::FrameRing m_ring;
    engine::UniqueSwapchain m_swapchain;
    std::vector<VkImage> m_images;
    std::vector<engine::UniqueImageView> m_views;
    std::vector<engine::UniqueSemaphore> m_acquired; // by frame in flight
    std::vector<engine::UniqueSemaphore> m_rendered; // by image
    bool m_isStale = true;
    uint32_t m_generation = 0;
};
} // namespace window
