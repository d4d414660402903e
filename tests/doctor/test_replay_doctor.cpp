// nrd-replay --doctor as a program: what it prints and returns, with the validation layers on.
#include "capture.h"
#include "outcome.h"
#include <filesystem>

namespace fs = std::filesystem;

namespace
{
using test::Outcome;

Outcome run(const std::string& command) { return test::runCommand(command + " 2>&1"); }

Outcome diagnose(const fs::path& capture, const std::string& options)
{
    return run(std::string("\"") + NRD_REPLAY + "\" \"" + capture.string() + "\" --doctor --validation " + options);
}

// Frames of the sample's Cornell box, whose camera and block move.
fs::path sampleCapture()
{
    const fs::path folder = fs::path(NRD_OUTPUT) / "sample-capture";
    std::error_code error;
    fs::remove_all(folder, error);
    const Outcome outcome =
        run(std::string("\"") + NRD_SAMPLE + "\" --headless --jitter --fps 10 --size 240x136 --frames 4 --capture \"" +
            folder.string() + '"');
    INFO(outcome.text);
    REQUIRE(outcome.exitCode == 0);
    return folder;
}

// The capture without the layers that only the doctor looks at.
fs::path bareCopy(const fs::path& folder)
{
    using sample::Channel;
    const sample::Capture capture = sample::Capture::open(folder);
    sample::CaptureInfo info = capture.info();
    info.frames.clear();
    const fs::path result = fs::path(NRD_OUTPUT) / "bare-capture";
    sample::CaptureWriter writer(result, info);
    for (size_t i = 0; i < 2; i++)
    {
        sample::Planes planes = capture.readFrame(i);
        for (const Channel first : {Channel::DiffuseFactorR, Channel::SpecularFactorR})
            for (int c = 0; c < 3; c++) planes[sample::next(first, c)].clear();
        sample::CaptureFrame frame = capture.info().frames[i];
        frame.reference.clear();
        writer.addFrame(frame, planes);
    }
    writer.finish();
    return result;
}
} // namespace

TEST_CASE("nrd-replay --doctor finds nothing in the sample's own capture, and faults that are put in", "[gpu]")
{
    const fs::path capture = sampleCapture();
    const Outcome good = diagnose(capture, "");
    INFO(good.text);
    CHECK(good.exitCode == 0);
    CHECK(good.text == "no finding in 4 frames of cornell box\n");

    const Outcome bad =
        diagnose(capture, "--frames 3 --set isMotionVectorInWorldSpace=false --set hitDistanceParameters.A=30");
    INFO(bad.text);
    CHECK(bad.exitCode == 2);
    CHECK_THAT(bad.text, containing("FAULT   MOTION: IN_MV is off by"));
    CHECK_THAT(bad.text, containing("set isMotionVectorInWorldSpace"));
    CHECK_THAT(bad.text, containing("1 finding in 3 frames"));

    const Outcome bare = diagnose(bareCopy(capture), "--denoiser REBLUR_DIFFUSE");
    INFO(bare.text);
    CHECK(bare.exitCode == 0);
    CHECK_THAT(bare.text, containing("NOT SEEN whether diffuse radiance still carries albedo"));
}

TEST_CASE("nrd-replay --doctor ends with one sentence and exit code 1 if it cannot look", "[gpu]")
{
    const std::pair<std::string, const char*> rows[] = {
        {"/none --doctor", "/none"},
        {"--doctor", "no capture"},
    };
    for (const auto& [arguments, expected] : rows)
    {
        const Outcome outcome = run(std::string("\"") + NRD_REPLAY + "\" " + arguments);
        INFO(arguments << ": " << outcome.text);
        CHECK(outcome.exitCode == 1);
        CHECK_THAT(outcome.text, containing(expected));
    }
}
