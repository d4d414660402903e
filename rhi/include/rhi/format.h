// Texel formats, named as in Vulkan. The enumeration only grows at its end.
#pragma once
#include <cstdint>
#include <rhi/span.h>

namespace rhi
{
enum class Format : uint32_t
{
    Unknown,
    R8_UNORM,
    R8_SNORM,
    R8_UINT,
    R8_SINT,
    RG8_UNORM,
    RG8_SNORM,
    RG8_UINT,
    RG8_SINT,
    RGBA8_UNORM,
    RGBA8_SNORM,
    RGBA8_UINT,
    RGBA8_SINT,
    RGBA8_SRGB,
    BGRA8_UNORM,
    R16_UNORM,
    R16_SNORM,
    R16_UINT,
    R16_SINT,
    R16_SFLOAT,
    RG16_UNORM,
    RG16_SNORM,
    RG16_UINT,
    RG16_SINT,
    RG16_SFLOAT,
    RGBA16_UNORM,
    RGBA16_SNORM,
    RGBA16_UINT,
    RGBA16_SINT,
    RGBA16_SFLOAT,
    R32_UINT,
    R32_SINT,
    R32_SFLOAT,
    RG32_UINT,
    RG32_SINT,
    RG32_SFLOAT,
    RGBA32_UINT,
    RGBA32_SINT,
    RGBA32_SFLOAT,
    A2B10G10R10_UNORM_PACK32,
    A2B10G10R10_UINT_PACK32,
    A2R10G10B10_UNORM_PACK32,
    B10G11R11_UFLOAT_PACK32,
    E5B9G9R9_UFLOAT_PACK32,
    D16_UNORM,  // sampled only, as everything below
    D32_SFLOAT, // depth of an engine, borrowed
    Count
};

/// How a shader sees the texels: which of texture2D, itexture2D and utexture2D declares them.
enum class FormatClass : uint8_t
{
    Float,
    Int,
    Uint,
    Depth,
};

struct FormatInfo
{
    const char* name;  // as the enumerator
    uint8_t texelSize; // bytes
    uint8_t componentCount;
    FormatClass formatClass;
};

/// Facts about a format; the name is "Unknown" and the size 0 for Unknown and for values outside the enumeration.
const FormatInfo& formatInfo(Format format);

enum class FormatSupport : uint32_t
{
    None = 0,
    Sampled = 1u << 0,
    SampledLinear = 1u << 1, // may be read through a linear sampler
    Storage = 1u << 2,
    TransferSrc = 1u << 3,
    TransferDst = 1u << 4,
};
template <> struct IsFlags<FormatSupport> : std::true_type
{
};
} // namespace rhi
