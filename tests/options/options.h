// Every option a denoiser has, as a change of a Setup.
#pragma once
#include "setup.h"

namespace options
{
constexpr nrd::Denoiser kDenoisers[] = {
    nrd::Denoiser::REBLUR_DIFFUSE,
    nrd::Denoiser::REBLUR_DIFFUSE_OCCLUSION,
    nrd::Denoiser::REBLUR_DIFFUSE_SH,
    nrd::Denoiser::REBLUR_SPECULAR,
    nrd::Denoiser::REBLUR_SPECULAR_OCCLUSION,
    nrd::Denoiser::REBLUR_SPECULAR_SH,
    nrd::Denoiser::REBLUR_DIFFUSE_SPECULAR,
    nrd::Denoiser::REBLUR_DIFFUSE_SPECULAR_OCCLUSION,
    nrd::Denoiser::REBLUR_DIFFUSE_SPECULAR_SH,
    nrd::Denoiser::REBLUR_DIFFUSE_DIRECTIONAL_OCCLUSION,
    nrd::Denoiser::RELAX_DIFFUSE,
    nrd::Denoiser::RELAX_DIFFUSE_SH,
    nrd::Denoiser::RELAX_SPECULAR,
    nrd::Denoiser::RELAX_SPECULAR_SH,
    nrd::Denoiser::RELAX_DIFFUSE_SPECULAR,
    nrd::Denoiser::RELAX_DIFFUSE_SPECULAR_SH,
};

// What costs much runs for all REBLUR but three RELAX, which have all of its lobes and signals; NRD_TEST_FULL in the
// environment asks for all.
bool isFull();
bool isRepresentative(nrd::Denoiser denoiser);

struct Option
{
    const char* name;
    void (*apply)(Setup& setup);
};

const std::vector<Option>& allOptions(nrd::Denoiser denoiser); // of its family

Setup makeSetup(nrd::Denoiser denoiser, glm::ivec2 size);
} // namespace options
