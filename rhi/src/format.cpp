#include <rhi/format.h>

namespace rhi
{
const FormatInfo& formatInfo(Format format)
{
    using enum FormatClass;
    static constexpr FormatInfo kUnknown = {"Unknown", 0, 0, Float};
    static constexpr FormatInfo kInfos[] = {
        kUnknown,
        {"R8_UNORM", 1, 1, Float},
        {"R8_SNORM", 1, 1, Float},
        {"R8_UINT", 1, 1, Uint},
        {"R8_SINT", 1, 1, Int},
        {"RG8_UNORM", 2, 2, Float},
        {"RG8_SNORM", 2, 2, Float},
        {"RG8_UINT", 2, 2, Uint},
        {"RG8_SINT", 2, 2, Int},
        {"RGBA8_UNORM", 4, 4, Float},
        {"RGBA8_SNORM", 4, 4, Float},
        {"RGBA8_UINT", 4, 4, Uint},
        {"RGBA8_SINT", 4, 4, Int},
        {"RGBA8_SRGB", 4, 4, Float},
        {"BGRA8_UNORM", 4, 4, Float},
        {"R16_UNORM", 2, 1, Float},
        {"R16_SNORM", 2, 1, Float},
        {"R16_UINT", 2, 1, Uint},
        {"R16_SINT", 2, 1, Int},
        {"R16_SFLOAT", 2, 1, Float},
        {"RG16_UNORM", 4, 2, Float},
        {"RG16_SNORM", 4, 2, Float},
        {"RG16_UINT", 4, 2, Uint},
        {"RG16_SINT", 4, 2, Int},
        {"RG16_SFLOAT", 4, 2, Float},
        {"RGBA16_UNORM", 8, 4, Float},
        {"RGBA16_SNORM", 8, 4, Float},
        {"RGBA16_UINT", 8, 4, Uint},
        {"RGBA16_SINT", 8, 4, Int},
        {"RGBA16_SFLOAT", 8, 4, Float},
        {"R32_UINT", 4, 1, Uint},
        {"R32_SINT", 4, 1, Int},
        {"R32_SFLOAT", 4, 1, Float},
        {"RG32_UINT", 8, 2, Uint},
        {"RG32_SINT", 8, 2, Int},
        {"RG32_SFLOAT", 8, 2, Float},
        {"RGBA32_UINT", 16, 4, Uint},
        {"RGBA32_SINT", 16, 4, Int},
        {"RGBA32_SFLOAT", 16, 4, Float},
        {"A2B10G10R10_UNORM_PACK32", 4, 4, Float},
        {"A2B10G10R10_UINT_PACK32", 4, 4, Uint},
        {"A2R10G10B10_UNORM_PACK32", 4, 4, Float},
        {"B10G11R11_UFLOAT_PACK32", 4, 3, Float},
        {"E5B9G9R9_UFLOAT_PACK32", 4, 3, Float},
        {"D16_UNORM", 2, 1, Depth},
        {"D32_SFLOAT", 4, 1, Depth},
    };
    static_assert(std::size(kInfos) == static_cast<size_t>(Format::Count));
    const size_t index = static_cast<size_t>(format);
    return index < std::size(kInfos) ? kInfos[index] : kUnknown;
}
} // namespace rhi
