// The Pareto fronts: what nothing else beats in time without losing in error.
#pragma once
#include "report_row.h"

namespace sample::report
{
// Marks the rows that are on the front of their capture and group: of time and FLIP, and of time and PSNR. The peer's
// are never on one and beat nothing: their time is another device's. Of equal rows all are on it.
void markFronts(std::vector<Row>& rows);
} // namespace sample::report
