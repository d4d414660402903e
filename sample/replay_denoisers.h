// The denoisers by name, and which signals each produces. Which slots one reads and writes, the library tells.
#pragma once
#include "signals.h"

#include <nrd/types.h>

#include <string_view>
#include <vector>

namespace sample
{
enum class Family : uint8_t
{
    None, // measures the noisy input only
    Reblur,
    Relax,
    Sigma,
    Reference,
    Confidence // no denoiser; of settings
};

struct ReplayDenoiser
{
    const char* name; // as toString(nrd::Denoiser), or "NONE"
    nrd::Denoiser denoiser;
    Family family;
    std::vector<Signal> signals; // produced
};

// All denoisers of the public enumeration in its order, then NONE.
const std::vector<ReplayDenoiser>& replayDenoisers();

// Null when no denoiser has that name.
const ReplayDenoiser* findDenoiser(std::string_view name);

SignalSet signalSetOf(const ReplayDenoiser& denoiser);
} // namespace sample
