// At which share of the picture's size a denoiser runs, and what is traced for it.
#pragma once
#include "replay_denoisers.h"

#include <nrd/descs.h>

namespace CLI
{
class App;
}

namespace sample
{
struct Resolution
{
    uint32_t divisor = 1;  // [1; 8], of a side
    bool isSparse = false; // noisy signals of every such pixel of every such row only, instead of means of all
    bool operator==(const Resolution&) const = default;

    /// Pixels from one that is read to the next.
    uint32_t stride() const { return isSparse ? divisor : 1; }
};

/// What a denoiser of the family takes of it: REFERENCE keeps the full size, SIGMA where means are asked for.
inline Resolution resolutionOf(Family family, const Resolution& resolution)
{
    const bool averages = family == Family::Reblur || family == Family::Relax;
    return averages || (family == Family::Sigma && resolution.isSparse) ? resolution : Resolution();
}

// --divisor and --sparse.
void declareResolution(CLI::App& app, Resolution& resolution);

// Guides and outputs keep the full size.
inline nrd::DenoiserDesc denoiserDesc(nrd::Identifier identifier, nrd::Denoiser denoiser, const Resolution& resolution)
{
    nrd::DenoiserDesc desc{identifier, denoiser, resolution.divisor};
    desc.fullSize = resolution.isSparse ? nrd::FullSize::GUIDES_AND_OUTPUTS : nrd::FullSize::EVERYTHING;
    if (resolution.divisor == 1) desc.fullSize = nrd::FullSize::NOTHING;
    return desc;
}
} // namespace sample
