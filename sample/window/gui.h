// Dear ImGui over the window's images: its context, its back ends, and the render pass that draws it.
#pragma once
#include "window/swapchain.h"

namespace window
{
class Gui
{
public:
    Gui(const engine::Device& device, Window& window, const Swapchain& swapchain);
    ~Gui(); // waits for the device
    Gui(const Gui&) = delete;
    Gui& operator=(const Gui&) = delete;

    void beginFrame();
    /// What was built since beginFrame() is forgotten or drawn; one of the two must follow.
    void dropFrame();
    /// Draws over the image, from the layout COLOR_ATTACHMENT_OPTIMAL, and leaves it there.
    void draw(const Swapchain& swapchain, const Swapchain::Frame& frame);

    /// The mouse or the keys are busy with the panel.
    static bool wantsMouse();
    static bool wantsKeys();

private:
    void createRenderPass(VkFormat format);
    void followSwapchain(const Swapchain& swapchain);

    const engine::Device& m_device;
    engine::UniqueDescriptorPool m_pool;
    engine::UniqueRenderPass m_renderPass;
    std::vector<engine::UniqueFramebuffer> m_framebuffers;
    uint32_t m_generation = 0; // of the swapchain they belong to
};
} // namespace window
