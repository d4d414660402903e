#include "bench_options.h"
#include "name_choice.h"
#include "program.h"

#include <CLI/CLI.hpp>

#include <charconv>
#include <optional>

namespace sample::bench
{
namespace
{
struct Texts
{
    std::string denoisers = ".*";
    std::string sizes = "1920x1080,2560x1440,3840x2160";
    std::string preset = "BALANCED";
    std::vector<std::string> settings;
    float skyPercent = 2.0f;
};

void declareOptions(CLI::App& app, Options& options, Texts& texts)
{
    app.add_option("--denoisers", texts.denoisers, "Regular expression for the whole names of the denoisers; all");
    app.add_option("--sizes", texts.sizes, "WxH,...; " + texts.sizes);
    app.add_option("--json", options.json, "File for the JSON report");
    app.add_option("--peer", options.peer, "File with recorded figures, printed beside ours");
    app.add_option("--preset", texts.preset, "FAST, BALANCED (the defaults) or BEST, before --set");
    app.add_option("--set", texts.settings, "key=value: any field of the common or the denoiser's settings")
        ->take_all();
    app.add_option("--frames", options.workload.frameCount, "Measured frames, after warm-up; 96")
        ->check(CLI::Range(1u, 1000000u));
    app.add_option("--sky", texts.skyPercent, "Share of the sky in the picture, percent; 2")
        ->check(CLI::Range(0.0f, 25.0f));
    declareResolution(app, options.workload.resolution);
    app.add_flag("--static", options.workload.isStatic, "The camera stands still");
    app.add_flag("--memory", options.isMemoryOnly, "Allocate, print the memory, and render nothing");
    app.add_option("--device", options.device, "Number or part of the name of the device");
    app.add_flag("--list-devices", options.isDeviceListWanted, "List the Vulkan devices");
    app.add_flag("--validation", options.validation, "Turn the validation layers on; a message makes the run fail");
    app.set_version_flag("--version", versionText("nrd-bench"), "Print the version");
}

// The number that fills `text`, or 0.
uint32_t parseSide(std::string_view text)
{
    uint32_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size() && value <= 65535 ? value : 0;
}

Extent parseSize(std::string_view text)
{
    const size_t cross = text.find('x');
    if (cross == std::string_view::npos) return {};
    return {parseSide(text.substr(0, cross)), parseSide(text.substr(cross + 1))};
}
} // namespace

std::vector<Extent> parseSizes(const std::string& text)
{
    std::vector<Extent> sizes;
    std::string_view rest = text;
    while (true)
    {
        const size_t comma = rest.find(',');
        const Extent size = parseSize(rest.substr(0, comma));
        if (size.width == 0 || size.height == 0)
            throw SettingError("--sizes " + text + ": expected WxH,... with sides from 1 to 65535");
        sizes.push_back(size);
        if (comma == std::string_view::npos) return sizes;
        rest.remove_prefix(comma + 1);
    }
}

std::optional<Options> parseOptions(int argumentCount, const char* const* arguments)
{
    CLI::App app("Measures GPU time by pass against the bandwidth floor, CPU time and memory on generated input.");
    Options options;
    Texts texts;
    declareOptions(app, options, texts);
    if (!parseArguments(app, argumentCount, arguments)) return std::nullopt;
    options.denoisers = selectDenoisers(texts.denoisers);
    options.sizes = parseSizes(texts.sizes);
    options.workload.skyShare = texts.skyPercent * 0.01f;
    options.workload.preset = parsePreset(texts.preset);
    for (const std::string& text : texts.settings) options.workload.settings.push_back(parseAssignment(text));
    return options;
}
} // namespace sample::bench
