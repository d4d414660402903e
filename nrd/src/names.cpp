#include "pass_table.h"
#include <iterator>

namespace nrd
{
namespace
{
template <class Key> struct NameRow
{
    Key key;
    const char* name;
};

constexpr NameRow<Result> kResultNames[] = {
    {Result::SUCCESS, "SUCCESS"},
    {Result::FAILURE, "FAILURE"},
    {Result::INVALID_ARGUMENT, "INVALID_ARGUMENT"},
    {Result::UNSUPPORTED, "UNSUPPORTED"},
    {Result::NON_UNIQUE_IDENTIFIER, "NON_UNIQUE_IDENTIFIER"},
};
static_assert(rowsMatchKeys(kResultNames) && std::size(kResultNames) == static_cast<size_t>(Result::MAX_NUM));

constexpr NameRow<Denoiser> kDenoiserNames[] = {
    {Denoiser::REBLUR_DIFFUSE, "REBLUR_DIFFUSE"},
    {Denoiser::REBLUR_DIFFUSE_OCCLUSION, "REBLUR_DIFFUSE_OCCLUSION"},
    {Denoiser::REBLUR_DIFFUSE_SH, "REBLUR_DIFFUSE_SH"},
    {Denoiser::REBLUR_SPECULAR, "REBLUR_SPECULAR"},
    {Denoiser::REBLUR_SPECULAR_OCCLUSION, "REBLUR_SPECULAR_OCCLUSION"},
    {Denoiser::REBLUR_SPECULAR_SH, "REBLUR_SPECULAR_SH"},
    {Denoiser::REBLUR_DIFFUSE_SPECULAR, "REBLUR_DIFFUSE_SPECULAR"},
    {Denoiser::REBLUR_DIFFUSE_SPECULAR_OCCLUSION, "REBLUR_DIFFUSE_SPECULAR_OCCLUSION"},
    {Denoiser::REBLUR_DIFFUSE_SPECULAR_SH, "REBLUR_DIFFUSE_SPECULAR_SH"},
    {Denoiser::REBLUR_DIFFUSE_DIRECTIONAL_OCCLUSION, "REBLUR_DIFFUSE_DIRECTIONAL_OCCLUSION"},
    {Denoiser::RELAX_DIFFUSE, "RELAX_DIFFUSE"},
    {Denoiser::RELAX_DIFFUSE_SH, "RELAX_DIFFUSE_SH"},
    {Denoiser::RELAX_SPECULAR, "RELAX_SPECULAR"},
    {Denoiser::RELAX_SPECULAR_SH, "RELAX_SPECULAR_SH"},
    {Denoiser::RELAX_DIFFUSE_SPECULAR, "RELAX_DIFFUSE_SPECULAR"},
    {Denoiser::RELAX_DIFFUSE_SPECULAR_SH, "RELAX_DIFFUSE_SPECULAR_SH"},
    {Denoiser::SIGMA_SHADOW, "SIGMA_SHADOW"},
    {Denoiser::SIGMA_SHADOW_TRANSLUCENCY, "SIGMA_SHADOW_TRANSLUCENCY"},
    {Denoiser::REFERENCE, "REFERENCE"},
};
static_assert(rowsMatchKeys(kDenoiserNames) && std::size(kDenoiserNames) == static_cast<size_t>(Denoiser::MAX_NUM));

constexpr NameRow<ResourceType> kResourceTypeNames[] = {
    {ResourceType::IN_MV, "IN_MV"},
    {ResourceType::IN_NORMAL_ROUGHNESS, "IN_NORMAL_ROUGHNESS"},
    {ResourceType::IN_VIEWZ, "IN_VIEWZ"},
    {ResourceType::IN_DIFF_CONFIDENCE, "IN_DIFF_CONFIDENCE"},
    {ResourceType::IN_SPEC_CONFIDENCE, "IN_SPEC_CONFIDENCE"},
    {ResourceType::IN_DISOCCLUSION_THRESHOLD_MIX, "IN_DISOCCLUSION_THRESHOLD_MIX"},
    {ResourceType::IN_SPEC_MV, "IN_SPEC_MV"},
    {ResourceType::IN_DIFF_RADIANCE_HITDIST, "IN_DIFF_RADIANCE_HITDIST"},
    {ResourceType::IN_SPEC_RADIANCE_HITDIST, "IN_SPEC_RADIANCE_HITDIST"},
    {ResourceType::IN_DIFF_HITDIST, "IN_DIFF_HITDIST"},
    {ResourceType::IN_SPEC_HITDIST, "IN_SPEC_HITDIST"},
    {ResourceType::IN_DIFF_DIRECTION_HITDIST, "IN_DIFF_DIRECTION_HITDIST"},
    {ResourceType::IN_DIFF_SH0, "IN_DIFF_SH0"},
    {ResourceType::IN_DIFF_SH1, "IN_DIFF_SH1"},
    {ResourceType::IN_SPEC_SH0, "IN_SPEC_SH0"},
    {ResourceType::IN_SPEC_SH1, "IN_SPEC_SH1"},
    {ResourceType::IN_PENUMBRA, "IN_PENUMBRA"},
    {ResourceType::IN_TRANSLUCENCY, "IN_TRANSLUCENCY"},
    {ResourceType::IN_SIGNAL, "IN_SIGNAL"},
    {ResourceType::OUT_DIFF_RADIANCE_HITDIST, "OUT_DIFF_RADIANCE_HITDIST"},
    {ResourceType::OUT_SPEC_RADIANCE_HITDIST, "OUT_SPEC_RADIANCE_HITDIST"},
    {ResourceType::OUT_DIFF_SH0, "OUT_DIFF_SH0"},
    {ResourceType::OUT_DIFF_SH1, "OUT_DIFF_SH1"},
    {ResourceType::OUT_SPEC_SH0, "OUT_SPEC_SH0"},
    {ResourceType::OUT_SPEC_SH1, "OUT_SPEC_SH1"},
    {ResourceType::OUT_DIFF_HITDIST, "OUT_DIFF_HITDIST"},
    {ResourceType::OUT_SPEC_HITDIST, "OUT_SPEC_HITDIST"},
    {ResourceType::OUT_DIFF_DIRECTION_HITDIST, "OUT_DIFF_DIRECTION_HITDIST"},
    {ResourceType::OUT_SHADOW_TRANSLUCENCY, "OUT_SHADOW_TRANSLUCENCY"},
    {ResourceType::OUT_SIGNAL, "OUT_SIGNAL"},
    {ResourceType::OUT_VALIDATION, "OUT_VALIDATION"},
    {ResourceType::IN_STORED_SAMPLE, "IN_STORED_SAMPLE"},
    {ResourceType::IN_RETRACED_SAMPLE, "IN_RETRACED_SAMPLE"},
    {ResourceType::IN_STORED_NORMAL_ROUGHNESS, "IN_STORED_NORMAL_ROUGHNESS"},
    {ResourceType::TRANSIENT_POOL, "TRANSIENT_POOL"},
    {ResourceType::PERMANENT_POOL, "PERMANENT_POOL"},
};
static_assert(rowsMatchKeys(kResourceTypeNames) &&
              std::size(kResourceTypeNames) == static_cast<size_t>(ResourceType::MAX_NUM));

constexpr NameRow<Format> kFormatNames[] = {
    {Format::R8_UNORM, "R8_UNORM"},
    {Format::R8_SNORM, "R8_SNORM"},
    {Format::R8_UINT, "R8_UINT"},
    {Format::RG8_UNORM, "RG8_UNORM"},
    {Format::RG8_UINT, "RG8_UINT"},
    {Format::RGBA8_UNORM, "RGBA8_UNORM"},
    {Format::RGBA8_SNORM, "RGBA8_SNORM"},
    {Format::R16_UNORM, "R16_UNORM"},
    {Format::R16_UINT, "R16_UINT"},
    {Format::R16_SFLOAT, "R16_SFLOAT"},
    {Format::RG16_UNORM, "RG16_UNORM"},
    {Format::RG16_SFLOAT, "RG16_SFLOAT"},
    {Format::RGBA16_UNORM, "RGBA16_UNORM"},
    {Format::RGBA16_SNORM, "RGBA16_SNORM"},
    {Format::RGBA16_SFLOAT, "RGBA16_SFLOAT"},
    {Format::R32_UINT, "R32_UINT"},
    {Format::R32_SFLOAT, "R32_SFLOAT"},
    {Format::RG32_UINT, "RG32_UINT"},
    {Format::RG32_SFLOAT, "RG32_SFLOAT"},
    {Format::RGBA32_SFLOAT, "RGBA32_SFLOAT"},
    {Format::A2B10G10R10_UNORM_PACK32, "A2B10G10R10_UNORM_PACK32"},
    {Format::B10G11R11_UFLOAT_PACK32, "B10G11R11_UFLOAT_PACK32"},
    {Format::E5B9G9R9_UFLOAT_PACK32, "E5B9G9R9_UFLOAT_PACK32"},
};
static_assert(rowsMatchKeys(kFormatNames) && std::size(kFormatNames) == static_cast<size_t>(Format::MAX_NUM));

template <class Key, size_t Num> const char* findName(const NameRow<Key> (&rows)[Num], Key value)
{
    const size_t index = static_cast<size_t>(value);
    return index < Num ? rows[index].name : "UNKNOWN";
}
} // namespace

const char* toString(Result value) { return findName(kResultNames, value); }
const char* toString(Denoiser value) { return findName(kDenoiserNames, value); }
const char* toString(ResourceType value) { return findName(kResourceTypeNames, value); }
const char* toString(Format value) { return findName(kFormatNames, value); }
} // namespace nrd
