// The constants that REBLUR and RELAX have in common. Pure.
#pragma once
#include "denoiser_constants.h"
#include "pass_table.h"

namespace nrd
{
constexpr uint32_t kHistoryMaxFrameNum = 63; // quarter frames in eight bits

// Of fireflyStrictness: with anti-firefly a limit lets nothing through once there is a frame of history.
float fireflyStrictness(bool hasAntiFirefly, float maxBlurRadius);
void fillCommon(const Request& request, shared::DenoiserConstants& g);
void fillIncomplete(const Request& request, CheckerboardMode checkerboard, HitDistanceReconstructionMode reconstruction,
                    shared::DenoiserConstants& g);
} // namespace nrd
