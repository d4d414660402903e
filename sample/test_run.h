// Runs a folder of tests headless; each leaves a capture with its report.
#pragma once
#include "options.h"

namespace sample
{
/// Of every test in `options.tests`: capture/, report.json, denoised.png and the test itself, in a folder of its name
/// in `options.testResults`. Prints a line per test. Throws at the first one that cannot be run, with its name.
void runTests(const Options& options);
} // namespace sample
