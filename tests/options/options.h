// Every option a denoiser has, as a change of a Setup.
#pragma once
#include "setup.h"
#include <span>

namespace options
{
std::span<const nrd::Denoiser> allDenoisers(); // that the library has

// Those that run every pass of their family: what has fewer lobes or channels runs the same shaders with fewer.
bool isWidest(nrd::Denoiser denoiser);
// All but in the short form: those and one more of a kind, without directions or of one lobe.
std::span<const nrd::Denoiser> testedDenoisers();

// What costs much runs for all but RELAX, of which three run that have all of its lobes and signals; in the long form for
// all.
bool isRepresentative(nrd::Denoiser denoiser);

struct Option
{
    const char* name;
    void (*apply)(Setup& setup);
};

const std::vector<Option>& allOptions(nrd::Denoiser denoiser); // of its family

Setup makeSetup(nrd::Denoiser denoiser, glm::ivec2 size);
} // namespace options
