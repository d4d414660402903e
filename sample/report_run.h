// Every point of every denoiser that fits, replayed on every capture.
#pragma once
#include "report_options.h"
#include "report_row.h"

namespace sample::report
{
// The rows in order of capture and group, their fronts marked. Throws engine::Error, SettingError and FileError, also
// when a capture has nothing to measure.
std::vector<Row> measure(const Options& options);
} // namespace sample::report
