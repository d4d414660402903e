// What every Vulkan object needs of its device: handles, functions, and the owner template.
#pragma once
#include "functions.h"
#include "ledger.h"
#include <rhi/device.h>
#include <rhi/vulkan.h>
#include <utility>

namespace rhi::vulkan
{
struct Context
{
    explicit Context(const VulkanNativeDevice& native);

    VkInstance instance;
    VkPhysicalDevice physicalDevice;
    VkDevice device;
    uint32_t queueFamilyIndex;
    VkQueue queue;
    VkPipelineCache pipelineCache;
    const VkAllocationCallbacks* callbacks;
    PFN_vkGetInstanceProcAddr getInstanceProcAddr;
    PFN_vkGetDeviceProcAddr getDeviceProcAddr;
    InstanceFunctions instanceFn;
    DeviceFunctions fn;
    DebugFunctions debugFn;
    DeviceInfo info;
    VkPhysicalDeviceMemoryProperties memoryProperties = {};
    mutable MemoryLedger ledger;

    template <class T> void setName(VkObjectType type, T handle, const char* name) const
    {
        setNameOf(type, rhi::detail::toHandle(handle), name);
    }

private:
    void setNameOf(VkObjectType type, uint64_t handle, const char* name) const;
};

/// Throws the error that `result` stands for; `what` is the object or the call, as it begins the sentence.
void check(VkResult result, const char* what, const char* name);

/// A Vulkan structure with its type set and everything else zero.
template <class T> T vkStruct(VkStructureType type)
{
    T result = {};
    result.sType = type;
    return result;
}

/// Owns one Vulkan object; `Destroy` is the member of DeviceFunctions that destroys or frees it.
template <class T, auto Destroy> class Unique
{
public:
    Unique() = default;
    Unique(const Context& context, T handle) : m_context(&context), m_handle(handle) {}
    Unique(Unique&& other) noexcept
        : m_context(other.m_context), m_handle(std::exchange(other.m_handle, T{VK_NULL_HANDLE}))
    {
    }
    Unique& operator=(Unique other) noexcept
    {
        std::swap(m_context, other.m_context);
        std::swap(m_handle, other.m_handle);
        return *this;
    }
    ~Unique()
    {
        if (m_handle) (m_context->fn.*Destroy)(m_context->device, m_handle, m_context->callbacks);
    }
    T get() const { return m_handle; }

private:
    const Context* m_context = nullptr;
    T m_handle = VK_NULL_HANDLE;
};

using UniqueMemory = Unique<VkDeviceMemory, &DeviceFunctions::freeMemory>;
using UniqueImage = Unique<VkImage, &DeviceFunctions::destroyImage>;
using UniqueImageView = Unique<VkImageView, &DeviceFunctions::destroyImageView>;
using UniqueBuffer = Unique<VkBuffer, &DeviceFunctions::destroyBuffer>;
using UniqueSampler = Unique<VkSampler, &DeviceFunctions::destroySampler>;
using UniqueSetLayout = Unique<VkDescriptorSetLayout, &DeviceFunctions::destroyDescriptorSetLayout>;
using UniquePipelineLayout = Unique<VkPipelineLayout, &DeviceFunctions::destroyPipelineLayout>;
using UniqueShaderModule = Unique<VkShaderModule, &DeviceFunctions::destroyShaderModule>;
using UniquePipeline = Unique<VkPipeline, &DeviceFunctions::destroyPipeline>;
using UniqueDescriptorPool = Unique<VkDescriptorPool, &DeviceFunctions::destroyDescriptorPool>;
using UniqueQueryPool = Unique<VkQueryPool, &DeviceFunctions::destroyQueryPool>;
using UniqueFence = Unique<VkFence, &DeviceFunctions::destroyFence>;
using UniqueCommandPool = Unique<VkCommandPool, &DeviceFunctions::destroyCommandPool>;
} // namespace rhi::vulkan
