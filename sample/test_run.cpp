#include "test_run.h"

#include "image_io.h"
#include "renderer.h"
#include "replay_report.h"
#include "sequence.h"
#include "test_case.h"

#include <algorithm>
#include <cstdio>

namespace sample
{
namespace
{
namespace fs = std::filesystem;

// The test's own command line, as if it had been typed in its folder.
Options optionsOf(const TestCase& test, const fs::path& folder)
{
    std::vector<std::string> texts = {"nrd-sample", "--headless"};
    texts.insert(texts.end(), test.arguments.begin(), test.arguments.end());
    std::vector<char*> arguments;
    for (std::string& text : texts) arguments.push_back(text.data());
    int exitCode = 0;
    std::optional<Options> options = parseOptions(int(arguments.size()), arguments.data(), exitCode);
    if (!options) throw FileError("its arguments are refused");
    options->hasWholeSignals = true; // for the capture
    const ReferenceFrames& frames = options->referenceFrames;
    if (frames.every == 0 && frames.list.empty()) options->referenceFrames.every = 8;
    for (fs::path* file : {&options->scene, &options->environment})
        if (!file->empty()) *file = folder / *file; // an absolute one stays
    return std::move(*options);
}

class TestRun
{
public:
    TestRun(const engine::Device& device, const TestCase& test, const Options& options, const fs::path& results)
        : m_device(device), m_test(test), m_options(options), m_results(results), m_stage(loadStage(options))
    {
        settleDenoisers(m_options, m_stage.scene);
        for (const LightKey& key : test.lights)
            if (key.light >= m_stage.scene.lights.size())
                throw FileError("the scene has no light " + std::to_string(key.light));
        for (const PunctualLight& light : m_stage.scene.lights) m_intensities.push_back(light.intensity);
    }

    ReplayReport execute()
    {
        Renderer renderer(m_device, m_stage, m_options);
        const CaptureInfo info = renderer.captureInfo();
        SequenceMeasurer measurer(info, producedSignals());
        CaptureWriter writer(m_results / "capture", info);
        for (uint32_t frame = 0; frame < m_options.frames; ++frame)
        {
            followLights(renderer, frame);
            renderer.renderFrame(inputAt(frame));
            const Planes planes = renderer.readFrame();
            writer.addFrame(renderer.captureFrame(), planes);
            if (m_options.referenceSpp == 0 || !m_options.referenceFrames.contains(frame)) continue;
            const Planes reference = renderer.traceReference(planes, m_options.referenceSpp, [](double) {});
            writer.addReference(frame, reference);
            const Signals denoised = renderer.readDenoised(0);
            measurer.add(frame, planes, reference, &denoised);
        }
        writer.finish();
        writePng(m_results / "denoised.png", renderer.readShown());
        return makeReport(renderer, measurer);
    }

private:
    SignalSet producedSignals() const
    {
        SignalSet produced = {};
        const DenoiserSet& set = m_options.sets.front();
        produced[size_t(Signal::Diffuse)] = set.lobes->hasRadiance(Lobe::Diffuse);
        produced[size_t(Signal::Specular)] = set.lobes->hasRadiance(Lobe::Specular);
        produced[size_t(Signal::Shadow)] = produced[size_t(Signal::Translucency)] = m_options.hasShadowSignal;
        return produced;
    }

    FrameInput inputAt(uint32_t frame)
    {
        FrameInput input;
        const std::optional<CameraKey> key = keyAt(m_test, frame);
        const double step = 1.0 / double(m_options.framesPerSecond);
        input.time = key && key->time ? *key->time : double(frame) * step;
        input.deltaTimeMs = float(1000.0 * std::clamp(frame == 0 ? step : input.time - m_lastTime, 1e-4, 1.0));
        m_lastTime = input.time;
        if (!key) return input;
        input.camera = cameraOf(*key, float(m_options.width) / float(m_options.height));
        input.isCut = key->approach == Approach::Cut;
        return input;
    }

    void followLights(Renderer& renderer, uint32_t frame)
    {
        bool isChanged = false;
        for (const LightKey& key : m_test.lights)
        {
            if (key.frame != frame) continue;
            m_stage.scene.lights[key.light].intensity = key.factor * m_intensities[key.light];
            isChanged = true;
        }
        if (isChanged) renderer.refreshScene();
    }

    ReplayReport makeReport(Renderer& renderer, const SequenceMeasurer& measurer) const
    {
        ReplayReport report;
        report.capture = m_test.name;
        report.denoiser = m_options.sets.front().name();
        report.device = m_device.properties().deviceName;
        report.width = int(m_options.width);
        report.height = int(m_options.height);
        report.settings = m_options.settings;
        const nrd::MemoryStatistics memory = renderer.stage(0).memory();
        constexpr double kMiB = 1024.0 * 1024.0;
        report.memory = {double(memory.permanent) / kMiB, double(memory.transient) / kMiB, double(memory.total) / kMiB};
        report.frames = measurer.frames();
        report.noisy = measurer.meanNoisy();
        report.denoised = measurer.meanDenoised();
        return report;
    }

    const engine::Device& m_device;
    const TestCase& m_test;
    Options m_options;
    fs::path m_results;
    Stage m_stage;
    std::vector<glm::vec3> m_intensities; // of the scene's lights, as read
    double m_lastTime = 0.0;
};

void print(const ReplayReport& report)
{
    const auto show = [](const char* name, const std::optional<double>& noisy, const std::optional<double>& denoised)
    {
        if (noisy && denoised) std::printf(", %s %.4g -> %.4g", name, *noisy, *denoised);
    };
    const SignalMeasures &noisy = report.noisy[size_t(Signal::Composed)],
                         &denoised = report.denoised[size_t(Signal::Composed)];
    std::printf("%s: %s", report.capture.c_str(), report.denoiser.c_str());
    show("PSNR", noisy.psnr, denoised.psnr);
    show("FLIP", noisy.flip, denoised.flip);
    show("flicker", noisy.flicker, denoised.flicker);
    std::printf("\n");
    std::fflush(stdout);
}
} // namespace

void runTests(const Options& options)
{
    const std::vector<fs::path> folders = findTests(options.tests);
    if (folders.empty()) throw FileError(options.tests.string() + " has no test: no folder in it has a " + kTestFile);
    const engine::Device device(deviceDescOf(options));
    for (const fs::path& folder : folders) try
        {
            const TestCase test = readTest(folder);
            const fs::path results = (options.testResults.empty() ? options.tests : options.testResults) / test.name;
            fs::create_directories(results);
            fs::remove_all(results / "capture"); // of an earlier run
            const ReplayReport report = TestRun(device, test, optionsOf(test, folder), results).execute();
            writeReport(results / "report.json", report);
            if (results != folder) writeTest(results, test);
            print(report);
        }
        catch (const std::exception& error)
        {
            throw FileError(folder.filename().string() + ": " + error.what());
        }
    checkValidation(device);
}
} // namespace sample
