// Makes or wraps a Vulkan device, and gives native objects back. The only public header that names Vulkan; it needs the
// types only: every function is loaded through the device, and the engine need not link the loader.
#pragma once
#include <functional>
#include <memory>
#include <rhi/device.h>
#include <string>
#include <vector>
#include <vulkan/vulkan_core.h>

namespace rhi
{
enum class MessageSeverity : uint8_t
{
    Info,
    Warning,
    Error,
};
using VulkanMessageCallback = std::function<void(MessageSeverity severity, const std::string& text)>;

struct VulkanAdapter
{
    std::string name;
    std::string driver; // name and version, may be empty
    bool isSoftware = false;
    std::string missing; // the first requirement it lacks, empty if it can be used
};

/// For headless use: an instance and a device of our own.
struct VulkanDeviceDesc
{
    /// Index into listVulkanAdapters(), or part of a name (case does not matter). Empty: the first that can be used,
    /// GPUs before software.
    std::string adapter;
    bool isValidationEnabled = false;      // VK_LAYER_KHRONOS_validation; throws Unsupported where it is not installed
    bool isSyncValidationEnabled = false;  // and its synchronisation validation
    bool isSynchronization2Allowed = true; // false: barriers of Vulkan 1.0 even where there are newer ones
    VulkanMessageCallback messageCallback; // validation messages; called from any thread
};

/// Native objects of the engine; all stay the engine's and must outlive the device made from them.
struct VulkanNativeDevice
{
    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physicalDevice = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    uint32_t queueFamilyIndex = 0;  // family of the command buffers to be wrapped; must have compute
    VkQueue queue = VK_NULL_HANDLE; // needed only for submit() and waitIdle()
    PFN_vkGetInstanceProcAddr getInstanceProcAddr = nullptr;
    PFN_vkGetDeviceProcAddr getDeviceProcAddr = nullptr; // null: taken from getInstanceProcAddr
    /// What the device was created with. Null: taken as everything that requiredVulkanFeatures() asks for.
    const VkPhysicalDeviceFeatures* enabledFeatures = nullptr;
    bool isSynchronization2Enabled = false;         // the feature, through Vulkan 1.3 or VK_KHR_synchronization2
    bool isDebugUtilsEnabled = false;               // VK_EXT_debug_utils on the instance
    bool isFloat16Enabled = false;                  // shaderFloat16 and storageBuffer16BitAccess
    VkPipelineCache pipelineCache = VK_NULL_HANDLE; // may be null
    const VkAllocationCallbacks* allocationCallbacks = nullptr; // may be null; passed to every call that takes them
};

/// What a device must have been created with to be wrapped. Ask before creating it.
struct VulkanRequirements
{
    uint32_t apiVersion = VK_API_VERSION_1_1;  // of the instance and the device, at least
    VkPhysicalDeviceFeatures features = {};    // the fields that are VK_TRUE must be enabled
    std::vector<const char*> deviceExtensions; // must be enabled; empty with Vulkan 1.1
};
VulkanRequirements requiredVulkanFeatures();
/// The name of the first required feature that is not enabled, or null.
const char* findMissingVulkanFeature(const VkPhysicalDeviceFeatures& enabled);

std::vector<VulkanAdapter> listVulkanAdapters();
std::unique_ptr<Device> makeVulkanDevice(const VulkanDeviceDesc& desc);
std::unique_ptr<Device> wrapVulkanDevice(const VulkanNativeDevice& native);

/// Handles of the device; null handles for a device that is not made of Vulkan.
struct VulkanHandles
{
    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physicalDevice = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    VkQueue queue = VK_NULL_HANDLE;
    uint32_t queueFamilyIndex = 0;
    PFN_vkGetInstanceProcAddr getInstanceProcAddr = nullptr;
    PFN_vkGetDeviceProcAddr getDeviceProcAddr = nullptr;
};
VulkanHandles vulkanHandles(const Device& device);

VkFormat toVulkan(Format format);
Format fromVulkan(VkFormat format); // Unknown if there is no such format here
/// The state as the RHI names it; Layout::Native with the given numbers where it has no name for it.
TextureState fromVulkan(VkImageLayout layout, VkAccessFlags2 access, VkPipelineStageFlags2 stages);
/// The same state in Vulkan's numbers.
NativeState toVulkan(const TextureState& state);

namespace detail
{
template <class Handle> uint64_t toHandle(Handle handle)
{
    uint64_t value = 0;
    static_assert(sizeof(handle) <= sizeof(value));
    if constexpr (std::is_pointer_v<Handle>)
        value = reinterpret_cast<uintptr_t>(handle);
    else
        value = handle;
    return value;
}
template <class Handle> Handle fromHandle(uint64_t value)
{
    if constexpr (std::is_pointer_v<Handle>)
        return reinterpret_cast<Handle>(static_cast<uintptr_t>(value));
    else
        return value;
}
} // namespace detail

/// The description's usage must be part of the usage the image was created with.
inline std::unique_ptr<Texture> wrapVulkanTexture(Device& device, VkImage image, const TextureDesc& desc)
{
    return device.wrapTexture(detail::toHandle(image), desc);
}
inline std::unique_ptr<Buffer> wrapVulkanBuffer(Device& device, VkBuffer buffer, const BufferDesc& desc)
{
    return device.wrapBuffer(detail::toHandle(buffer), desc);
}
inline std::unique_ptr<Memory> wrapVulkanMemory(Device& device, VkDeviceMemory memory, const MemoryDesc& desc)
{
    return device.wrapMemory(detail::toHandle(memory), desc);
}
/// The command buffer is in the recording state and outside a render pass.
inline std::unique_ptr<CommandBuffer> wrapVulkanCommandBuffer(Device& device, VkCommandBuffer commandBuffer,
                                                              const char* name = "engine's command buffer")
{
    return device.wrapCommandBuffer(detail::toHandle(commandBuffer), name);
}

inline VkImage vulkanImage(const Texture& texture) { return detail::fromHandle<VkImage>(texture.nativeHandle()); }
inline VkDeviceMemory vulkanMemory(const Memory& memory)
{
    return detail::fromHandle<VkDeviceMemory>(memory.nativeHandle());
}
inline VkImageView vulkanImageView(const TextureView& view)
{
    return detail::fromHandle<VkImageView>(view.nativeHandle());
}
inline VkBuffer vulkanBuffer(const Buffer& buffer) { return detail::fromHandle<VkBuffer>(buffer.nativeHandle()); }
inline VkCommandBuffer vulkanCommandBuffer(const CommandBuffer& commandBuffer)
{
    return detail::fromHandle<VkCommandBuffer>(commandBuffer.nativeHandle());
}
inline VkPipeline vulkanPipeline(const Pipeline& pipeline)
{
    return detail::fromHandle<VkPipeline>(pipeline.nativeHandle());
}
} // namespace rhi
