// nrd-sample: a glTF path tracer that denoises with the library, headless or in a window.
#include "demo.h"
#include "exr.h"
#include "renderer.h"
#include "test_run.h"
#ifdef NRD_HAS_WINDOW
#include "window/app.h"
#endif

#include <chrono>
#include <cstdio>
#include <unistd.h>

namespace
{
using namespace sample;

// One line that rewrites itself on a terminal, else a line now and then.
class Progress
{
public:
    void show(const std::string& text)
    {
        const auto now = std::chrono::steady_clock::now();
        const double seconds = std::chrono::duration<double>(now - m_last).count();
        if (seconds < (m_isTerminal ? 0.1 : 10.0)) return;
        m_last = now;
        m_hasLine = m_isTerminal;
        std::fprintf(stderr, m_isTerminal ? "\r\033[K%s" : "%s\n", text.c_str());
    }
    void finish()
    {
        if (m_hasLine) std::fprintf(stderr, "\r\033[K");
        m_hasLine = false;
    }

private:
    bool m_isTerminal = isatty(STDERR_FILENO) != 0;
    bool m_hasLine = false;
    std::chrono::steady_clock::time_point m_last = std::chrono::steady_clock::now();
};

void writePicture(const std::filesystem::path& file, const Image& image)
{
    if (file.extension() == ".png") return writePng(file, image);
    ExrPicture picture;
    picture.width = image.width;
    picture.height = image.height;
    constexpr const char* kNames[] = {"R", "G", "B"};
    for (size_t c = 0; c < 3; ++c)
    {
        ExrChannel channel;
        channel.name = kNames[c];
        channel.type = ExrType::Float;
        for (size_t i = c; i < image.rgba.size(); i += 4) channel.values.push_back(image.rgba[i]);
        picture.channels.push_back(std::move(channel));
    }
    writeExr(file, picture);
}

// Everything that happens to the frames of one run, in order.
class Run
{
public:
    Run(const Options& options, Renderer& renderer)
        : m_options(options), m_renderer(renderer), m_info(renderer.captureInfo())
    {
        const bool isAlone = options.sets.size() == 1;
        for (const DenoiserSet& set : options.sets)
            m_columns.push_back({isAlone ? "denoised" : "denoised-" + set.name(), {m_info, producedSignals()}});
        if (!options.capture.empty()) m_writer.emplace(options.capture, m_info);
    }

    void execute()
    {
        for (uint32_t i = 0; i < m_options.frames; ++i) frame(i);
        m_progress.finish();
        if (m_writer) m_writer->finish();
        if (!m_options.screenshot.empty()) writePicture(m_options.screenshot, m_renderer.readShown());
        if (!m_options.demo.empty()) finishDemo();
    }

private:
    // Of any set, so that all are held against the same noisy picture.
    SignalSet producedSignals() const
    {
        SignalSet produced = {};
        const auto add = [&](Signal signal, bool isProduced) { produced[static_cast<size_t>(signal)] |= isProduced; };
        for (const DenoiserSet& set : m_options.sets)
        {
            add(Signal::Diffuse, set.lobes->hasRadiance(Lobe::Diffuse));
            add(Signal::Specular, set.lobes->hasRadiance(Lobe::Specular));
        }
        add(Signal::Shadow, m_options.hasShadowSignal);
        add(Signal::Translucency, m_options.hasShadowSignal);
        return produced;
    }

    void frame(uint32_t index)
    {
        const std::string place = "frame " + std::to_string(index + 1) + " of " + std::to_string(m_options.frames);
        m_progress.show(place);
        m_renderer.renderFrame();
        if (m_options.switchEvery > 0 && index % m_options.switchEvery == 0)
            std::printf("frame %u: %s\n", index, m_options.sets[m_renderer.shownSet()].name().c_str());
        const bool isLast = index + 1 == m_options.frames;
        const bool isReference = m_options.referenceSpp > 0 && m_options.referenceFrames.contains(index);
        const bool isNoisyWanted = isLast && !m_options.noisyScreenshot.empty();
        if (!m_writer && !isReference && !isNoisyWanted) return;
        const Planes planes = m_renderer.readFrame();
        if (m_writer) m_writer->addFrame(m_renderer.captureFrame(), planes);
        if (isNoisyWanted) writePicture(m_options.noisyScreenshot, composeNoisy(planes));
        if (isReference) reference(index, planes, place);
    }

    void reference(uint32_t index, const Planes& planes, const std::string& place)
    {
        const auto progress = [&](double share)
        { m_progress.show(place + ", reference " + std::to_string(int(100.0 * share)) + " %"); };
        const Planes reference = m_renderer.traceReference(planes, m_options.referenceSpp, progress);
        if (m_writer) m_writer->addReference(index, reference);
        if (index + 1 == m_options.frames && !m_options.referenceScreenshot.empty())
            writePicture(m_options.referenceScreenshot, composedOf(reference));
        if (m_options.demo.empty()) return;
        for (size_t i = 0; i < m_columns.size(); ++i)
        {
            const Signals denoised = readDenoised(i, planes);
            m_columns[i].measurer.add(index, planes, reference, &denoised);
        }
    }

    // What others denoise and this set doesn't is noisy, as in its composed picture.
    Signals readDenoised(size_t set, const Planes& planes)
    {
        Signals signals = m_renderer.readDenoised(set);
        Signals noisy = noisySignals(planes, m_info, producedSignals());
        for (size_t s = 0; s < kSignalCount; ++s)
            if (!signals.pictures[s].exists()) signals.pictures[s] = std::move(noisy.pictures[s]);
        return signals;
    }

    void finishDemo()
    {
        if (m_columns.front().measurer.frames().empty())
            throw FileError("the demo has no frame with a reference; --frames is too small");
        writeDemoPictures(m_options.demo, m_columns);
        printErrorTable(m_columns);
    }

    const Options& m_options;
    Renderer& m_renderer;
    const CaptureInfo m_info;
    std::vector<DemoColumn> m_columns; // by set
    std::optional<CaptureWriter> m_writer;
    Progress m_progress;
};

// What several denoisers side by side cost; each has its own history.
void printMemory(const Options& options, const Renderer& renderer)
{
    if (options.sets.size() < 2) return;
    std::printf("Every frame is denoised %zu times. Memory in MiB:", options.sets.size());
    for (size_t i = 0; i < options.sets.size(); ++i)
        std::printf("%s %s %.1f", i > 0 ? "," : "", options.sets[i].name().c_str(), renderer.denoiserMiB(i));
    std::printf("\n");
}

void run(Options options)
{
    if (options.listDevices)
    {
        for (const std::string& line : engine::listDevices()) std::printf("%s\n", line.c_str());
        return;
    }
    Stage stage = loadStage(options);
    for (std::string& note : settleDenoisers(options, stage.scene)) stage.notes.push_back(std::move(note));
    const engine::Device device(deviceDescOf(options));
    for (const std::string& note : stage.notes) std::printf("%s\n", note.c_str());
    if (!options.demo.empty()) std::filesystem::create_directories(options.demo);
    {
        Renderer renderer(device, stage, options);
        if (renderer.isFraming()) std::printf("The scene has no camera: using one that frames it.\n");
        printMemory(options, renderer);
        Run(options, renderer).execute();
    }
    checkValidation(device);
}

void openWindow([[maybe_unused]] const Options& options)
{
#ifdef NRD_HAS_WINDOW
    runWindow(options);
#else
    throw engine::Error("this build has no window; run it with --headless");
#endif
}
} // namespace

int main(int argumentCount, char** arguments)
{
    int exitCode = 0;
    const std::optional<Options> options = parseOptions(argumentCount, arguments, exitCode);
    if (!options) return exitCode;
    try
    {
        if (!options->tests.empty())
        {
            runTests(*options);
            return 0;
        }
        const bool isHeadless = options->isHeadless || options->listDevices || !options->demo.empty();
        isHeadless ? run(*options) : openWindow(*options);
        return 0;
    }
    catch (const std::exception& error)
    {
        std::fprintf(stderr, "error: %s\n", error.what());
        return 1;
    }
}
