// The plots: scripts for gnuplot, and gnuplot run on them.
#pragma once
#include "report_row.h"

#include <filesystem>
#include <span>

namespace sample::report
{
// A script that draws the rows of one capture and group into plotName().svg: GPU time across, FLIP and PSNR up, where
// they are measured. Empty when no row has both a time and an error.
std::string plotScript(std::span<const Row> rows);

// Runs gnuplot in the script's folder. Throws FileError when it is not installed, or fails.
void runGnuplot(const std::filesystem::path& script);
} // namespace sample::report
