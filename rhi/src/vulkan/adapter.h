// The instance and device that makeVulkanDevice() creates for headless use, and the list of what there is.
#pragma once
#include "context.h"
#include <memory>

namespace rhi::vulkan
{
class Instance
{
public:
    explicit Instance(const VulkanDeviceDesc& desc);
    Instance(const Instance&) = delete; // the messenger points at m_callback
    Instance& operator=(const Instance&) = delete;
    ~Instance();

    VkInstance get() const { return m_instance.get(); }
    const Loader& load() const { return m_load; }
    uint32_t apiVersion() const { return m_apiVersion; }
    bool hasDebugUtils() const { return m_hasDebugUtils; }
    std::vector<VkPhysicalDevice> physicalDevices() const;

private:
    struct Deleter
    {
        void operator()(VkInstance instance) const;
    };
    uint32_t loaderVersion() const;
    void create(const VulkanDeviceDesc& desc);
    void createMessenger();

    VulkanMessageCallback m_callback;
    uint32_t m_apiVersion = 0;
    bool m_hasDebugUtils = false;
    std::unique_ptr<std::remove_pointer_t<VkInstance>, Deleter> m_instance;
    Loader m_load;
    VkDebugUtilsMessengerEXT m_messenger = VK_NULL_HANDLE; // may be null
};

/// What is to be known of a physical device before a device is made of it.
struct AdapterFacts
{
    VulkanAdapter adapter;
    uint32_t apiVersion = 0; // the lower one of device and instance
    uint32_t queueFamilyIndex = 0;
    bool hasSynchronization2Extension = false;
    bool hasSynchronization2 = false;
    bool hasFloat16 = false;
};
AdapterFacts inspectAdapter(const Instance& instance, VkPhysicalDevice physicalDevice);

struct DeviceDeleter
{
    PFN_vkDestroyDevice destroy = nullptr;
    void operator()(VkDevice device) const { destroy(device, nullptr); }
};

class OwnedDevice
{
public:
    explicit OwnedDevice(const VulkanDeviceDesc& desc);
    const VulkanNativeDevice& native() const { return m_native; }

private:
    AdapterFacts chooseAdapter(const std::string& wanted);
    void createDevice(const AdapterFacts& facts, bool isSynchronization2Allowed);
    void adopt(VkDevice device, uint32_t queueFamilyIndex);

    Instance m_instance; // dies after the device
    std::unique_ptr<std::remove_pointer_t<VkDevice>, DeviceDeleter> m_device;
    VulkanNativeDevice m_native;
};
} // namespace rhi::vulkan
