#include "adapter.h"
#include "checks.h"
#include "device.h"
#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstring>

namespace rhi::vulkan
{
namespace
{
constexpr uint32_t kNoFamily = ~0u;

uint32_t findQueueFamily(const Instance& instance, VkPhysicalDevice physicalDevice)
{
    const PFN_vkGetPhysicalDeviceQueueFamilyProperties get =
        instance.load()("vkGetPhysicalDeviceQueueFamilyProperties");
    uint32_t count = 0;
    get(physicalDevice, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    get(physicalDevice, &count, families.data());
    for (uint32_t i = 0; i < count; i++)
        if (families[i].queueFlags & VK_QUEUE_COMPUTE_BIT) return i;
    return kNoFamily;
}

bool hasDeviceExtension(const Instance& instance, VkPhysicalDevice physicalDevice, const char* name)
{
    const PFN_vkEnumerateDeviceExtensionProperties enumerate = instance.load()("vkEnumerateDeviceExtensionProperties");
    uint32_t count = 0;
    check(enumerate(physicalDevice, nullptr, &count, nullptr), "Vulkan", "extensions of a device");
    std::vector<VkExtensionProperties> extensions(count);
    check(enumerate(physicalDevice, nullptr, &count, extensions.data()), "Vulkan", "extensions of a device");
    const auto isIt = [&](const VkExtensionProperties& e) { return std::strcmp(e.extensionName, name) == 0; };
    return std::any_of(extensions.begin(), extensions.end(), isIt);
}

/// The features above the baseline, chained as far as the version allows.
struct FeatureChain
{
    explicit FeatureChain(const AdapterFacts& facts)
    {
        features.pNext = &storage16;
        if (facts.apiVersion >= VK_API_VERSION_1_2) storage16.pNext = &float16;
        void*& tail = facts.apiVersion >= VK_API_VERSION_1_2 ? float16.pNext : storage16.pNext;
        if (facts.apiVersion >= VK_API_VERSION_1_3 || facts.hasSynchronization2Extension) tail = &sync2;
    }
    FeatureChain(const FeatureChain&) = delete; // its members point at one another
    FeatureChain& operator=(const FeatureChain&) = delete;

    VkPhysicalDeviceFeatures2 features =
        vkStruct<VkPhysicalDeviceFeatures2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2);
    VkPhysicalDevice16BitStorageFeatures storage16 =
        vkStruct<VkPhysicalDevice16BitStorageFeatures>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_16BIT_STORAGE_FEATURES);
    VkPhysicalDeviceShaderFloat16Int8Features float16 = vkStruct<VkPhysicalDeviceShaderFloat16Int8Features>(
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_FLOAT16_INT8_FEATURES);
    VkPhysicalDeviceSynchronization2Features sync2 = vkStruct<VkPhysicalDeviceSynchronization2Features>(
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SYNCHRONIZATION_2_FEATURES);
};

std::string lowerCase(std::string text)
{
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

void readProperties(const Instance& instance, VkPhysicalDevice physicalDevice, AdapterFacts& facts)
{
    auto driver = vkStruct<VkPhysicalDeviceDriverProperties>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES);
    auto properties = vkStruct<VkPhysicalDeviceProperties2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2);
    const PFN_vkGetPhysicalDeviceProperties getOld = instance.load()("vkGetPhysicalDeviceProperties");
    getOld(physicalDevice, &properties.properties);
    facts.apiVersion = std::min(properties.properties.apiVersion, instance.apiVersion());
    facts.adapter.name = properties.properties.deviceName;
    facts.adapter.isSoftware = properties.properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
    if (facts.apiVersion < VK_API_VERSION_1_2) return;
    properties.pNext = &driver;
    const PFN_vkGetPhysicalDeviceProperties2 get = instance.load()("vkGetPhysicalDeviceProperties2");
    get(physicalDevice, &properties);
    facts.adapter.driver = std::string(driver.driverName) + " " + driver.driverInfo;
}
} // namespace

AdapterFacts inspectAdapter(const Instance& instance, VkPhysicalDevice physicalDevice)
{
    AdapterFacts facts;
    readProperties(instance, physicalDevice, facts);
    facts.queueFamilyIndex = findQueueFamily(instance, physicalDevice);
    if (facts.apiVersion < VK_API_VERSION_1_1)
        facts.adapter.missing = "Vulkan 1.1";
    else if (facts.queueFamilyIndex == kNoFamily)
        facts.adapter.missing = "a queue with compute";
    if (!facts.adapter.missing.empty()) return facts;

    facts.hasSynchronization2Extension =
        facts.apiVersion < VK_API_VERSION_1_3 &&
        hasDeviceExtension(instance, physicalDevice, VK_KHR_SYNCHRONIZATION_2_EXTENSION_NAME);
    FeatureChain chain(facts);
    const PFN_vkGetPhysicalDeviceFeatures2 getFeatures = instance.load()("vkGetPhysicalDeviceFeatures2");
    getFeatures(physicalDevice, &chain.features);
    facts.hasSynchronization2 = chain.sync2.synchronization2;
    facts.hasFloat16 = chain.float16.shaderFloat16 && chain.storage16.storageBuffer16BitAccess;
    if (const char* missing = findMissingVulkanFeature(chain.features.features))
        facts.adapter.missing = std::string("the feature ") + missing;
    return facts;
}

OwnedDevice::OwnedDevice(const VulkanDeviceDesc& desc) : m_instance(desc)
{
    createDevice(chooseAdapter(desc.adapter), desc.isSynchronization2Allowed);
}

AdapterFacts OwnedDevice::chooseAdapter(const std::string& wanted)
{
    size_t wantedIndex = ~size_t{0};
    std::from_chars(wanted.data(), wanted.data() + wanted.size(), wantedIndex);
    const bool isIndex = !wanted.empty() && std::all_of(wanted.begin(), wanted.end(),
                                                        [](unsigned char c) { return std::isdigit(c) != 0; });
    std::string names;
    AdapterFacts best;
    const std::vector<VkPhysicalDevice> devices = m_instance.physicalDevices();
    for (size_t i = 0; i < devices.size(); i++)
    {
        const AdapterFacts facts = inspectAdapter(m_instance, devices[i]);
        names += (names.empty() ? "" : ", ") + std::to_string(i) + " '" + facts.adapter.name + "'";
        const bool isMatch =
            isIndex ? i == wantedIndex : lowerCase(facts.adapter.name).find(lowerCase(wanted)) != std::string::npos;
        if (!isMatch) continue;
        if (!facts.adapter.missing.empty())
        {
            names += " (lacks " + facts.adapter.missing + ")";
            continue;
        }
        const bool isBetter = !m_native.physicalDevice || (best.adapter.isSoftware && !facts.adapter.isSoftware);
        if (!isBetter) continue;
        best = facts;
        m_native.physicalDevice = devices[i];
    }
    if (!m_native.physicalDevice)
        throw Error(ErrorCode::Unsupported, sentence("no Vulkan device matches '%s'; there are: %s", wanted.c_str(),
                                                     names.empty() ? "none" : names.c_str()));
    return best;
}

void OwnedDevice::createDevice(const AdapterFacts& facts, bool isSynchronization2Allowed)
{
    FeatureChain chain(facts);
    chain.features.features = requiredVulkanFeatures().features;
    chain.sync2.synchronization2 = facts.hasSynchronization2 && isSynchronization2Allowed;
    chain.float16.shaderFloat16 = facts.hasFloat16;
    chain.storage16.storageBuffer16BitAccess = facts.hasFloat16;

    std::vector<const char*> extensions;
    if (facts.hasSynchronization2Extension) extensions.push_back(VK_KHR_SYNCHRONIZATION_2_EXTENSION_NAME);
    constexpr const char* kPortability = "VK_KHR_portability_subset"; // to be enabled wherever it is offered
    if (hasDeviceExtension(m_instance, m_native.physicalDevice, kPortability)) extensions.push_back(kPortability);

    const float priority = 1.0f;
    auto queueInfo = vkStruct<VkDeviceQueueCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO);
    queueInfo.queueFamilyIndex = facts.queueFamilyIndex;
    queueInfo.queueCount = 1;
    queueInfo.pQueuePriorities = &priority;
    auto info = vkStruct<VkDeviceCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO);
    info.pNext = &chain.features;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queueInfo;
    info.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    VkDevice device = VK_NULL_HANDLE;
    const PFN_vkCreateDevice create = m_instance.load()("vkCreateDevice");
    check(create(m_native.physicalDevice, &info, nullptr, &device), "device", facts.adapter.name.c_str());

    adopt(device, facts.queueFamilyIndex);
    m_native.isSynchronization2Enabled = chain.sync2.synchronization2;
    m_native.isFloat16Enabled = facts.hasFloat16;
    m_native.isDebugUtilsEnabled = m_instance.hasDebugUtils();
}

void OwnedDevice::adopt(VkDevice device, uint32_t queueFamilyIndex)
{
    m_native.getInstanceProcAddr = m_instance.load()("vkGetInstanceProcAddr");
    m_native.getDeviceProcAddr = m_instance.load()("vkGetDeviceProcAddr");
    const Loader load(m_native.getDeviceProcAddr, device);
    m_device = {device, DeviceDeleter{load("vkDestroyDevice")}};
    const PFN_vkGetDeviceQueue getQueue = load("vkGetDeviceQueue");
    getQueue(device, queueFamilyIndex, 0, &m_native.queue);
    m_native.instance = m_instance.get();
    m_native.device = device;
    m_native.queueFamilyIndex = queueFamilyIndex;
}
} // namespace rhi::vulkan

namespace rhi
{
std::vector<VulkanAdapter> listVulkanAdapters()
{
    const vulkan::Instance instance({});
    std::vector<VulkanAdapter> adapters;
    for (const VkPhysicalDevice physicalDevice : instance.physicalDevices())
        adapters.push_back(vulkan::inspectAdapter(instance, physicalDevice).adapter);
    return adapters;
}

std::unique_ptr<Device> makeVulkanDevice(const VulkanDeviceDesc& desc)
{
    auto owned = std::make_unique<vulkan::OwnedDevice>(desc);
    const VulkanNativeDevice native = owned->native();
    return std::make_unique<vulkan::Device>(std::move(owned), native);
}
} // namespace rhi
