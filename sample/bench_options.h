// What nrd-bench is asked for.
#pragma once
#include "replay_settings.h"
#include "resolution.h"

#include <optional>

namespace sample::bench
{
struct Extent
{
    uint32_t width = 0;
    uint32_t height = 0;
};

// Rounded up.
constexpr Extent divided(Extent size, uint32_t divisor)
{
    return {(size.width + divisor - 1) / divisor, (size.height + divisor - 1) / divisor};
}

// What is measured, whatever the denoiser and the size.
struct Workload
{
    nrd::Quality preset = nrd::Quality::BALANCED;
    std::vector<Assignment> settings; // --set, on top of it
    uint32_t frameCount = 96;         // measured, after warm-up
    float skyShare = 0.02f;           // of the picture, [0; 0.25]
    bool isStatic = false;            // the camera stands still
    Resolution resolution = {};
};

struct Options
{
    std::vector<const ReplayDenoiser*> denoisers; // at least one
    std::vector<Extent> sizes;                    // at least one
    Workload workload;
    std::string json;   // empty: none
    std::string peer;   // empty: none
    std::string device; // as engine::DeviceDesc::device
    bool isMemoryOnly = false;
    bool validation = false;
    bool isDeviceListWanted = false;
};

// "1920x1080,64x36"; each side in [1; 65535]. Throws SettingError.
std::vector<Extent> parseSizes(const std::string& text);

// Throws SettingError. Nothing is returned when the command line asked for --help or --version, which are printed.
std::optional<Options> parseOptions(int argumentCount, const char* const* arguments);
} // namespace sample::bench
