#include "window/window.h"

#include <GLFW/glfw3.h> // after vulkan.h, for its Vulkan part

#include <utility>

namespace window
{
namespace
{
std::string lastError()
{
    const char* text = nullptr;
    glfwGetError(&text);
    return text ? text : "no reason given";
}

Window& of(GLFWwindow* handle) { return *static_cast<Window*>(glfwGetWindowUserPointer(handle)); }
} // namespace

Window::Window(const char* title, glm::ivec2 size)
{
    if (!glfwInit()) throw engine::Error("cannot open a window: " + lastError() + "; --headless needs none");
    if (!glfwVulkanSupported()) throw engine::Error("cannot open a window: there is no Vulkan for it");
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    m_window = glfwCreateWindow(size.x, size.y, title, nullptr, nullptr);
    if (!m_window) throw engine::Error("cannot open a window: " + lastError());
    glfwSetWindowUserPointer(m_window, this);
    glfwSetDropCallback(m_window, [](GLFWwindow* handle, int count, const char** files)
                        { of(handle).m_dropped.insert(of(handle).m_dropped.end(), files, files + count); });
    glfwSetScrollCallback(m_window, [](GLFWwindow* handle, double x, double y)
                          { of(handle).m_wheel += glm::vec2(float(x), float(y)); });
}

Window::~Window()
{
    if (m_window) glfwDestroyWindow(m_window);
    glfwTerminate();
}

void Window::addRequirements(engine::DeviceDesc& desc) const
{
    uint32_t count = 0;
    const char** names = glfwGetRequiredInstanceExtensions(&count);
    desc.instanceExtensions.assign(names, names + count);
    desc.extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    desc.queueFlags |= VK_QUEUE_GRAPHICS_BIT;
    desc.canPresent = [](VkInstance instance, VkPhysicalDevice physical, uint32_t family)
    { return glfwGetPhysicalDevicePresentationSupport(instance, physical, family) == GLFW_TRUE; };
}

VkSurfaceKHR Window::createSurface(const engine::Device& device) const
{
    VkSurfaceKHR surface = VK_NULL_HANDLE;
    engine::check(glfwCreateWindowSurface(device.instance(), m_window, nullptr, &surface), "draw into the window");
    return surface;
}

void Window::poll()
{
    glfwPollEvents();
    while (pixelSize() == glm::ivec2(0) && !isClosing()) glfwWaitEventsTimeout(0.1);
}

bool Window::isClosing() const { return glfwWindowShouldClose(m_window); }
void Window::close() { glfwSetWindowShouldClose(m_window, GLFW_TRUE); }

glm::ivec2 Window::pixelSize() const
{
    glm::ivec2 size(0);
    glfwGetFramebufferSize(m_window, &size.x, &size.y);
    return glm::min(size.x, size.y) > 0 ? size : glm::ivec2(0);
}

float Window::contentScale() const
{
    float x = 1.0f, y = 1.0f;
    glfwGetWindowContentScale(m_window, &x, &y);
    return x;
}

void Window::setPixelSize(glm::ivec2 size)
{
    glm::ivec2 window(0);
    glfwGetWindowSize(m_window, &window.x, &window.y); // screen coordinates, which need not be pixels
    const glm::ivec2 pixels = glm::max(pixelSize(), glm::ivec2(1));
    glfwSetWindowSize(m_window, size.x * window.x / pixels.x, size.y * window.y / pixels.y);
}

bool Window::isFullscreen() const { return glfwGetWindowMonitor(m_window) != nullptr; }

void Window::setFullscreen(bool isWanted)
{
    if (isWanted == isFullscreen()) return;
    if (!isWanted)
    {
        glfwSetWindowMonitor(m_window, nullptr, m_windowed.x, m_windowed.y, m_windowed.z, m_windowed.w, 0);
        return;
    }
    glfwGetWindowPos(m_window, &m_windowed.x, &m_windowed.y);
    glfwGetWindowSize(m_window, &m_windowed.z, &m_windowed.w);
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    const GLFWvidmode* mode = monitor ? glfwGetVideoMode(monitor) : nullptr;
    if (mode) glfwSetWindowMonitor(m_window, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

void Window::setMinimized(bool isWanted) { isWanted ? glfwIconifyWindow(m_window) : glfwRestoreWindow(m_window); }
void Window::setTitle(const std::string& title) { glfwSetWindowTitle(m_window, title.c_str()); }
bool Window::isKeyDown(int key) const { return m_heldKeys.contains(key) || glfwGetKey(m_window, key) == GLFW_PRESS; }
bool Window::isButtonDown(int button) const
{
    return m_heldButtons.contains(button) || glfwGetMouseButton(m_window, button) == GLFW_PRESS;
}

void Window::holdKey(int key, bool isHeld)
{
    m_heldKeys.erase(key);
    if (isHeld) m_heldKeys.insert(key);
}

void Window::holdButton(int button, bool isHeld)
{
    m_heldButtons.erase(button);
    if (isHeld) m_heldButtons.insert(button);
}

glm::vec2 Window::cursor() const
{
    if (m_movedCursor) return *m_movedCursor;
    double x = 0.0, y = 0.0;
    glfwGetCursorPos(m_window, &x, &y);
    glm::ivec2 window(0);
    glfwGetWindowSize(m_window, &window.x, &window.y);
    return glm::vec2(x, y) * glm::vec2(pixelSize()) / glm::vec2(glm::max(window, glm::ivec2(1)));
}

std::vector<std::filesystem::path> Window::takeDroppedFiles() { return std::exchange(m_dropped, {}); }
glm::vec2 Window::takeWheel() { return std::exchange(m_wheel, glm::vec2(0.0f)); }
} // namespace window
