// The constants of the history confidence. Pure.
#pragma once
#include "confidence_constants.h"
#include "pass_table.h"

namespace nrd
{
shared::ConfidenceConstants makeConfidenceConstants(const Request& request);
} // namespace nrd
