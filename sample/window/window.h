// The window of the desktop: size, input, files dropped onto it. GLFW underneath.
#pragma once
#include "engine/device.h"

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <set>
#include <vector>

struct GLFWwindow;

namespace window
{
/// Throws engine::Error when there is no display or it has no Vulkan.
class Window
{
public:
    Window(const char* title, glm::ivec2 size); // pixels
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    /// What the device must have been created with to present here.
    void addRequirements(engine::DeviceDesc& desc) const;
    VkSurfaceKHR createSurface(const engine::Device& device) const; // the caller destroys it

    /// Handles what has happened since; waits for something to happen while minimised.
    void poll();
    bool isClosing() const;
    void close();
    glm::ivec2 pixelSize() const; // of the frame buffer; 0 while minimised
    float contentScale() const;   // of fonts: 1 at 96 dots per inch
    void setPixelSize(glm::ivec2 size);
    bool isFullscreen() const;
    void setFullscreen(bool isWanted);
    void setMinimized(bool isWanted);
    void setTitle(const std::string& title);

    bool isKeyDown(int key) const; // GLFW_KEY_...
    bool isButtonDown(int button) const;
    glm::vec2 cursor() const; // pixels of the frame buffer
    /// Since the call before.
    std::vector<std::filesystem::path> takeDroppedFiles();
    glm::vec2 takeWheel();

    /// As if the user did it, besides what the user does: for scripts.
    void holdKey(int key, bool isHeld);
    void holdButton(int button, bool isHeld);
    void moveCursor(glm::vec2 position) { m_movedCursor = position; } // pixels of the frame buffer, from now on

    GLFWwindow* handle() const { return m_window; }

private:
    GLFWwindow* m_window = nullptr;
    std::vector<std::filesystem::path> m_dropped;
    glm::vec2 m_wheel = glm::vec2(0.0f);
    std::set<int> m_heldKeys, m_heldButtons;
    std::optional<glm::vec2> m_movedCursor;
    glm::ivec4 m_windowed = glm::ivec4(0); // position and size to come back to
};
} // namespace window
