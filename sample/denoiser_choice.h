// --denoiser auto: which denoisers a scene needs, and why. Pure.
#pragma once
#include "denoiser_set.h"
#include "path_tracer.h"

namespace sample
{
/// What the choice depends on, of the materials that something is made of.
struct SceneFacts
{
    float leastRoughness = 1.0f; // linear, textures included
    float largestMetallic = 0.0f;
    bool hasBlended = false;
    bool hasSun = false;        // a light whose shadow can be a signal of its own
    std::optional<Lobes> lobes; // nullopt: free to choose
};
SceneFacts factsOf(const Scene& scene);

struct DenoiserChoice
{
    DenoiserSet set;
    Lobes lobes = Lobes::Both;
    std::vector<std::string> reasons; // one line each, with the name it is about
};
/// `offered`: what the library has, as sampleDenoisers(); the choice points into it.
DenoiserChoice chooseDenoisers(const SceneFacts& facts, std::span<const SampleDenoiser> offered);
} // namespace sample
