// From the picture to the window: scaled into its image, the panel over it, presented, and now and then read back.
#pragma once
#include "engine/transfer.h"
#include "image_io.h"
#include "window/gui.h"

#include <functional>

namespace window
{
class Screen
{
public:
    Screen(const engine::Device& device, Window& window);

    /// `record` records the picture (for a slot) and returns it, or null for black; the panel must have been built.
    /// `shot`: where the whole window goes, when not null; it waits for the device then.
    /// False when the window has nothing to draw into now; the panel is dropped then.
    using RecordPicture = std::function<engine::Image*(VkCommandBuffer, uint32_t slot)>;
    bool present(const RecordPicture& record, sample::Image* shot = nullptr);

    Gui& gui() { return m_gui; }
    VkExtent2D extent() const { return m_swapchain.extent(); }

private:
    void drawPicture(const Swapchain::Frame& frame, engine::Image* picture);
    void copyOut(const Swapchain::Frame& frame);
    sample::Image readShot() const;

    const engine::Device& m_device;
    Swapchain m_swapchain;
    Gui m_gui;
    engine::Buffer m_shot;
    VkExtent2D m_shotExtent = {};
};
} // namespace window
