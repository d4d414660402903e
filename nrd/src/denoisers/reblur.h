// The constants of REBLUR. Pure.
#pragma once
#include "pass_table.h"
#include "reblur_constants.h"

namespace nrd
{
shared::ReblurConstants makeReblurConstants(const Request& request);
} // namespace nrd
