// The Vulkan functions of one instance and one device. Each line is a member, its type and the name it is loaded by.
#pragma once
#include <rhi/error.h>
#include <string>
#include <vulkan/vulkan_core.h>

namespace rhi::vulkan
{
/// Loads functions by name; what it returns converts to any function pointer type.
class Loader
{
public:
    class Function
    {
    public:
        explicit Function(PFN_vkVoidFunction function) : m_function(function) {}
        template <class F> operator F() const { return reinterpret_cast<F>(m_function); }

    private:
        PFN_vkVoidFunction m_function;
    };

    Loader(PFN_vkGetInstanceProcAddr get, VkInstance instance) : m_getInstance(get), m_instance(instance) {}
    Loader(PFN_vkGetDeviceProcAddr get, VkDevice device) : m_getDevice(get), m_device(device) {}

    Function optional(const char* name) const
    {
        return Function(m_getDevice ? m_getDevice(m_device, name) : m_getInstance(m_instance, name));
    }
    Function operator()(const char* name) const
    {
        const PFN_vkVoidFunction function = optional(name);
        if (!function) throw Error(ErrorCode::Unsupported, std::string("the Vulkan driver has no function ") + name);
        return Function(function);
    }
    /// A function of a later version, or the extension it came from.
    Function either(const char* name, const char* extensionName) const
    {
        const PFN_vkVoidFunction function = optional(name);
        return function ? Function(function) : optional(extensionName);
    }

private:
    PFN_vkGetInstanceProcAddr m_getInstance = nullptr;
    VkInstance m_instance = VK_NULL_HANDLE;
    PFN_vkGetDeviceProcAddr m_getDevice = nullptr;
    VkDevice m_device = VK_NULL_HANDLE;
};

struct InstanceFunctions
{
    Loader load;
    PFN_vkGetPhysicalDeviceProperties2 getPhysicalDeviceProperties2 = load("vkGetPhysicalDeviceProperties2");
    PFN_vkGetPhysicalDeviceFormatProperties getFormatProperties = load("vkGetPhysicalDeviceFormatProperties");
    PFN_vkGetPhysicalDeviceMemoryProperties getMemoryProperties = load("vkGetPhysicalDeviceMemoryProperties");
    PFN_vkGetPhysicalDeviceQueueFamilyProperties getQueueFamilyProperties =
        load("vkGetPhysicalDeviceQueueFamilyProperties");
};

struct DeviceFunctions
{
    Loader load;
    PFN_vkGetDeviceQueue getDeviceQueue = load("vkGetDeviceQueue");
    PFN_vkQueueSubmit queueSubmit = load("vkQueueSubmit");
    PFN_vkQueueWaitIdle queueWaitIdle = load("vkQueueWaitIdle");
    PFN_vkAllocateMemory allocateMemory = load("vkAllocateMemory");
    PFN_vkFreeMemory freeMemory = load("vkFreeMemory");
    PFN_vkMapMemory mapMemory = load("vkMapMemory");
    PFN_vkCreateImage createImage = load("vkCreateImage");
    PFN_vkDestroyImage destroyImage = load("vkDestroyImage");
    PFN_vkGetImageMemoryRequirements getImageMemoryRequirements = load("vkGetImageMemoryRequirements");
    PFN_vkBindImageMemory bindImageMemory = load("vkBindImageMemory");
    PFN_vkCreateImageView createImageView = load("vkCreateImageView");
    PFN_vkDestroyImageView destroyImageView = load("vkDestroyImageView");
    PFN_vkCreateBuffer createBuffer = load("vkCreateBuffer");
    PFN_vkDestroyBuffer destroyBuffer = load("vkDestroyBuffer");
    PFN_vkGetBufferMemoryRequirements getBufferMemoryRequirements = load("vkGetBufferMemoryRequirements");
    PFN_vkBindBufferMemory bindBufferMemory = load("vkBindBufferMemory");
    PFN_vkCreateSampler createSampler = load("vkCreateSampler");
    PFN_vkDestroySampler destroySampler = load("vkDestroySampler");
    PFN_vkCreateDescriptorSetLayout createDescriptorSetLayout = load("vkCreateDescriptorSetLayout");
    PFN_vkDestroyDescriptorSetLayout destroyDescriptorSetLayout = load("vkDestroyDescriptorSetLayout");
    PFN_vkCreatePipelineLayout createPipelineLayout = load("vkCreatePipelineLayout");
    PFN_vkDestroyPipelineLayout destroyPipelineLayout = load("vkDestroyPipelineLayout");
    PFN_vkCreateShaderModule createShaderModule = load("vkCreateShaderModule");
    PFN_vkDestroyShaderModule destroyShaderModule = load("vkDestroyShaderModule");
    PFN_vkCreateComputePipelines createComputePipelines = load("vkCreateComputePipelines");
    PFN_vkDestroyPipeline destroyPipeline = load("vkDestroyPipeline");
    PFN_vkCreateDescriptorPool createDescriptorPool = load("vkCreateDescriptorPool");
    PFN_vkDestroyDescriptorPool destroyDescriptorPool = load("vkDestroyDescriptorPool");
    PFN_vkResetDescriptorPool resetDescriptorPool = load("vkResetDescriptorPool");
    PFN_vkAllocateDescriptorSets allocateDescriptorSets = load("vkAllocateDescriptorSets");
    PFN_vkUpdateDescriptorSets updateDescriptorSets = load("vkUpdateDescriptorSets");
    PFN_vkCreateQueryPool createQueryPool = load("vkCreateQueryPool");
    PFN_vkDestroyQueryPool destroyQueryPool = load("vkDestroyQueryPool");
    PFN_vkGetQueryPoolResults getQueryPoolResults = load("vkGetQueryPoolResults");
    PFN_vkCreateFence createFence = load("vkCreateFence");
    PFN_vkDestroyFence destroyFence = load("vkDestroyFence");
    PFN_vkGetFenceStatus getFenceStatus = load("vkGetFenceStatus");
    PFN_vkWaitForFences waitForFences = load("vkWaitForFences");
    PFN_vkResetFences resetFences = load("vkResetFences");
    PFN_vkCreateCommandPool createCommandPool = load("vkCreateCommandPool");
    PFN_vkDestroyCommandPool destroyCommandPool = load("vkDestroyCommandPool");
    PFN_vkResetCommandPool resetCommandPool = load("vkResetCommandPool");
    PFN_vkAllocateCommandBuffers allocateCommandBuffers = load("vkAllocateCommandBuffers");
    PFN_vkBeginCommandBuffer beginCommandBuffer = load("vkBeginCommandBuffer");
    PFN_vkEndCommandBuffer endCommandBuffer = load("vkEndCommandBuffer");
    PFN_vkCmdBindPipeline cmdBindPipeline = load("vkCmdBindPipeline");
    PFN_vkCmdBindDescriptorSets cmdBindDescriptorSets = load("vkCmdBindDescriptorSets");
    PFN_vkCmdDispatch cmdDispatch = load("vkCmdDispatch");
    PFN_vkCmdDispatchIndirect cmdDispatchIndirect = load("vkCmdDispatchIndirect");
    PFN_vkCmdPipelineBarrier cmdPipelineBarrier = load("vkCmdPipelineBarrier");
    PFN_vkCmdCopyBufferToImage cmdCopyBufferToImage = load("vkCmdCopyBufferToImage");
    PFN_vkCmdCopyImageToBuffer cmdCopyImageToBuffer = load("vkCmdCopyImageToBuffer");
    PFN_vkCmdCopyImage cmdCopyImage = load("vkCmdCopyImage");
    PFN_vkCmdCopyBuffer cmdCopyBuffer = load("vkCmdCopyBuffer");
    PFN_vkCmdFillBuffer cmdFillBuffer = load("vkCmdFillBuffer");
    PFN_vkCmdClearColorImage cmdClearColorImage = load("vkCmdClearColorImage");
    PFN_vkCmdResetQueryPool cmdResetQueryPool = load("vkCmdResetQueryPool");
    PFN_vkCmdWriteTimestamp cmdWriteTimestamp = load("vkCmdWriteTimestamp");
    PFN_vkCmdPipelineBarrier2 cmdPipelineBarrier2 =
        load.either("vkCmdPipelineBarrier2", "vkCmdPipelineBarrier2KHR"); // null without synchronization2
};

/// Null pointers without VK_EXT_debug_utils. They are instance functions, but trampolines take any device.
struct DebugFunctions
{
    PFN_vkSetDebugUtilsObjectNameEXT setObjectName = nullptr;
    PFN_vkCmdBeginDebugUtilsLabelEXT cmdBeginLabel = nullptr;
    PFN_vkCmdEndDebugUtilsLabelEXT cmdEndLabel = nullptr;
};
} // namespace rhi::vulkan
