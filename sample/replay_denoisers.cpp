#include "replay_denoisers.h"

namespace sample
{
namespace
{
using nrd::Denoiser;

ReplayDenoiser row(Denoiser denoiser, Family family, std::vector<Signal> signals)
{
    return {nrd::toString(denoiser), denoiser, family, std::move(signals)};
}

// clang-format off
std::vector<ReplayDenoiser> makeTable()
{
    constexpr Signal D = Signal::Diffuse, HD = Signal::NormHitDist;
    constexpr Signal S = Signal::Specular, HS = Signal::SpecularNormHitDist;
    constexpr Signal V = Signal::Shadow, T = Signal::Translucency;
    return {
        row(Denoiser::REBLUR_DIFFUSE,                       Family::Reblur,    {D, HD}),
        row(Denoiser::REBLUR_DIFFUSE_OCCLUSION,             Family::Reblur,    {HD}),
        row(Denoiser::REBLUR_DIFFUSE_SH,                    Family::Reblur,    {D, HD}),
        row(Denoiser::REBLUR_SPECULAR,                      Family::Reblur,    {S, HS}),
        row(Denoiser::REBLUR_SPECULAR_OCCLUSION,            Family::Reblur,    {HS}),
        row(Denoiser::REBLUR_SPECULAR_SH,                   Family::Reblur,    {S, HS}),
        row(Denoiser::REBLUR_DIFFUSE_SPECULAR,              Family::Reblur,    {D, S, HD, HS}),
        row(Denoiser::REBLUR_DIFFUSE_SPECULAR_OCCLUSION,    Family::Reblur,    {HD, HS}),
        row(Denoiser::REBLUR_DIFFUSE_SPECULAR_SH,           Family::Reblur,    {D, S, HD, HS}),
        row(Denoiser::REBLUR_DIFFUSE_DIRECTIONAL_OCCLUSION, Family::Reblur,    {HD}),
        row(Denoiser::RELAX_DIFFUSE,                        Family::Relax,     {D}),
        row(Denoiser::RELAX_DIFFUSE_SH,                     Family::Relax,     {D}),
        row(Denoiser::RELAX_SPECULAR,                       Family::Relax,     {S}),
        row(Denoiser::RELAX_SPECULAR_SH,                    Family::Relax,     {S}),
        row(Denoiser::RELAX_DIFFUSE_SPECULAR,               Family::Relax,     {D, S}),
        row(Denoiser::RELAX_DIFFUSE_SPECULAR_SH,            Family::Relax,     {D, S}),
        row(Denoiser::SIGMA_SHADOW,                         Family::Sigma,     {V}),
        row(Denoiser::SIGMA_SHADOW_TRANSLUCENCY,            Family::Sigma,     {V, T}),
        row(Denoiser::REFERENCE,                            Family::Reference, {D}), // given the diffuse radiance
        {"NONE", Denoiser::MAX_NUM, Family::None, {D, S, HD, HS, V, T}},
    };
}
// clang-format on
} // namespace

const std::vector<ReplayDenoiser>& replayDenoisers()
{
    static const std::vector<ReplayDenoiser> table = makeTable();
    return table;
}

const ReplayDenoiser* findDenoiser(std::string_view name)
{
    for (const ReplayDenoiser& denoiser : replayDenoisers())
        if (denoiser.name == name) return &denoiser;
    return nullptr;
}

SignalSet signalSetOf(const ReplayDenoiser& denoiser)
{
    SignalSet set = {};
    for (Signal signal : denoiser.signals) set[static_cast<size_t>(signal)] = true;
    return set;
}
} // namespace sample
