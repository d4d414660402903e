#include <nrd/types.h>

namespace nrd
{
uint32_t texelByteSize(Format format)
{
    switch (format)
    {
    case Format::R8_UNORM:
    case Format::R8_SNORM:
    case Format::R8_UINT:
        return 1;
    case Format::RG8_UNORM:
    case Format::RG8_UINT:
    case Format::R16_UNORM:
    case Format::R16_UINT:
    case Format::R16_SFLOAT:
        return 2;
    case Format::RGBA8_UNORM:
    case Format::RGBA8_SNORM:
    case Format::RG16_UNORM:
    case Format::RG16_SFLOAT:
    case Format::R32_UINT:
    case Format::R32_SFLOAT:
    case Format::A2B10G10R10_UNORM_PACK32:
    case Format::B10G11R11_UFLOAT_PACK32:
    case Format::E5B9G9R9_UFLOAT_PACK32:
        return 4;
    case Format::RGBA16_UNORM:
    case Format::RGBA16_SNORM:
    case Format::RGBA16_SFLOAT:
    case Format::RG32_UINT:
    case Format::RG32_SFLOAT:
        return 8;
    case Format::RGBA32_SFLOAT:
        return 16;
    case Format::MAX_NUM:
        break;
    }
    return 0;
}
} // namespace nrd
