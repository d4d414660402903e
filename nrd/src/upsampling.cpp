#include "upsampling.h"
#include "denoisers/common_rows.h"

namespace nrd
{
namespace
{
constexpr uint8_t kKey = 0xFF; // of no family's table

bool always(const Conditions&) { return true; }

size_t index(Shader shader) { return static_cast<size_t>(shader); }
} // namespace

constexpr TextureRow kSmallOutput = {
    kKey, "SmallOutput", {FormatRule::PerOutput, Format::MAX_NUM, Format::MAX_NUM}, Lifetime::Transient};

constexpr PassRow kUpsample = {"Upsample",
                               Shader::UpsampleDiffuse,
                               {ViewZ, NormalRoughness, Place{Source::Table, kKey, false, true}},
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

// Shadows have no lobe; they are as smooth as diffuse light.
Shader upsampler(const Variant& variant)
{
    static_assert(static_cast<size_t>(Shader::UpsampleDiffuseSpecularSh) ==
                  static_cast<size_t>(Shader::UpsampleDiffuse) + 5);
    const size_t lobes = variant.lobes == kNoLobe ? 0 : variant.lobes - 1u;
    const size_t isSh = variant.kind == kSphericalHarmonics ? 1 : 0;
    return static_cast<Shader>(index(Shader::UpsampleDiffuse) + 2 * lobes + isSh);
}
} // namespace nrd
