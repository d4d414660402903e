// nrd-replay: denoises a recorded capture and says how far the result is from its references.
#include "program.h"
#include "replay_doctor.h"
#include "replay_run.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <iostream>

namespace
{
using namespace sample;

struct Options
{
    std::string capture;
    std::string denoiser;
    std::string out;
    std::string report;
    std::string peer;
    std::string device;
    std::string preset = "BALANCED";
    std::vector<std::string> settings;
    std::vector<std::string> summary;
    std::string resolve = "restore";
    std::optional<float> confidence;
    std::optional<float> disocclusionMix;
    size_t frameCount = 0; // 0: all
    Resolution resolution;
    bool isMarkdown = false;
    bool validation = false;
    bool isDeviceListWanted = false;
    bool isDoctorWanted = false;
};

void declareOptions(CLI::App& app, Options& options)
{
    app.add_option("capture", options.capture, "Folder of the capture");
    app.add_option("--denoiser", options.denoiser,
                   "Name of the denoiser, or NONE to measure the noisy input only; A,B replays several one by one");
    app.add_option("--out", options.out,
                   "Folder for denoised_NNNN.exr and PNGs of the composed pictures; of several, one in it each");
    app.add_option("--report", options.report, "File for the JSON report; of several, one each: NAME is put in");
    app.add_option("--peer", options.peer, "File with recorded figures, printed beside ours");
    app.add_option("--preset", options.preset, "FAST, BALANCED (the defaults) or BEST, before --set");
    app.add_option("--set", options.settings, "key=value: any field of the common or the denoiser's settings")
        ->take_all();
    app.add_option("--resolve", options.resolve, "SH: the kind of the resolve: restore (default), sg or sh; or none")
        ->check(CLI::IsMember({"sg", "sh", "restore", "none"}));
    app.add_option("--confidence", options.confidence, "Of every pixel, with --set isHistoryConfidenceAvailable=true")
        ->check(CLI::Range(0.0f, 1.0f));
    app.add_option("--disocclusion-mix", options.disocclusionMix,
                   "Of every pixel, with --set isDisocclusionThresholdMixAvailable=true")
        ->check(CLI::Range(0.0f, 1.0f));
    declareResolution(app, options.resolution);
    app.add_flag(
        "--doctor", options.isDoctorWanted,
        "Check the inputs instead of denoising them; the exit code is 0 if all is well, 2 if it found something");
    app.add_option("--frames", options.frameCount, "Replay only so many frames")
        ->check(CLI::Range(size_t(1), size_t(1000000)));
    app.add_option("--summary", options.summary, "Print one table of these reports instead of replaying");
    app.add_flag("--markdown", options.isMarkdown, "Print the table of --summary as Markdown");
    app.add_option("--device", options.device, "Number or part of the name of the device");
    app.add_flag("--list-devices", options.isDeviceListWanted, "List the Vulkan devices");
    app.add_flag("--validation", options.validation, "Turn the validation layers on; a message makes the run fail");
    app.set_version_flag("--version", versionText("nrd-replay"), "Print the version");
}

std::optional<PeerFigures> peerOf(const Options& options, const ReplayReport& report)
{
    const std::filesystem::path file = peerFile(options.peer, "nrd-4.17.4-sequences.json");
    return file.empty() ? std::nullopt : readPeer(file, report.capture, report.denoiser);
}

const ReplayDenoiser& denoiserNamed(const std::string& name)
{
    if (const ReplayDenoiser* denoiser = findDenoiser(name)) return *denoiser;
    std::string text = "--denoiser " + name + ": expected one of";
    for (const ReplayDenoiser& denoiser : replayDenoisers()) text += std::string(" ") + denoiser.name;
    throw SettingError(text);
}

std::vector<const ReplayDenoiser*> chosenDenoisers(const Options& options)
{
    if (options.denoiser.empty()) throw SettingError("--denoiser is missing; expected the name of a denoiser, or NONE");
    std::vector<const ReplayDenoiser*> chosen;
    for (size_t at = 0; at <= options.denoiser.size();)
    {
        const size_t comma = std::min(options.denoiser.find(',', at), options.denoiser.size());
        const ReplayDenoiser* denoiser = &denoiserNamed(options.denoiser.substr(at, comma - at));
        if (std::find(chosen.begin(), chosen.end(), denoiser) != chosen.end())
            throw SettingError(std::string("--denoiser ") + denoiser->name + " is there twice");
        chosen.push_back(denoiser);
        at = comma + 1;
    }
    return chosen;
}

// The options of one of several denoisers, whose outputs don't overwrite each other's.
Options optionsOf(Options options, const ReplayDenoiser& denoiser, bool isAlone)
{
    options.denoiser = denoiser.name;
    if (isAlone) return options;
    if (!options.out.empty()) options.out = (std::filesystem::path(options.out) / denoiser.name).string();
    if (options.report.empty()) return options;
    const std::filesystem::path file = options.report;
    options.report =
        (file.parent_path() / (file.stem().string() + "-" + denoiser.name + file.extension().string())).string();
    return options;
}

ShResolve chosenResolve(const Options& options)
{
    if (options.resolve == "none") return ShResolve::None;
    if (options.resolve == "sg") return ShResolve::SphericalGaussians;
    return options.resolve == "sh" ? ShResolve::SphericalHarmonics : ShResolve::Restore;
}

ReplayGpuDesc gpuDesc(const Options& options, const Capture& capture, const ReplayDenoiser& denoiser)
{
    ReplayGpuDesc desc{capture, denoiser, {}, options.device, options.validation};
    desc.preset = parsePreset(options.preset);
    for (const std::string& text : options.settings) desc.settings.push_back(parseAssignment(text));
    desc.resolve = chosenResolve(options);
    desc.confidence = options.confidence.value_or(desc.confidence);
    desc.disocclusionMix = options.disocclusionMix.value_or(desc.disocclusionMix);
    desc.isOverlayWanted = !options.out.empty();
    desc.resolution = options.resolution;
    ReplaySettings settings;
    if (denoiser.family != Family::None) applySettings(settings, denoiser.family, desc.settings);
    if (options.confidence && !settings.common.isHistoryConfidenceAvailable)
        throw SettingError("--confidence needs --set isHistoryConfidenceAvailable=true");
    if (options.disocclusionMix && !settings.common.isDisocclusionThresholdMixAvailable)
        throw SettingError("--disocclusion-mix needs --set isDisocclusionThresholdMixAvailable=true");
    return desc;
}

// One denoiser's part of a run over several.
struct Part
{
    Options options;
    ReplayRun run;
};

Part makePart(Options options, const Capture& capture, const ReplayDenoiser& denoiser)
{
    if (!options.out.empty()) prepareFolder(options.out);
    prepareFile(options.report);
    const ReplayRunDesc desc{gpuDesc(options, capture, denoiser), options.out, options.frameCount};
    return {std::move(options), ReplayRun(desc)};
}

int replay(const Options& options)
{
    if (options.capture.empty()) throw SettingError("no capture is given; expected the folder of one");
    const std::vector<const ReplayDenoiser*> denoisers = chosenDenoisers(options);
    const Capture capture = Capture::open(options.capture);
    std::vector<std::unique_ptr<Part>> parts;
    for (const ReplayDenoiser* denoiser : denoisers)
        parts.push_back(
            std::make_unique<Part>(makePart(optionsOf(options, *denoiser, denoisers.size() == 1), capture, *denoiser)));
    std::vector<ReplayReport> reports;
    std::vector<std::optional<PeerFigures>> peers;
    for (std::unique_ptr<Part>& part : parts)
    {
        peers.push_back(peerOf(options, part->run.report()));
        reports.push_back(part->run.run(showProgress));
        if (!part->options.report.empty()) writeReport(part->options.report, reports.back());
        std::cout << formatReport(reports.back(), peers.back());
        part->run.checkValidation();
        part.reset();
    }
    if (reports.size() > 1) std::cout << '\n' << formatSummary(reports, peers);
    return 0;
}

int summarize(const Options& options)
{
    std::vector<ReplayReport> reports;
    std::vector<std::optional<PeerFigures>> peers;
    for (const std::string& file : options.summary)
    {
        reports.push_back(readReport(file));
        peers.push_back(peerOf(options, reports.back()));
    }
    std::cout << formatSummary(reports, peers, options.isMarkdown ? TableStyle::Markdown : TableStyle::Text);
    return 0;
}

int run(const Options& options)
{
    if (options.isDeviceListWanted)
    {
        for (const std::string& line : engine::listDevices()) std::cout << line << '\n';
        return 0;
    }
    if (options.isDoctorWanted)
        return runDoctor({options.capture, options.denoiser, options.settings, options.frameCount, options.device,
                          options.validation},
                         std::cout);
    return options.summary.empty() ? replay(options) : summarize(options);
}
} // namespace

int main(int argumentCount, char** arguments)
{
    CLI::App app("Denoises a recorded capture and measures the result against its references.");
    Options options;
    declareOptions(app, options);
    const auto parseAndRun = [&] { return parseArguments(app, argumentCount, arguments) ? run(options) : 0; };
    return runProgram("nrd-replay", parseAndRun);
}
