// The constants of SIGMA. Pure.
#pragma once
#include "denoiser_constants.h"
#include "pass_table.h"

namespace nrd
{
shared::DenoiserConstants makeSigmaConstants(const Request& request);
} // namespace nrd
