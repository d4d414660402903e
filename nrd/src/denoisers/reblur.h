// The constants of REBLUR. Pure.
#pragma once
#include "denoiser_constants.h"
#include "pass_table.h"

namespace nrd
{
// Settings with the debug switches applied: what the tables and constants are made of.
ReblurSettings effective(const ReblurSettings& settings);
shared::DenoiserConstants makeReblurConstants(const Request& request);
} // namespace nrd
