#include "adapter.h"
#include "checks.h"
#include <algorithm>
#include <cstring>

// The one function that is linked: everything else comes through it.
extern "C" VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL vkGetInstanceProcAddr(VkInstance instance, const char* name);

namespace rhi::vulkan
{
namespace
{
constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

bool hasExtension(const Loader& load, const char* layer, const char* name)
{
    const PFN_vkEnumerateInstanceExtensionProperties enumerate = load("vkEnumerateInstanceExtensionProperties");
    uint32_t count = 0;
    const VkResult result = enumerate(layer, &count, nullptr);
    if (result == VK_ERROR_LAYER_NOT_PRESENT) return false;
    check(result, "Vulkan", "extensions");
    std::vector<VkExtensionProperties> extensions(count);
    check(enumerate(layer, &count, extensions.data()), "Vulkan", "extensions");
    const auto isIt = [&](const VkExtensionProperties& e) { return std::strcmp(e.extensionName, name) == 0; };
    return std::any_of(extensions.begin(), extensions.end(), isIt);
}

bool hasLayer(const Loader& load, const char* name)
{
    const PFN_vkEnumerateInstanceLayerProperties enumerate = load("vkEnumerateInstanceLayerProperties");
    uint32_t count = 0;
    check(enumerate(&count, nullptr), "Vulkan", "layers");
    std::vector<VkLayerProperties> layers(count);
    check(enumerate(&count, layers.data()), "Vulkan", "layers");
    const auto isIt = [&](const VkLayerProperties& l) { return std::strcmp(l.layerName, name) == 0; };
    return std::any_of(layers.begin(), layers.end(), isIt);
}

VKAPI_ATTR VkBool32 VKAPI_CALL onMessage(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                         VkDebugUtilsMessageTypeFlagsEXT,
                                         const VkDebugUtilsMessengerCallbackDataEXT* data, void* user)
{
    MessageSeverity level = MessageSeverity::Info;
    if (severity >= VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT) level = MessageSeverity::Warning;
    if (severity >= VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT) level = MessageSeverity::Error;
    const auto& callback = *static_cast<const VulkanMessageCallback*>(user);
    callback(level, data->pMessage);
    return VK_FALSE;
}
} // namespace

void Instance::Deleter::operator()(VkInstance instance) const
{
    const PFN_vkDestroyInstance destroy = Loader(vkGetInstanceProcAddr, instance).optional("vkDestroyInstance");
    destroy(instance, nullptr);
}

Instance::Instance(const VulkanDeviceDesc& desc)
    : m_callback(desc.messageCallback), m_load(vkGetInstanceProcAddr, VkInstance{VK_NULL_HANDLE})
{
    create(desc);
    m_load = Loader(vkGetInstanceProcAddr, m_instance.get());
    if (m_hasDebugUtils && m_callback) createMessenger();
}

Instance::~Instance()
{
    if (!m_messenger) return;
    const PFN_vkDestroyDebugUtilsMessengerEXT destroy = m_load.optional("vkDestroyDebugUtilsMessengerEXT");
    destroy(m_instance.get(), m_messenger, nullptr);
}

uint32_t Instance::loaderVersion() const
{
    const PFN_vkEnumerateInstanceVersion enumerate = m_load.optional("vkEnumerateInstanceVersion");
    uint32_t version = VK_API_VERSION_1_0;
    if (enumerate) check(enumerate(&version), "Vulkan", "version");
    if (version < VK_API_VERSION_1_1) throw Error(ErrorCode::Unsupported, "the Vulkan loader is older than 1.1");
    return std::min(version, static_cast<uint32_t>(VK_API_VERSION_1_3));
}

void Instance::create(const VulkanDeviceDesc& desc)
{
    m_apiVersion = loaderVersion();
    auto application = vkStruct<VkApplicationInfo>(VK_STRUCTURE_TYPE_APPLICATION_INFO);
    application.pApplicationName = "nrd";
    application.apiVersion = m_apiVersion;

    const bool isSync = desc.isSyncValidationEnabled;
    const bool isValidated = desc.isValidationEnabled || isSync;
    if (isValidated && !hasLayer(m_load, kValidationLayer))
        throw Error(ErrorCode::Unsupported, sentence("the layer %s is not installed", kValidationLayer));
    m_hasDebugUtils = hasExtension(m_load, nullptr, VK_EXT_DEBUG_UTILS_EXTENSION_NAME) ||
                      (isValidated && hasExtension(m_load, kValidationLayer, VK_EXT_DEBUG_UTILS_EXTENSION_NAME));
    std::vector<const char*> extensions;
    if (m_hasDebugUtils) extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    if (isSync) extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);

    const VkValidationFeatureEnableEXT enabled = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    auto features = vkStruct<VkValidationFeaturesEXT>(VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT);
    features.enabledValidationFeatureCount = 1;
    features.pEnabledValidationFeatures = &enabled;
    auto info = vkStruct<VkInstanceCreateInfo>(VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO);
    info.pNext = isSync ? &features : nullptr;
    info.pApplicationInfo = &application;
    info.enabledLayerCount = isValidated ? 1 : 0;
    info.ppEnabledLayerNames = &kValidationLayer;
    info.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    VkInstance instance = VK_NULL_HANDLE;
    const PFN_vkCreateInstance createInstance = m_load("vkCreateInstance");
    check(createInstance(&info, nullptr, &instance), "Vulkan", "instance");
    m_instance.reset(instance);
}

void Instance::createMessenger()
{
    auto info = vkStruct<VkDebugUtilsMessengerCreateInfoEXT>(VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT);
    info.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
    info.pfnUserCallback = onMessage;
    info.pUserData = &m_callback;
    const PFN_vkCreateDebugUtilsMessengerEXT createMessengerFn = m_load("vkCreateDebugUtilsMessengerEXT");
    check(createMessengerFn(m_instance.get(), &info, nullptr, &m_messenger), "Vulkan", "debug messenger");
}

std::vector<VkPhysicalDevice> Instance::physicalDevices() const
{
    const PFN_vkEnumeratePhysicalDevices enumerate = m_load("vkEnumeratePhysicalDevices");
    uint32_t count = 0;
    check(enumerate(get(), &count, nullptr), "Vulkan", "devices");
    std::vector<VkPhysicalDevice> devices(count);
    check(enumerate(get(), &count, devices.data()), "Vulkan", "devices");
    devices.resize(count);
    return devices;
}
} // namespace rhi::vulkan
