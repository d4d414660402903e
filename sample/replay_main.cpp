// nrd-replay: denoises a recorded capture and says how far the result is from its references.
#include "replay_doctor.h"
#include "replay_gpu.h"
#include "replay_output.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <unistd.h>

namespace
{
using namespace sample;

constexpr size_t kFirstTimedFrame = 8; // warm-up before it

struct Options
{
    std::string capture;
    std::string denoiser;
    std::string out;
    std::string report;
    std::string peer;
    std::string device;
    std::vector<std::string> settings;
    std::vector<std::string> summary;
    std::string resolve = "restore";
    std::optional<float> confidence;
    std::optional<float> disocclusionMix;
    size_t frameCount = 0; // 0: all
    bool isMarkdown = false;
    bool validation = false;
    bool isDeviceListWanted = false;
    bool isDoctorWanted = false;
};

std::string versionText()
{
    const nrd::LibraryDesc& library = nrd::GetLibraryDesc();
    return "nrd-replay " + std::to_string(library.versionMajor) + "." + std::to_string(library.versionMinor) + "." +
           std::to_string(library.versionBuild);
}

void declareOptions(CLI::App& app, Options& options)
{
    app.add_option("capture", options.capture, "Folder of the capture");
    app.add_option("--denoiser", options.denoiser,
                   "Name of the denoiser, or NONE to measure the noisy input only; A,B replays several one by one");
    app.add_option("--out", options.out,
                   "Folder for denoised_NNNN.exr and PNGs of the composed pictures; of several, one in it each");
    app.add_option("--report", options.report, "File for the JSON report; of several, one each: NAME is put in");
    app.add_option("--peer", options.peer, "File with recorded figures, printed beside ours");
    app.add_option("--set", options.settings, "key=value: any field of the common or the denoiser's settings")
        ->take_all();
    app.add_option("--resolve", options.resolve, "SH: the kind of the resolve: restore (default), sg or sh; or none")
        ->check(CLI::IsMember({"sg", "sh", "restore", "none"}));
    app.add_option("--confidence", options.confidence, "Of every pixel, with --set isHistoryConfidenceAvailable=true")
        ->check(CLI::Range(0.0f, 1.0f));
    app.add_option("--disocclusion-mix", options.disocclusionMix,
                   "Of every pixel, with --set isDisocclusionThresholdMixAvailable=true")
        ->check(CLI::Range(0.0f, 1.0f));
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
    app.set_version_flag("--version", versionText(), "Print the version");
}

// The file given, else the recorded sequences of the test data when they are there; empty: none.
std::filesystem::path peerFile(const Options& options)
{
    if (!options.peer.empty()) return options.peer;
    const std::filesystem::path file = std::filesystem::path(NRD_TEST_DATA) / "peer" / "nrd-4.17.4-sequences.json";
    std::error_code error;
    return std::filesystem::is_regular_file(file, error) ? file : std::filesystem::path();
}

std::optional<PeerFigures> peerOf(const Options& options, const ReplayReport& report)
{
    const std::filesystem::path file = peerFile(options);
    return file.empty() ? std::nullopt : readPeer(file, report.capture, report.denoiser);
}

void showProgress(size_t done, size_t total)
{
    const bool isTerminal = isatty(STDERR_FILENO) != 0;
    if (isTerminal)
        std::fprintf(stderr, "\r%zu of %zu frames%s", done, total, done == total ? "\n" : "");
    else if (done % 16 == 0 || done == total)
        std::fprintf(stderr, "%zu of %zu frames\n", done, total);
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
    for (const std::string& text : options.settings) desc.settings.push_back(parseAssignment(text));
    desc.resolve = chosenResolve(options);
    desc.confidence = options.confidence.value_or(desc.confidence);
    desc.disocclusionMix = options.disocclusionMix.value_or(desc.disocclusionMix);
    desc.isOverlayWanted = !options.out.empty();
    ReplaySettings settings;
    applySettings(settings, denoiser.family, desc.settings);
    if (options.confidence && !settings.common.isHistoryConfidenceAvailable)
        throw SettingError("--confidence needs --set isHistoryConfidenceAvailable=true");
    if (options.disocclusionMix && !settings.common.isDisocclusionThresholdMixAvailable)
        throw SettingError("--disocclusion-mix needs --set isDisocclusionThresholdMixAvailable=true");
    return desc;
}

class Replay
{
public:
    Replay(Options options, const Capture& capture, const ReplayDenoiser& denoiser)
        : m_options(std::move(options)), m_capture(capture), m_measurer(capture.info(), signalSetOf(denoiser))
    {
        m_report.capture = capture.info().name;
        m_report.denoiser = denoiser.name;
        m_report.width = capture.info().width;
        m_report.height = capture.info().height;
        if (denoiser.family == Family::None)
        {
            if (!m_options.settings.empty()) throw SettingError("--set needs a denoiser, not NONE");
            return;
        }
        const ReplayGpuDesc desc = gpuDesc(m_options, capture, denoiser);
        m_report.settings = desc.settings;
        m_gpu = std::make_unique<ReplayGpu>(desc);
        m_report.device = m_gpu->deviceName();
    }

    const ReplayReport& report() const { return m_report; }
    const Options& options() const { return m_options; }

    // Everything but the validation layers' verdict is in the report.
    const ReplayReport& run()
    {
        const size_t all = m_capture.info().frames.size();
        const size_t count = m_options.frameCount ? std::min(m_options.frameCount, all) : all;
        for (size_t i = 0; i < count; i++)
        {
            replayFrame(i);
            showProgress(i + 1, count);
        }
        m_report.frames = m_measurer.frames();
        m_report.noisy = m_measurer.meanNoisy();
        m_report.denoised = m_measurer.meanDenoised();
        m_report.extracted = m_measurer.meanExtracted();
        if (m_gpu)
        {
            m_gpu->reportTimes(m_report, kFirstTimedFrame);
            m_report.memory = m_gpu->memory();
        }
        return m_report;
    }

    uint32_t validationMessageCount() const { return m_gpu ? m_gpu->validationMessageCount() : 0; }

private:
    void replayFrame(size_t index)
    {
        const bool hasReference = !m_capture.info().frames[index].reference.empty();
        const bool isWritten = !m_options.out.empty();
        if (!m_gpu && !hasReference) return;
        const Planes frame = m_capture.readFrame(index);
        ReplayedFrame result;
        if (m_gpu) result = m_gpu->denoise(frame, hasReference || isWritten);
        Signals& denoised = result.signals;
        m_report.nonFiniteCount += countNonFinite(denoised);
        if (hasReference)
        {
            const bool isExtracted = result.extracted.has(Signal::Diffuse) || result.extracted.has(Signal::Specular);
            m_measurer.add(index, frame, m_capture.readReference(index), m_gpu ? &denoised : nullptr,
                           isExtracted ? &result.extracted : nullptr);
            denoised[Signal::Composed] = m_measurer.pictures().denoised;
        }
        else
            compose(denoised, frame, {});
        if (!isWritten) return;
        write(index, denoised, hasReference);
        if (result.overlay.exists()) writeOverlayPng(m_options.out, index, result.overlay, denoised[Signal::Composed]);
    }

    void write(size_t index, const Signals& denoised, bool hasReference) const
    {
        const std::filesystem::path folder = m_options.out;
        writeDenoisedExr(folder, index, denoised);
        writeComposedPng(folder, "denoised", index, denoised[Signal::Composed]);
        if (!hasReference) return;
        writeComposedPng(folder, "noisy", index, m_measurer.pictures().noisy);
        writeComposedPng(folder, "reference", index, m_measurer.pictures().reference);
    }

    const Options m_options;
    const Capture& m_capture;
    SequenceMeasurer m_measurer;
    ReplayReport m_report;
    std::unique_ptr<ReplayGpu> m_gpu; // null: NONE
};

// What would only fail after all the work fails before it.
void prepareOutputs(const Options& options)
{
    if (!options.out.empty())
    {
        std::error_code error;
        std::filesystem::create_directories(options.out, error);
        if (error) throw FileError(options.out + " cannot be created: " + error.message());
    }
    if (!options.report.empty() && !std::ofstream(options.report, std::ios::app))
        throw FileError(options.report + " cannot be written");
}

int replay(const Options& options)
{
    if (options.capture.empty()) throw SettingError("no capture is given; expected the folder of one");
    const std::vector<const ReplayDenoiser*> denoisers = chosenDenoisers(options);
    const Capture capture = Capture::open(options.capture);
    std::vector<std::unique_ptr<Replay>> replays;
    for (const ReplayDenoiser* denoiser : denoisers)
    {
        const Options own = optionsOf(options, *denoiser, denoisers.size() == 1);
        prepareOutputs(own);
        replays.push_back(std::make_unique<Replay>(own, capture, *denoiser));
    }
    std::vector<ReplayReport> reports;
    std::vector<std::optional<PeerFigures>> peers;
    for (std::unique_ptr<Replay>& replay : replays)
    {
        peers.push_back(peerOf(options, replay->report()));
        reports.push_back(replay->run());
        if (!replay->options().report.empty()) writeReport(replay->options().report, reports.back());
        std::cout << formatReport(reports.back(), peers.back());
        if (const uint32_t messageCount = replay->validationMessageCount())
            throw engine::Error("the validation layers had " + std::to_string(messageCount) + " messages");
        replay.reset();
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
    try
    {
        app.parse(argumentCount, arguments);
        return run(options);
    }
    catch (const CLI::ParseError& e)
    {
        if (e.get_exit_code() == 0) return app.exit(e); // --help, --version
        std::cerr << "nrd-replay: " << e.what() << '\n';
    }
    catch (const std::bad_alloc&)
    {
        std::cerr << "nrd-replay: out of memory\n";
    }
    catch (const std::exception& e)
    {
        std::cerr << "nrd-replay: " << e.what() << '\n';
    }
    return 1;
}
