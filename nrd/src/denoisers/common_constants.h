// The constants that REBLUR and RELAX have in common. Pure.
#pragma once
#include "denoiser_constants.h"
#include "pass_table.h"

namespace nrd
{
constexpr uint32_t kHistoryMaxFrameNum = 63; // quarter frames in eight bits

void fillCommon(const Request& request, shared::DenoiserConstants& g);
void fillIncomplete(const Request& request, CheckerboardMode checkerboard, HitDistanceReconstructionMode reconstruction,
                    shared::DenoiserConstants& g);
void fillFireflies(bool isTight, bool isCapped, float minScale, float maxBlurRadius, shared::DenoiserConstants& g);

// Whether the pre-pass caps fireflies of all lobes: it may leave one as it is.
template <class Settings> bool capsFireflies(const Settings& s)
{
    return s.enableAntiFirefly && s.prePassMode != PrePassMode::OFF && s.diffusePrepassBlurRadius > 0.0f &&
           s.specularPrepassBlurRadius > 0.0f;
}
} // namespace nrd
