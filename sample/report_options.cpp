#include "report_options.h"
#include "name_choice.h"
#include "program.h"

#include <CLI/CLI.hpp>

namespace sample::report
{
namespace
{
struct Texts
{
    std::string denoisers = "(REBLUR|RELAX)_DIFFUSE(_SPECULAR)?|SIGMA_.*|REFERENCE";
    std::string preset = "BALANCED";
    std::vector<std::string> points;
    std::string timeSize;
};

void declareOptions(CLI::App& app, Options& options, Texts& texts)
{
    options.pointNames = ".*";
    app.add_option("capture", options.captures, "Folders of captures");
    app.add_option("--out", options.out, "Folder for report.md, report.csv, report.json and the plots");
    app.add_option("--denoisers", texts.denoisers, "Regular expression for whole names; " + texts.denoisers);
    app.add_option("--points", options.pointNames, "Regular expression for the names of the built-in settings; all");
    app.add_option("--preset", texts.preset, "Of the settings that --point gives: FAST, BALANCED (default) or BEST");
    app.add_option("--point", texts.points, "\"NAME: key=value key=value\": settings of your own; repeatable")
        ->take_all();
    app.add_option("--peer", options.peer, "File with recorded figures, drawn beside ours");
    app.add_option(
        "--time-size", texts.timeSize,
        "WxH: GPU times of generated input of this size; the captures' own, which mean little on a fast GPU");
    app.add_option("--peer-times", options.peerTimes, "File with recorded times, for --time-size");
    app.add_option("--frames", options.frameCount, "Replay only so many frames")
        ->check(CLI::Range(size_t(1), size_t(1000000)));
    app.add_option("--device", options.device, "Number or part of the name of the device");
    app.add_flag("--list-devices", options.isDeviceListWanted, "List the Vulkan devices");
    app.add_flag("--validation", options.validation, "Turn the validation layers on; a message makes the run fail");
    app.set_version_flag("--version", versionText("nrd-report"), "Print the version");
}

// A point that no denoiser has the settings of is a mistyped one.
void checkPoint(const Point& point, const std::vector<const ReplayDenoiser*>& denoisers)
{
    for (const ReplayDenoiser* denoiser : denoisers)
        if (hasSettings(denoiser->family, point)) return;
    throw SettingError("--point " + point.name + ": no chosen denoiser has all of its settings");
}

void complete(Options& options, const Texts& texts)
{
    parseNames("--points", options.pointNames);
    options.denoisers = selectDenoisers(texts.denoisers);
    if (!texts.timeSize.empty()) options.timeSize = bench::parseSizes(texts.timeSize).front();
    const nrd::Quality preset = parsePreset(texts.preset);
    for (const std::string& text : texts.points)
    {
        options.points.push_back(parsePoint(text, preset));
        checkPoint(options.points.back(), options.denoisers);
    }
    if (options.isDeviceListWanted) return;
    if (options.captures.empty()) throw SettingError("no capture is given; expected the folders of some");
    if (options.out.empty()) throw SettingError("--out is missing; expected a folder");
}
} // namespace

std::optional<Options> parseOptions(int argumentCount, const char* const* arguments)
{
    CLI::App app("Draws the speed of denoisers and settings against their error on recorded captures.");
    Options options;
    Texts texts;
    declareOptions(app, options, texts);
    if (!parseArguments(app, argumentCount, arguments)) return std::nullopt;
    complete(options, texts);
    return options;
}
} // namespace sample::report
