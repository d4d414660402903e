// The sample's own Vulkan: instance, physical device, device and one queue, with or without a window.
// One thread at a time per Device; it outlives everything made from it.
#pragma once
#include "engine/error.h"

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace engine
{
struct DeviceDesc
{
    std::string device; // index as --list-devices prints it, or part of the name; empty: the first, GPUs before CPUs
    bool validation = false; // Khronos validation with synchronisation validation; messages are counted and printed
    VkPhysicalDeviceFeatures features = {};         // enabled on top of the engine's own; absent ones are an Error
    std::vector<std::string> extensions;            // device extensions, enabled where the device has them
    std::vector<std::string> instanceExtensions;    // must be there
    VkQueueFlags queueFlags = VK_QUEUE_COMPUTE_BIT; // what the queue must be able to do
    std::function<bool(VkInstance, VkPhysicalDevice, uint32_t family)> canPresent; // asked of it, too; may be empty
};

/// What a validation layer said: the count of warnings and errors since the device was created.
struct ValidationLog
{
    std::atomic<uint32_t> messageCount = 0;
};

/// One line per Vulkan device, in the order DeviceDesc::device counts: "0: name (type, Vulkan version)".
std::vector<std::string> listDevices();

class Device
{
public:
    /// Throws Error when there is no such device, no Vulkan 1.1, a missing feature, or no validation layer.
    explicit Device(const DeviceDesc& desc);
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    VkInstance instance() const { return m_instance; }
    VkPhysicalDevice physical() const { return m_physical; }
    VkDevice handle() const { return m_device; }
    VkQueue queue() const { return m_queue; }
    uint32_t queueFamily() const { return m_queueFamily; }
    const VkPhysicalDeviceProperties& properties() const { return m_properties; }
    const std::vector<std::string>& enabledExtensions() const { return m_extensions; }
    const VkPhysicalDeviceFeatures& enabledFeatures() const { return m_features; }

    /// Warnings and errors of the validation layer so far; 0 without validation.
    uint32_t validationMessageCount() const { return m_log->messageCount; }

    /// Index of a memory type among `typeBits` with all `flags`; throws Error when there is none.
    uint32_t findMemoryType(uint32_t typeBits, VkMemoryPropertyFlags flags) const;

    /// Names an object for debuggers and validation messages; without VK_EXT_debug_utils it does nothing.
    void setName(VkObjectType type, uint64_t handle, const std::string& name) const;

    /// Opens and closes a label around commands; without VK_EXT_debug_utils they do nothing.
    void beginLabel(VkCommandBuffer cmd, const char* name) const;
    void endLabel(VkCommandBuffer cmd) const;

    void waitIdle() const;

private:
    void createInstance(const DeviceDesc& desc);
    void pickPhysical(const DeviceDesc& desc);
    void createDevice(const DeviceDesc& desc);
    void destroy() noexcept;

    std::unique_ptr<ValidationLog> m_log = std::make_unique<ValidationLog>(); // the callback keeps its address
    VkInstance m_instance = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT m_messenger = VK_NULL_HANDLE;
    VkPhysicalDevice m_physical = VK_NULL_HANDLE;
    VkDevice m_device = VK_NULL_HANDLE;
    VkQueue m_queue = VK_NULL_HANDLE;
    uint32_t m_queueFamily = 0;
    bool m_hasDebugUtils = false;
    VkPhysicalDeviceProperties m_properties = {};
    VkPhysicalDeviceMemoryProperties m_memory = {};
    VkPhysicalDeviceFeatures m_features = {};
    std::vector<std::string> m_extensions;
    PFN_vkSetDebugUtilsObjectNameEXT m_setName = nullptr;
    PFN_vkCmdBeginDebugUtilsLabelEXT m_beginLabel = nullptr;
    PFN_vkCmdEndDebugUtilsLabelEXT m_endLabel = nullptr;
};
} // namespace engine
