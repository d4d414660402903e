// The single-lobe denoisers of both families, and their settings by what they have in common.
#pragma once
#include <harness.h>

namespace lag
{
constexpr nrd::Denoiser kDenoisers[] = {nrd::Denoiser::REBLUR_DIFFUSE, nrd::Denoiser::REBLUR_SPECULAR,
                                        nrd::Denoiser::RELAX_DIFFUSE, nrd::Denoiser::RELAX_SPECULAR};

struct Reaction
{
    bool hasAntilag;
    bool hasClamping; // of the history by the fast one
};

bool isRelax(nrd::Denoiser denoiser);
bool isSpecular(nrd::Denoiser denoiser);

quality::Settings makeSettings(nrd::Denoiser denoiser, Reaction reaction);
quality::Settings makeFireflySettings(nrd::Denoiser denoiser, bool hasAntiFirefly, bool hasPrePass);

// Grey radiance as the family wants it.
quality::Signal packFor(nrd::Denoiser denoiser, quality::Signal grey);

// Denoises the same signal as whatever lobe the denoiser has, and returns it.
const quality::Signal& denoiseLobe(quality::Harness& harness, nrd::Denoiser denoiser, const quality::Guides& guides,
                                   const quality::Signal& grey);
} // namespace lag
