#include "sample_denoisers.h"

#include <algorithm>
#include <cctype>

namespace sample
{
namespace
{
using nrd::Denoiser;

SampleDenoiser reblur(Denoiser denoiser, LobeFormat diffuse, LobeFormat specular)
{
    return {nrd::toString(denoiser), denoiser, Family::Reblur, {diffuse, specular}};
}

// clang-format off
const std::array<SampleDenoiser, 12>& table()
{
    using enum LobeFormat;
    static const std::array<SampleDenoiser, 12> rows = {
        reblur(Denoiser::REBLUR_DIFFUSE,                       Radiance,    None),
        reblur(Denoiser::REBLUR_DIFFUSE_OCCLUSION,             HitDistance, None),
        reblur(Denoiser::REBLUR_DIFFUSE_SH,                    Sh,          None),
        reblur(Denoiser::REBLUR_SPECULAR,                      None,        Radiance),
        reblur(Denoiser::REBLUR_SPECULAR_OCCLUSION,            None,        HitDistance),
        reblur(Denoiser::REBLUR_SPECULAR_SH,                   None,        Sh),
        reblur(Denoiser::REBLUR_DIFFUSE_SPECULAR,              Radiance,    Radiance),
        reblur(Denoiser::REBLUR_DIFFUSE_SPECULAR_OCCLUSION,    HitDistance, HitDistance),
        reblur(Denoiser::REBLUR_DIFFUSE_SPECULAR_SH,           Sh,          Sh),
        reblur(Denoiser::REBLUR_DIFFUSE_DIRECTIONAL_OCCLUSION, Direction,   None),
        SampleDenoiser{nrd::toString(Denoiser::REFERENCE), Denoiser::REFERENCE, Family::Reference, {None, None}},
        SampleDenoiser{"NONE", Denoiser::MAX_NUM, Family::None, {None, None}}};
    return rows;
}
// clang-format on

bool isEqual(std::string_view a, std::string_view b)
{
    const auto upper = [](char c) { return std::toupper(static_cast<unsigned char>(c)); };
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [&](char x, char y) { return upper(x) == upper(y); });
}
} // namespace

std::span<const SampleDenoiser> sampleDenoisers() { return table(); }

const SampleDenoiser* findSampleDenoiser(std::string_view name)
{
    for (const SampleDenoiser& row : table())
        if (isEqual(row.name, name)) return &row;
    return nullptr;
}
} // namespace sample
