// The formats and kinds of descriptors of the library as Vulkan has them.
#pragma once
#include <iterator>
#include <nrd/types.h>
#include <vulkan/vulkan.h>

namespace example
{
// In the order of nrd::Format.
// clang-format off
inline constexpr VkFormat kFormats[] = {
    VK_FORMAT_R8_UNORM, VK_FORMAT_R8_SNORM, VK_FORMAT_R8_UINT, VK_FORMAT_R8G8_UNORM,
    VK_FORMAT_R8G8_UINT, VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_R8G8B8A8_SNORM, VK_FORMAT_R16_UNORM,
    VK_FORMAT_R16_UINT, VK_FORMAT_R16_SFLOAT, VK_FORMAT_R16G16_UNORM, VK_FORMAT_R16G16_SFLOAT,
    VK_FORMAT_R16G16B16A16_UNORM, VK_FORMAT_R16G16B16A16_SNORM, VK_FORMAT_R16G16B16A16_SFLOAT, VK_FORMAT_R32_UINT,
    VK_FORMAT_R32_SFLOAT, VK_FORMAT_R32G32_UINT, VK_FORMAT_R32G32_SFLOAT, VK_FORMAT_R32G32B32A32_SFLOAT,
    VK_FORMAT_A2B10G10R10_UNORM_PACK32, VK_FORMAT_B10G11R11_UFLOAT_PACK32, VK_FORMAT_E5B9G9R9_UFLOAT_PACK32,
};
// clang-format on
static_assert(std::size(kFormats) == static_cast<size_t>(nrd::Format::MAX_NUM));

inline VkDescriptorType toVulkan(nrd::DescriptorType type)
{
    constexpr VkDescriptorType kTypes[] = {VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE,
                                           VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};
    return kTypes[static_cast<uint32_t>(type)];
}
} // namespace example
