#include "engine/device.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>

namespace engine
{
namespace
{
constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

VKAPI_ATTR VkBool32 VKAPI_CALL onMessage(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                         const VkDebugUtilsMessengerCallbackDataEXT* data, void* user)
{
    static_cast<ValidationLog*>(user)->messageCount++;
    std::fprintf(stderr, "validation: %s\n", data->pMessage);
    return VK_FALSE;
}

VkDebugUtilsMessengerCreateInfoEXT messengerInfo(ValidationLog* log)
{
    auto info = describe<VkDebugUtilsMessengerCreateInfoEXT>(VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT);
    info.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
    info.pfnUserCallback = onMessage;
    info.pUserData = log;
    return info;
}

bool hasInstanceLayer(const char* name)
{
    uint32_t count = 0;
    vkEnumerateInstanceLayerProperties(&count, nullptr);
    std::vector<VkLayerProperties> layers(count);
    vkEnumerateInstanceLayerProperties(&count, layers.data());
    return std::any_of(layers.begin(), layers.end(),
                       [&](const auto& layer) { return std::strcmp(layer.layerName, name) == 0; });
}

bool hasInstanceExtension(const char* name)
{
    uint32_t count = 0;
    vkEnumerateInstanceExtensionProperties(nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> extensions(count);
    vkEnumerateInstanceExtensionProperties(nullptr, &count, extensions.data());
    return std::any_of(extensions.begin(), extensions.end(),
                       [&](const auto& extension) { return std::strcmp(extension.extensionName, name) == 0; });
}

std::vector<std::string> deviceExtensions(VkPhysicalDevice physical)
{
    uint32_t count = 0;
    vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> properties(count);
    vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, properties.data());
    std::vector<std::string> names;
    for (const auto& property : properties) names.emplace_back(property.extensionName);
    return names;
}

int rankOf(VkPhysicalDeviceType type)
{
    constexpr std::array<VkPhysicalDeviceType, 4> kOrder = {
        VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU, VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU,
        VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU, VK_PHYSICAL_DEVICE_TYPE_CPU};
    return static_cast<int>(std::find(kOrder.begin(), kOrder.end(), type) - kOrder.begin());
}

const char* typeName(VkPhysicalDeviceType type)
{
    constexpr std::array<const char*, 5> kNames = {"discrete GPU", "integrated GPU", "virtual GPU", "CPU", "other"};
    return kNames[static_cast<size_t>(rankOf(type))];
}

VkPhysicalDeviceProperties propertiesOf(VkPhysicalDevice physical)
{
    VkPhysicalDeviceProperties properties = {};
    vkGetPhysicalDeviceProperties(physical, &properties);
    return properties;
}

// GPUs before CPUs, otherwise as the loader lists them, so that index 0 is the one to use.
std::vector<VkPhysicalDevice> enumerate(VkInstance instance)
{
    uint32_t count = 0;
    check(vkEnumeratePhysicalDevices(instance, &count, nullptr), "list Vulkan devices");
    std::vector<VkPhysicalDevice> devices(count);
    check(vkEnumeratePhysicalDevices(instance, &count, devices.data()), "list Vulkan devices");
    std::stable_sort(devices.begin(), devices.end(),
                     [](VkPhysicalDevice a, VkPhysicalDevice b)
                     { return rankOf(propertiesOf(a).deviceType) < rankOf(propertiesOf(b).deviceType); });
    return devices;
}

VkPhysicalDevice findDevice(const std::vector<VkPhysicalDevice>& devices, const std::string& wanted)
{
    if (devices.empty()) throw Error("there is no Vulkan device on this machine");
    if (wanted.empty()) return devices.front();
    const bool isIndex = wanted.size() <= 3 && wanted.find_first_not_of("0123456789") == std::string::npos;
    if (isIndex && std::stoul(wanted) < devices.size()) return devices[std::stoul(wanted)];
    for (VkPhysicalDevice device : devices)
    {
        if (std::string(propertiesOf(device).deviceName).find(wanted) != std::string::npos && !isIndex) return device;
    }
    throw Error("there is no Vulkan device '" + wanted + "' among " + std::to_string(devices.size()) +
                "; --list-devices shows them");
}

// The struct is nothing but VkBool32 fields, so it can be walked as an array.
using FeatureArray = std::array<VkBool32, sizeof(VkPhysicalDeviceFeatures) / sizeof(VkBool32)>;

VkPhysicalDeviceFeatures unite(const VkPhysicalDeviceFeatures& a, const VkPhysicalDeviceFeatures& b)
{
    FeatureArray x, y;
    std::memcpy(x.data(), &a, sizeof(a));
    std::memcpy(y.data(), &b, sizeof(b));
    for (size_t i = 0; i < x.size(); ++i) x[i] |= y[i];
    VkPhysicalDeviceFeatures result;
    std::memcpy(&result, x.data(), sizeof(result));
    return result;
}

bool contains(const VkPhysicalDeviceFeatures& all, const VkPhysicalDeviceFeatures& wanted)
{
    const VkPhysicalDeviceFeatures both = unite(all, wanted);
    return std::memcmp(&both, &all, sizeof(all)) == 0;
}

uint32_t findQueueFamily(VkInstance instance, VkPhysicalDevice physical, const DeviceDesc& desc)
{
    uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
    for (uint32_t i = 0; i < count; ++i)
    {
        const bool isAble = (families[i].queueFlags & desc.queueFlags) == desc.queueFlags;
        if (isAble && (!desc.canPresent || desc.canPresent(instance, physical, i))) return i;
    }
    const std::string lack = desc.canPresent ? "queue that computes, draws and presents" : "compute queue";
    throw Error(std::string("device '") + propertiesOf(physical).deviceName + "' has no " + lack);
}
} // namespace

std::vector<std::string> listDevices()
{
    const VkApplicationInfo app = {VK_STRUCTURE_TYPE_APPLICATION_INFO, nullptr, "", 0, "", 0, VK_API_VERSION_1_1};
    auto info = describe<VkInstanceCreateInfo>(VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO);
    info.pApplicationInfo = &app;
    VkInstance instance = VK_NULL_HANDLE;
    check(vkCreateInstance(&info, nullptr, &instance), "create a Vulkan instance");
    std::vector<std::string> lines;
    for (VkPhysicalDevice device : enumerate(instance))
    {
        const VkPhysicalDeviceProperties p = propertiesOf(device);
        lines.push_back(std::to_string(lines.size()) + ": " + p.deviceName + " (" + typeName(p.deviceType) +
                        ", Vulkan " + std::to_string(VK_API_VERSION_MAJOR(p.apiVersion)) + "." +
                        std::to_string(VK_API_VERSION_MINOR(p.apiVersion)) + ")");
    }
    vkDestroyInstance(instance, nullptr);
    return lines;
}

Device::Device(const DeviceDesc& desc)
{
    try
    {
        createInstance(desc);
        pickPhysical(desc);
        createDevice(desc);
    }
    catch (...)
    {
        destroy();
        throw;
    }
}

Device::~Device() { destroy(); }

void Device::destroy() noexcept
{
    if (m_device) vkDestroyDevice(m_device, nullptr);
    if (m_messenger)
    {
        const auto destroyMessenger = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
            vkGetInstanceProcAddr(m_instance, "vkDestroyDebugUtilsMessengerEXT"));
        destroyMessenger(m_instance, m_messenger, nullptr);
    }
    if (m_instance) vkDestroyInstance(m_instance, nullptr);
}

void Device::createInstance(const DeviceDesc& desc)
{
    const bool validation = desc.validation;
    if (validation && !hasInstanceLayer(kValidationLayer))
        throw Error("validation was asked for, but the layer VK_LAYER_KHRONOS_validation is not installed");
    m_hasDebugUtils = hasInstanceExtension(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);

    const VkApplicationInfo app = {
        VK_STRUCTURE_TYPE_APPLICATION_INFO, nullptr, "nrd-sample", 0, "", 0, VK_API_VERSION_1_1};
    const VkValidationFeatureEnableEXT sync = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    auto features = describe<VkValidationFeaturesEXT>(VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT);
    features.enabledValidationFeatureCount = 1;
    features.pEnabledValidationFeatures = &sync;
    std::vector<const char*> extensions;
    if (m_hasDebugUtils) extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    for (const std::string& extension : desc.instanceExtensions) extensions.push_back(extension.c_str());

    auto info = describe<VkInstanceCreateInfo>(VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO);
    info.pNext = validation ? &features : nullptr;
    info.pApplicationInfo = &app;
    info.enabledLayerCount = validation ? 1 : 0;
    info.ppEnabledLayerNames = &kValidationLayer;
    info.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    check(vkCreateInstance(&info, nullptr, &m_instance), "create a Vulkan instance");

    if (!validation || !m_hasDebugUtils) return;
    const VkDebugUtilsMessengerCreateInfoEXT messenger = messengerInfo(m_log.get());
    const auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(m_instance, "vkCreateDebugUtilsMessengerEXT"));
    check(create(m_instance, &messenger, nullptr, &m_messenger), "create the validation messenger");
}

void Device::pickPhysical(const DeviceDesc& desc)
{
    m_physical = findDevice(enumerate(m_instance), desc.device);
    m_properties = propertiesOf(m_physical);
    if (m_properties.apiVersion < VK_API_VERSION_1_1)
        throw Error(std::string("device '") + m_properties.deviceName + "' does not offer Vulkan 1.1");
    vkGetPhysicalDeviceMemoryProperties(m_physical, &m_memory);
    m_queueFamily = findQueueFamily(m_instance, m_physical, desc);
}

void Device::createDevice(const DeviceDesc& desc)
{
    VkPhysicalDeviceFeatures own = {};
    own.shaderStorageImageWriteWithoutFormat = VK_TRUE;
    own.shaderStorageImageExtendedFormats = VK_TRUE;
    m_features = unite(own, desc.features);
    VkPhysicalDeviceFeatures available = {};
    vkGetPhysicalDeviceFeatures(m_physical, &available);
    if (!contains(available, m_features))
        throw Error(std::string("device '") + m_properties.deviceName + "' lacks a core feature that was asked for");

    const std::vector<std::string> offered = deviceExtensions(m_physical);
    std::vector<const char*> names;
    for (const std::string& extension : desc.extensions)
    {
        if (std::find(offered.begin(), offered.end(), extension) == offered.end()) continue;
        m_extensions.push_back(extension);
        names.push_back(extension.c_str());
    }
    const float priority = 1.0f;
    auto queue = describe<VkDeviceQueueCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO);
    queue.queueFamilyIndex = m_queueFamily;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    auto info = describe<VkDeviceCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO);
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    info.enabledExtensionCount = static_cast<uint32_t>(names.size());
    info.ppEnabledExtensionNames = names.data();
    info.pEnabledFeatures = &m_features;
    check(vkCreateDevice(m_physical, &info, nullptr, &m_device),
          std::string("create a device on '") + m_properties.deviceName + "'");
    vkGetDeviceQueue(m_device, m_queueFamily, 0, &m_queue);
    if (!m_hasDebugUtils) return;
    m_setName = reinterpret_cast<PFN_vkSetDebugUtilsObjectNameEXT>(
        vkGetDeviceProcAddr(m_device, "vkSetDebugUtilsObjectNameEXT"));
    m_beginLabel = reinterpret_cast<PFN_vkCmdBeginDebugUtilsLabelEXT>(
        vkGetDeviceProcAddr(m_device, "vkCmdBeginDebugUtilsLabelEXT"));
    m_endLabel =
        reinterpret_cast<PFN_vkCmdEndDebugUtilsLabelEXT>(vkGetDeviceProcAddr(m_device, "vkCmdEndDebugUtilsLabelEXT"));
}

uint32_t Device::findMemoryType(uint32_t typeBits, VkMemoryPropertyFlags flags) const
{
    for (uint32_t i = 0; i < m_memory.memoryTypeCount; ++i)
    {
        if ((typeBits & (1u << i)) && (m_memory.memoryTypes[i].propertyFlags & flags) == flags) return i;
    }
    throw Error(std::string("device '") + m_properties.deviceName + "' has no memory of the kind that was asked for");
}

void Device::setName(VkObjectType type, uint64_t handle, const std::string& name) const
{
    if (!m_setName) return;
    const VkDebugUtilsObjectNameInfoEXT info = {VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT, nullptr, type,
                                                handle, name.c_str()};
    m_setName(m_device, &info);
}

void Device::beginLabel(VkCommandBuffer cmd, const char* name) const
{
    auto label = describe<VkDebugUtilsLabelEXT>(VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT);
    label.pLabelName = name;
    if (m_beginLabel) m_beginLabel(cmd, &label);
}

void Device::endLabel(VkCommandBuffer cmd) const
{
    if (m_endLabel) m_endLabel(cmd);
}

void Device::waitIdle() const { check(vkDeviceWaitIdle(m_device), "wait for the device"); }
} // namespace engine
