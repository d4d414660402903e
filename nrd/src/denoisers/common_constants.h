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
void fillFireflies(bool isCapped, float minScale, float headroom, float maxBlurRadius, shared::DenoiserConstants& g);

// Hit distances or half of a checkerboard are left to the pre-pass.
template <class Settings> bool isIncomplete(const Settings& s)
{
    return s.checkerboardMode != CheckerboardMode::OFF ||
           s.hitDistanceReconstructionMode != HitDistanceReconstructionMode::OFF;
}

// Whether the pre-pass mixes neighbouring samples.
template <class Settings> bool isPrefiltered(const Settings& s)
{
    return s.prePassMode == PrePassMode::SIMPLE || (s.prePassMode == PrePassMode::AUTO && isIncomplete(s));
}
} // namespace nrd
