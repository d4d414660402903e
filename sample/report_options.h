// What nrd-report is asked for.
#pragma once
#include "bench_options.h"
#include "report_points.h"

#include <optional>

namespace sample::report
{
struct Options
{
    std::vector<std::string> captures; // folders
    std::string out;
    std::vector<const ReplayDenoiser*> denoisers; // at least one
    std::string pointNames;                       // regular expression for whole names
    std::vector<Point> points;                    // given on top of the table's
    std::string peer;                             // empty: none
    std::string device;                           // as engine::DeviceDesc::device
    std::string peerTimes;                        // of timeSize; empty: none
    bench::Extent timeSize;                       // of generated input that is timed; 0: the captures' own times
    size_t frameCount = 0;                        // 0: all
    bool validation = false;
    bool isDeviceListWanted = false;
};

// Throws SettingError. Nothing is returned when the command line asked for --help or --version, which are printed.
std::optional<Options> parseOptions(int argumentCount, const char* const* arguments);
} // namespace sample::report
