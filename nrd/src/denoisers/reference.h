// The constants of REFERENCE. Pure.
#pragma once
#include "pass_table.h"
#include "reference_constants.h"

namespace nrd
{
shared::ReferenceConstants makeReferenceConstants(const Request& request);
uint32_t findMeanFrameNum(const Request& request); // frames already in the mean; 0 = this one replaces it
} // namespace nrd
