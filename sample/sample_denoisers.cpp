#include "sample_denoisers.h"

#include <nrd/nrd.h>

#include <algorithm>
#include <cctype>
#include <vector>

namespace sample
{
namespace
{
using nrd::Denoiser;

SampleDenoiser reblur(Denoiser denoiser, LobeFormat diffuse, LobeFormat specular)
{
    return {nrd::toString(denoiser), denoiser, Family::Reblur, {diffuse, specular}};
}

SampleDenoiser relax(Denoiser denoiser, LobeFormat diffuse, LobeFormat specular)
{
    return {nrd::toString(denoiser), denoiser, Family::Relax, {diffuse, specular}};
}

SampleDenoiser sigma(Denoiser denoiser)
{
    return {nrd::toString(denoiser), denoiser, Family::Sigma, {LobeFormat::None, LobeFormat::None}};
}

// clang-format off
std::vector<SampleDenoiser> makeTable()
{
    using enum LobeFormat;
    return {
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
        relax(Denoiser::RELAX_DIFFUSE,                         Radiance,    None),
        relax(Denoiser::RELAX_DIFFUSE_SH,                      Sh,          None),
        relax(Denoiser::RELAX_SPECULAR,                        None,        Radiance),
        relax(Denoiser::RELAX_SPECULAR_SH,                     None,        Sh),
        relax(Denoiser::RELAX_DIFFUSE_SPECULAR,                Radiance,    Radiance),
        relax(Denoiser::RELAX_DIFFUSE_SPECULAR_SH,             Sh,          Sh),
        sigma(Denoiser::SIGMA_SHADOW),
        sigma(Denoiser::SIGMA_SHADOW_TRANSLUCENCY),
        SampleDenoiser{nrd::toString(Denoiser::REFERENCE), Denoiser::REFERENCE, Family::Reference, {None, None}},
        SampleDenoiser{"NONE", Denoiser::MAX_NUM, Family::None, {None, None}}};
}
// clang-format on

bool isOffered(const SampleDenoiser& row)
{
    const nrd::LibraryDesc& library = nrd::GetLibraryDesc();
    const Denoiser* last = library.supportedDenoisers + library.supportedDenoisersNum;
    return row.family == Family::None || std::find(library.supportedDenoisers, last, row.denoiser) != last;
}

bool isEqual(std::string_view a, std::string_view b)
{
    const auto upper = [](char c) { return std::toupper(static_cast<unsigned char>(c)); };
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [&](char x, char y) { return upper(x) == upper(y); });
}
} // namespace

std::span<const SampleDenoiser> sampleDenoiserTable()
{
    static const std::vector<SampleDenoiser> rows = makeTable();
    return rows;
}

std::span<const SampleDenoiser> sampleDenoisers()
{
    static const std::vector<SampleDenoiser> offered = []
    {
        std::vector<SampleDenoiser> rows;
        std::ranges::copy_if(sampleDenoiserTable(), std::back_inserter(rows), isOffered);
        return rows;
    }();
    return offered;
}

const SampleDenoiser* findSampleDenoiser(std::string_view name)
{
    for (const SampleDenoiser& row : sampleDenoisers())
        if (isEqual(row.name, name)) return &row;
    return nullptr;
}
} // namespace sample
