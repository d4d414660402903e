// Enumerations of the RHI in Vulkan's numbers. Formats and states are public, in rhi/vulkan.h.
#pragma once
#include <rhi/commands.h>
#include <rhi/vulkan.h>

namespace rhi::vulkan
{
VkImageUsageFlags toVulkan(TextureUsage usage);
VkBufferUsageFlags toVulkan(BufferUsage usage);
VkDescriptorType toVulkan(BindingType type);
VkImageLayout toVulkan(Layout layout); // Undefined for Native, whose layout is in the state
NativeState toVulkan(const BufferState& state);
NativeState toVulkan(const MemoryState& state);
FormatSupport toFormatSupport(VkFormatFeatureFlags features);
VkImageAspectFlags aspectOf(Format format);

/// The numbers of synchronization2 in those of Vulkan 1.0; stages and accesses that are newer become the older ones
/// that contain them. `noStage` stands for no stage, which Vulkan 1.0 cannot express.
struct LegacyScope
{
    VkPipelineStageFlags stages = 0;
    VkAccessFlags access = 0;
};
LegacyScope toLegacy(const NativeState& state, VkPipelineStageFlags noStage);
} // namespace rhi::vulkan
