#include "resolution.h"

#include <CLI/CLI.hpp>

namespace sample
{
void declareResolution(CLI::App& app, Resolution& resolution)
{
    CLI::Option* divisor =
        app.add_option("--divisor", resolution.divisor, "Denoise at 1/N of the size a side, and upsample the result; 1")
            ->check(CLI::Range(1u, 8u));
    app.add_flag("--sparse", resolution.isSparse,
                 "With --divisor: noisy signals of every Nth pixel of every Nth row only, instead of means of all")
        ->needs(divisor);
}
} // namespace sample
