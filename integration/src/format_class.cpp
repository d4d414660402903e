#include "format_class.h"

namespace nrd
{
namespace
{
FormatRange rangeOf(rhi::Format format)
{
    using F = rhi::Format;
    switch (format)
    {
    case F::R8_UNORM:
    case F::RG8_UNORM:
    case F::RGBA8_UNORM:
    case F::RGBA8_SRGB:
    case F::BGRA8_UNORM:
    case F::R16_UNORM:
    case F::RG16_UNORM:
    case F::RGBA16_UNORM:
    case F::A2B10G10R10_UNORM_PACK32:
    case F::A2R10G10B10_UNORM_PACK32:
    case F::D16_UNORM:
        return FormatRange::Unorm;
    case F::R8_SNORM:
    case F::RG8_SNORM:
    case F::RGBA8_SNORM:
    case F::R16_SNORM:
    case F::RG16_SNORM:
    case F::RGBA16_SNORM:
        return FormatRange::Snorm;
    case F::R16_SFLOAT:
    case F::RG16_SFLOAT:
    case F::RGBA16_SFLOAT:
    case F::R32_SFLOAT:
    case F::RG32_SFLOAT:
    case F::RGBA32_SFLOAT:
    case F::B10G11R11_UFLOAT_PACK32:
    case F::E5B9G9R9_UFLOAT_PACK32:
    case F::D32_SFLOAT:
        return FormatRange::Float;
    case F::Unknown:
    case F::R8_UINT:
    case F::R8_SINT:
    case F::RG8_UINT:
    case F::RG8_SINT:
    case F::RGBA8_UINT:
    case F::RGBA8_SINT:
    case F::R16_UINT:
    case F::R16_SINT:
    case F::RG16_UINT:
    case F::RG16_SINT:
    case F::RGBA16_UINT:
    case F::RGBA16_SINT:
    case F::R32_UINT:
    case F::R32_SINT:
    case F::RG32_UINT:
    case F::RG32_SINT:
    case F::RGBA32_UINT:
    case F::RGBA32_SINT:
    case F::A2B10G10R10_UINT_PACK32:
    case F::Count:
        break;
    }
    return FormatRange::Integer;
}

uint8_t bitsOf(rhi::Format format, const rhi::FormatInfo& info)
{
    if (format == rhi::Format::A2B10G10R10_UNORM_PACK32 || format == rhi::Format::A2R10G10B10_UNORM_PACK32) return 2;
    if (format == rhi::Format::E5B9G9R9_UFLOAT_PACK32) return 9;
    return info.componentCount == 0 ? uint8_t(0) : static_cast<uint8_t>(info.texelSize * 8u / info.componentCount);
}
} // namespace

FormatClass formatClass(rhi::Format format)
{
    const rhi::FormatInfo& info = rhi::formatInfo(format);
    return {rangeOf(format), info.componentCount, bitsOf(format, info)};
}

bool isAtLeast(rhi::Format format, rhi::Format minimum)
{
    const FormatClass given = formatClass(format);
    const FormatClass needed = formatClass(minimum);
    if (given.channelCount < needed.channelCount || given.bitCount < needed.bitCount) return false;
    const bool isGivenInteger = given.range == FormatRange::Integer;
    const bool isNeededInteger = needed.range == FormatRange::Integer;
    if (isGivenInteger || isNeededInteger) return isGivenInteger && isNeededInteger;
    return given.range >= needed.range; // each range contains the ones before it
}

bool suits(rhi::Format format, NormalEncoding encoding)
{
    using F = rhi::Format;
    switch (encoding)
    {
    case NormalEncoding::RGBA8_UNORM:
        return format == F::RGBA8_UNORM || format == F::BGRA8_UNORM;
    case NormalEncoding::RGBA8_SNORM:
        return format == F::RGBA8_SNORM;
    case NormalEncoding::R10_G10_B10_A2_UNORM:
        return format == F::A2B10G10R10_UNORM_PACK32 || format == F::A2R10G10B10_UNORM_PACK32;
    case NormalEncoding::RGBA16_UNORM:
        return format == F::RGBA16_UNORM;
    case NormalEncoding::RGBA16_SNORM:
        return format == F::RGBA16_SNORM || format == F::RGBA16_SFLOAT || format == F::RGBA32_SFLOAT;
    case NormalEncoding::MAX_NUM:
        break;
    }
    return false;
}

const char* expectedFormat(NormalEncoding encoding)
{
    switch (encoding)
    {
    case NormalEncoding::RGBA8_UNORM:
        return "RGBA8_UNORM";
    case NormalEncoding::RGBA8_SNORM:
        return "RGBA8_SNORM";
    case NormalEncoding::R10_G10_B10_A2_UNORM:
        return "A2B10G10R10_UNORM_PACK32 (or A2R10G10B10)";
    case NormalEncoding::RGBA16_UNORM:
        return "RGBA16_UNORM";
    case NormalEncoding::RGBA16_SNORM:
        return "RGBA16_SNORM (or RGBA16_SFLOAT, RGBA32_SFLOAT)";
    case NormalEncoding::MAX_NUM:
        break;
    }
    return "none";
}
} // namespace nrd
