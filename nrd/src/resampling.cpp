#include "resampling.h"
#include "denoisers/common_rows.h"

namespace nrd
{
namespace
{
constexpr uint8_t kInput = 0xFE, kOutput = 0xFF; // of no family's table

constexpr TextureFormat kPerOutput = {FormatRule::PerOutput, Format::MAX_NUM, Format::MAX_NUM};

bool always(const Conditions&) { return true; }

Shader offset(Shader first, size_t by) { return static_cast<Shader>(static_cast<size_t>(first) + by); }

constexpr size_t distance(Shader first, Shader last) { return static_cast<size_t>(last) - static_cast<size_t>(first); }
} // namespace

constexpr TextureRow kSmallInput = {kInput, "SmallInput", kPerOutput, Lifetime::Transient};
constexpr TextureRow kSmallOutput = {kOutput, "SmallOutput", kPerOutput, Lifetime::Transient};

constexpr PassRow kDownsample = {"Downsample",
                                 Shader::DownsampleDiffuse,
                                 {ViewZ, NormalRoughness, Place{Source::UserInput, 0, false, true}},
                                 {Place{Source::Table, kInput, false, true}},
                                 kGroup16x16,
                                 always};

constexpr PassRow kUpsample = {"Upsample",
                               Shader::UpsampleDiffuse,
                               {ViewZ, NormalRoughness, Place{Source::Table, kOutput, false, true}},
                               {Place{Source::UserOutput, 0, false, true}},
                               kGroup16x16,
                               always,
                               {},
                               1,
                               {},
                               0,
                               true};

Format outputFormat(const Variant& variant)
{
    return (variant.kind & (kOcclusion | kShadow)) != 0 ? Format::R16_SFLOAT : Format::RGBA16_SFLOAT;
}

// Three kinds for each of three sets of lobes, and one more.
Shader downsampler(const Variant& variant)
{
    static_assert(distance(Shader::DownsampleDiffuse, Shader::DownsampleDiffuseDirectionalOcclusion) == 9);
    if (variant.kind == kDirectionalOcclusion) return Shader::DownsampleDiffuseDirectionalOcclusion;
    const size_t kind = variant.kind == kOcclusion ? 1 : variant.kind == kSphericalHarmonics ? 2 : 0;
    return offset(Shader::DownsampleDiffuse, 3 * (variant.lobes - 1u) + kind);
}

// Two kinds for each. Shadows have no lobe; they are as smooth as diffuse light.
Shader upsampler(const Variant& variant)
{
    static_assert(distance(Shader::UpsampleDiffuse, Shader::UpsampleDiffuseSpecularSh) == 5);
    const size_t lobes = variant.lobes == kNoLobe ? 0 : variant.lobes - 1u;
    return offset(Shader::UpsampleDiffuse, 2 * lobes + (variant.kind == kSphericalHarmonics ? 1 : 0));
}
} // namespace nrd
