#include <rhi/vulkan.h>

namespace rhi
{
VkFormat toVulkan(Format format)
{
    switch (format)
    {
    case Format::Unknown:
        return VK_FORMAT_UNDEFINED;
    case Format::R8_UNORM:
        return VK_FORMAT_R8_UNORM;
    case Format::R8_SNORM:
        return VK_FORMAT_R8_SNORM;
    case Format::R8_UINT:
        return VK_FORMAT_R8_UINT;
    case Format::R8_SINT:
        return VK_FORMAT_R8_SINT;
    case Format::RG8_UNORM:
        return VK_FORMAT_R8G8_UNORM;
    case Format::RG8_SNORM:
        return VK_FORMAT_R8G8_SNORM;
    case Format::RG8_UINT:
        return VK_FORMAT_R8G8_UINT;
    case Format::RG8_SINT:
        return VK_FORMAT_R8G8_SINT;
    case Format::RGBA8_UNORM:
        return VK_FORMAT_R8G8B8A8_UNORM;
    case Format::RGBA8_SNORM:
        return VK_FORMAT_R8G8B8A8_SNORM;
    case Format::RGBA8_UINT:
        return VK_FORMAT_R8G8B8A8_UINT;
    case Format::RGBA8_SINT:
        return VK_FORMAT_R8G8B8A8_SINT;
    case Format::RGBA8_SRGB:
        return VK_FORMAT_R8G8B8A8_SRGB;
    case Format::BGRA8_UNORM:
        return VK_FORMAT_B8G8R8A8_UNORM;
    case Format::R16_UNORM:
        return VK_FORMAT_R16_UNORM;
    case Format::R16_SNORM:
        return VK_FORMAT_R16_SNORM;
    case Format::R16_UINT:
        return VK_FORMAT_R16_UINT;
    case Format::R16_SINT:
        return VK_FORMAT_R16_SINT;
    case Format::R16_SFLOAT:
        return VK_FORMAT_R16_SFLOAT;
    case Format::RG16_UNORM:
        return VK_FORMAT_R16G16_UNORM;
    case Format::RG16_SNORM:
        return VK_FORMAT_R16G16_SNORM;
    case Format::RG16_UINT:
        return VK_FORMAT_R16G16_UINT;
    case Format::RG16_SINT:
        return VK_FORMAT_R16G16_SINT;
    case Format::RG16_SFLOAT:
        return VK_FORMAT_R16G16_SFLOAT;
    case Format::RGBA16_UNORM:
        return VK_FORMAT_R16G16B16A16_UNORM;
    case Format::RGBA16_SNORM:
        return VK_FORMAT_R16G16B16A16_SNORM;
    case Format::RGBA16_UINT:
        return VK_FORMAT_R16G16B16A16_UINT;
    case Format::RGBA16_SINT:
        return VK_FORMAT_R16G16B16A16_SINT;
    case Format::RGBA16_SFLOAT:
        return VK_FORMAT_R16G16B16A16_SFLOAT;
    case Format::R32_UINT:
        return VK_FORMAT_R32_UINT;
    case Format::R32_SINT:
        return VK_FORMAT_R32_SINT;
    case Format::R32_SFLOAT:
        return VK_FORMAT_R32_SFLOAT;
    case Format::RG32_UINT:
        return VK_FORMAT_R32G32_UINT;
    case Format::RG32_SINT:
        return VK_FORMAT_R32G32_SINT;
    case Format::RG32_SFLOAT:
        return VK_FORMAT_R32G32_SFLOAT;
    case Format::RGBA32_UINT:
        return VK_FORMAT_R32G32B32A32_UINT;
    case Format::RGBA32_SINT:
        return VK_FORMAT_R32G32B32A32_SINT;
    case Format::RGBA32_SFLOAT:
        return VK_FORMAT_R32G32B32A32_SFLOAT;
    case Format::A2B10G10R10_UNORM_PACK32:
        return VK_FORMAT_A2B10G10R10_UNORM_PACK32;
    case Format::A2B10G10R10_UINT_PACK32:
        return VK_FORMAT_A2B10G10R10_UINT_PACK32;
    case Format::A2R10G10B10_UNORM_PACK32:
        return VK_FORMAT_A2R10G10B10_UNORM_PACK32;
    case Format::B10G11R11_UFLOAT_PACK32:
        return VK_FORMAT_B10G11R11_UFLOAT_PACK32;
    case Format::E5B9G9R9_UFLOAT_PACK32:
        return VK_FORMAT_E5B9G9R9_UFLOAT_PACK32;
    case Format::D16_UNORM:
        return VK_FORMAT_D16_UNORM;
    case Format::D32_SFLOAT:
        return VK_FORMAT_D32_SFLOAT;
    case Format::Count:
        break;
    }
    return VK_FORMAT_UNDEFINED;
}

Format fromVulkan(VkFormat format)
{
    for (uint32_t i = 0; i < static_cast<uint32_t>(Format::Count); i++)
        if (toVulkan(static_cast<Format>(i)) == format) return static_cast<Format>(i);
    return Format::Unknown;
}
} // namespace rhi
