// The denoisers of nrd-sample, and in which form each of them takes the two lobes.
#pragma once
#include "replay_denoisers.h"

#include <array>
#include <span>

namespace sample
{
enum class Lobe : uint8_t
{
    Diffuse,
    Specular
};
inline constexpr std::array<Lobe, 2> kLobes = {Lobe::Diffuse, Lobe::Specular};

enum class LobeFormat : uint8_t
{
    None,        // the denoiser does not take the lobe
    Radiance,    // radiance and hit distance
    Sh,          // the same with the direction, in two images
    HitDistance, // without radiance: occlusion
    Direction    // hit distance and direction: directional occlusion
};

struct SampleDenoiser
{
    const char* name;                  // as toString(nrd::Denoiser), or "NONE"
    nrd::Denoiser denoiser;            // MAX_NUM: none
    Family family;                     // None composes the noisy lobes, Reference accumulates that picture
    std::array<LobeFormat, 2> formats; // by Lobe

    LobeFormat format(Lobe lobe) const { return formats[static_cast<size_t>(lobe)]; }
    bool hasRadiance(Lobe lobe) const { return format(lobe) == LobeFormat::Radiance || format(lobe) == LobeFormat::Sh; }
    bool hasOcclusionOnly(Lobe lobe) const { return format(lobe) != LobeFormat::None && !hasRadiance(lobe); }
    /// It takes the shadow signal, and no lobe.
    bool isOfShadow() const { return family == Family::Sigma; }
    /// The composed picture consists of what the denoiser made of at least one lobe.
    bool composesLight() const { return hasRadiance(Lobe::Diffuse) || hasRadiance(Lobe::Specular); }
};

/// All that the sample can feed.
std::span<const SampleDenoiser> sampleDenoiserTable();

/// Those of them that this build of the library has.
std::span<const SampleDenoiser> sampleDenoisers();

/// One of sampleDenoisers(). Capitals or not. Null when none has that name.
const SampleDenoiser* findSampleDenoiser(std::string_view name);
} // namespace sample
