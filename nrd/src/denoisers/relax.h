// The constants of RELAX. Pure.
#pragma once
#include "denoiser_constants.h"
#include "pass_table.h"

namespace nrd
{
shared::DenoiserConstants makeRelaxConstants(const Request& request);
} // namespace nrd
