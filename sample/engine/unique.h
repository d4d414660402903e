// Ownership of a Vulkan object as the type of a member; the empty owner is a borrowed handle.
#pragma once
#include <vulkan/vulkan.h>

#include <utility>

namespace engine
{
/// Destroys `handle` on `device` when it goes out of scope. Destroy is vkDestroyX or vkFreeMemory.
template <class T, auto Destroy> class Unique
{
public:
    Unique() = default;
    Unique(VkDevice device, T handle) : m_device(device), m_handle(handle) {}
    Unique(Unique&& other) noexcept
        : m_device(std::exchange(other.m_device, {})), m_handle(std::exchange(other.m_handle, {}))
    {
    }
    Unique& operator=(Unique other) noexcept
    {
        std::swap(m_device, other.m_device);
        std::swap(m_handle, other.m_handle);
        return *this;
    }
    ~Unique()
    {
        if (m_handle) Destroy(m_device, m_handle, nullptr);
    }
    T get() const { return m_handle; }
    VkDevice device() const { return m_device; }

private:
    VkDevice m_device = VK_NULL_HANDLE;
    T m_handle = VK_NULL_HANDLE;
};

using UniqueMemory = Unique<VkDeviceMemory, vkFreeMemory>;
using UniqueImage = Unique<VkImage, vkDestroyImage>;
using UniqueImageView = Unique<VkImageView, vkDestroyImageView>;
using UniqueBuffer = Unique<VkBuffer, vkDestroyBuffer>;
using UniqueBufferView = Unique<VkBufferView, vkDestroyBufferView>;
using UniqueSampler = Unique<VkSampler, vkDestroySampler>;
using UniqueSemaphore = Unique<VkSemaphore, vkDestroySemaphore>;
using UniqueRenderPass = Unique<VkRenderPass, vkDestroyRenderPass>;
using UniqueFramebuffer = Unique<VkFramebuffer, vkDestroyFramebuffer>;
using UniqueSwapchain = Unique<VkSwapchainKHR, vkDestroySwapchainKHR>;
using UniqueFence = Unique<VkFence, vkDestroyFence>;
using UniqueQueryPool = Unique<VkQueryPool, vkDestroyQueryPool>;
using UniqueCommandPool = Unique<VkCommandPool, vkDestroyCommandPool>;
using UniqueShaderModule = Unique<VkShaderModule, vkDestroyShaderModule>;
using UniqueSetLayout = Unique<VkDescriptorSetLayout, vkDestroyDescriptorSetLayout>;
using UniquePipelineLayout = Unique<VkPipelineLayout, vkDestroyPipelineLayout>;
using UniquePipeline = Unique<VkPipeline, vkDestroyPipeline>;
using UniqueDescriptorPool = Unique<VkDescriptorPool, vkDestroyDescriptorPool>;
} // namespace engine
