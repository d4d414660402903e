// The program itself on a small capture of a constant signal, with the validation layers on.
#include "outcome.h"

#include "capture.h"
#include "exr.h"
#include "replay_denoisers.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <iterator>
#include <random>

using namespace sample;

namespace
{
constexpr int kWidth = 48;
constexpr int kHeight = 32;
constexpr int kFrameCount = 10;

using test::Outcome;

Outcome run(const std::string& arguments)
{
    return test::runCommand(std::string(NRD_REPLAY) + " " + arguments + " 2>&1");
}

void fill(Planes& planes, Channel first, std::initializer_list<float> values)
{
    int offset = 0;
    for (float value : values) planes[next(first, offset++)].assign(planes.pixelCount(), value);
}

struct CaptureOptions
{
    bool hasNormals = true;
    bool isNoisy = false; // diffuse radiance is its constant times [0; 2)
};

// A wall that faces the camera, a strip of sky on top; hit distances are constant, and so is radiance but for noise.
Planes makeFrame()
{
    Planes frame(kWidth, kHeight);
    fill(frame, Channel::ViewZ, {5.0f});
    fill(frame, Channel::NormalX, {0.0f, 0.0f, -1.0f});
    fill(frame, Channel::Roughness, {0.5f});
    fill(frame, Channel::MaterialId, {1.0f});
    fill(frame, Channel::MotionX, {0.0f, 0.0f, 0.0f});
    fill(frame, Channel::DiffuseR, {0.5f, 1.0f, 0.25f, 1.75f, 0.0f, 0.0f, -1.0f});
    fill(frame, Channel::SpecularR, {0.25f, 0.5f, 2.0f, 1.75f, 0.0f, 0.0f, -1.0f});
    fill(frame, Channel::DiffuseFactorR, {0.5f, 0.5f, 0.5f});
    fill(frame, Channel::SpecularFactorR, {0.25f, 0.25f, 0.25f});
    // Nothing is reflected by the sky.
    for (size_t i = 0; i < kWidth * 4; i++)
    {
        frame[Channel::ViewZ][i] = 5000.0f;
        for (int c = 0; c < 7; c++) frame[next(Channel::DiffuseR, c)][i] = frame[next(Channel::SpecularR, c)][i] = 0.0f;
    }
    return frame;
}

Planes makeReference()
{
    Planes reference(kWidth, kHeight);
    fill(reference, Channel::RefDiffuseR, {0.5f, 1.0f, 0.25f, 0.5f});
    const double range = hitDistanceNormalization(CaptureInfo(), 5.0, 0.5);
    fill(reference, Channel::RefSpecularR, {0.25f, 0.5f, 2.0f, static_cast<float>(1.75 / range)});
    fill(reference, Channel::RefComposedR, {0.3125f, 0.625f, 0.625f});
    for (size_t i = 0; i < kWidth * 4; i++)
        for (size_t c = static_cast<size_t>(Channel::RefDiffuseR); c < kChannelCount; c++)
            if (reference.has(static_cast<Channel>(c))) reference[static_cast<Channel>(c)][i] = 0.0f;
    return reference;
}

void addNoise(Planes& frame, std::mt19937& rng)
{
    std::uniform_real_distribution<float> factor(0.0f, 2.0f);
    for (size_t i = 0; i < frame.pixelCount(); i++)
    {
        const float f = factor(rng);
        for (int c = 0; c < 3; c++) frame[next(Channel::DiffuseR, c)][i] *= f;
    }
}

std::filesystem::path makeCapture(const std::filesystem::path& folder, const CaptureOptions& options = {})
{
    std::mt19937 rng(1);
    CaptureInfo info;
    info.name = "constant";
    info.width = kWidth;
    info.height = kHeight;
    CaptureWriter writer(folder, info);
    for (int i = 0; i < kFrameCount; i++)
    {
        CaptureFrame frame;
        frame.viewToClip = {1.0, 0, 0, 0, 0, 1.5, 0, 0, 0, 0, 1.00001, 1, 0, 0, -0.0100001, 0};
        frame.worldToView = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
        Planes planes = makeFrame();
        if (options.isNoisy) addNoise(planes, rng);
        if (!options.hasNormals)
            for (int c = 0; c < 3; c++) planes[next(Channel::NormalX, c)].clear();
        writer.addFrame(frame, planes);
        if (i >= 7) writer.addReference(static_cast<size_t>(i), makeReference());
    }
    writer.finish();
    return folder;
}

// What no capture writer does: takes the channels whose names begin so out of every frame.
void dropChannels(const std::filesystem::path& capture, const std::string& prefix)
{
    for (const auto& entry : std::filesystem::directory_iterator(capture))
    {
        if (entry.path().filename().string().rfind("frame_", 0) != 0) continue;
        ExrPicture picture = readExr(entry.path());
        std::erase_if(picture.channels, [&](const ExrChannel& c) { return c.name.rfind(prefix, 0) == 0; });
        writeExr(entry.path(), picture);
    }
}

struct Folder
{
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("nrd-test-replay-" + std::to_string(std::random_device()()));
    ~Folder()
    {
        std::error_code error;
        std::filesystem::remove_all(path, error);
    }
};
} // namespace

TEST_CASE("a replay of a constant signal gives the signal, its files and its report", "[gpu]")
{
    Folder folder;
    const std::string capture = makeCapture(folder.path / "capture").string();
    const std::string out = (folder.path / "out").string();
    const std::string report = (folder.path / "report.json").string();
    const Outcome outcome = run(capture + " --denoiser REBLUR_DIFFUSE_SPECULAR --validation --out " + out +
                                " --report " + report + " --set maxAccumulatedFrameNum=20");
    INFO(outcome.text);
    REQUIRE(outcome.exitCode == 0);
    const nlohmann::json json = nlohmann::json::parse(std::ifstream(report));
    CHECK(json["denoiser"] == "REBLUR_DIFFUSE_SPECULAR");
    CHECK(json["settings"]["maxAccumulatedFrameNum"] == "20");
    CHECK(json["frames"].size() == 3);
    CHECK(json["mean"]["denoised"]["diffuse"]["psnr"].get<double>() > 55.0);
    CHECK(json["mean"]["denoised"]["specular"]["psnr"].get<double>() > 55.0);
    CHECK(json["mean"]["denoised"]["composed"]["flip"].get<double>() < 0.02);
    CHECK(json["mean"]["denoised"]["normHitDist"]["rmse"].get<double>() < 2e-3);
    CHECK(json["mean"]["noisy"]["normHitDist"]["rmse"].get<double>() == 0.0); // 1.75 / (3 + 0.5) = 0.5
    CHECK(json["memoryMiB"]["permanent"].get<double>() > 0.0);

    const ExrPicture denoised = readExr(folder.path / "out" / "denoised_0009.exr");
    for (const char* name : {"composed.G", "diffuse.R", "diffuse.normHitDist", "specular.B", "specular.normHitDist"})
        CHECK(denoised.find(name));
    CHECK(denoised.find("shadow.V") == nullptr);
    const size_t pixel = 20 * kWidth + 20;
    CHECK(denoised.find("diffuse.G")->values[pixel] == Approx(1.0).epsilon(2e-3));
    CHECK(denoised.find("specular.B")->values[pixel] == Approx(2.0).epsilon(4e-3));
    CHECK(denoised.find("diffuse.G")->values[5] == 0.0f); // sky
    CHECK(std::filesystem::exists(folder.path / "out" / "denoised_0000.exr"));
    for (const char* name : {"noisy_0008.png", "denoised_0008.png", "reference_0008.png", "denoised_0000.png"})
        CHECK(std::filesystem::exists(folder.path / "out" / name));

    const Outcome summary = run("--summary " + report);
    CHECK(summary.exitCode == 0);
    CHECK_THAT(summary.text, containing("constant"));
}

TEST_CASE("every REBLUR and RELAX denoiser keeps a constant signal, and each of its signals is measured", "[gpu]")
{
    Folder folder;
    const std::string capture = makeCapture(folder.path / "capture").string();
    const std::string report = (folder.path / "report.json").string();
    for (const ReplayDenoiser& denoiser : replayDenoisers())
    {
        if (denoiser.family != Family::Reblur && denoiser.family != Family::Relax) continue;
        const std::string name = denoiser.name;
        const Outcome outcome = run(capture + " --denoiser " + name + " --validation --report " + report);
        INFO(name << ": " << outcome.text);
        REQUIRE(outcome.exitCode == 0);
        const nlohmann::json mean = nlohmann::json::parse(std::ifstream(report))["mean"];
        const bool isSh = name.find("_SH") != std::string::npos;
        REQUIRE(mean.contains("extracted") == isSh);
        for (Signal signal : denoiser.signals)
        {
            const SignalInfo& info = signalInfo(signal);
            INFO(info.name);
            const nlohmann::json& noisy = mean["noisy"][info.name];
            const nlohmann::json& measured = mean[isSh ? "extracted" : "denoised"][info.name];
            CHECK(measured["psnr"].get<double>() > 55.0);
            CHECK(measured["flicker"].get<double>() < 1e-3);
            CHECK(noisy["psnr"].get<double>() > 100.0);
            // A resolve knows the surface: light from straight ahead on a wall that is seen at up to 45 degrees.
            if (isSh && info.isRadiance) CHECK(mean["denoised"][info.name]["psnr"].get<double>() > 15.0);
            if (!info.isRadiance) CHECK(measured["rmse"].get<double>() < 2e-3);
        }
    }
}

TEST_CASE("--resolve chooses what an SH signal's colour is", "[gpu]")
{
    Folder folder;
    const std::string capture = makeCapture(folder.path / "capture").string();
    const std::string report = (folder.path / "report.json").string();
    const auto meanOf = [&](const std::string& arguments)
    {
        const Outcome outcome = run(capture + " --denoiser REBLUR_SPECULAR_SH --report " + report + arguments);
        INFO(outcome.text);
        REQUIRE(outcome.exitCode == 0);
        return nlohmann::json::parse(std::ifstream(report))["mean"];
    };
    const nlohmann::json restored = meanOf(""), sg = meanOf(" --resolve sg"), sh = meanOf(" --resolve sh"),
                         none = meanOf(" --resolve none");
    CHECK(restored["extracted"] == sg["extracted"]);
    // The recorded wall is flat, so there is nothing to restore.
    CHECK(restored["denoised"]["specular"]["psnr"].get<double>() ==
          Approx(restored["extracted"]["specular"]["psnr"].get<double>()).margin(0.1));
    CHECK(none["denoised"] == sg["extracted"]);
    CHECK(sh["extracted"] == sg["extracted"]);
    CHECK_FALSE(none.contains("extracted"));
    CHECK(sg["denoised"]["specular"] != sg["extracted"]["specular"]);
    CHECK(sh["denoised"]["specular"] != sg["denoised"]["specular"]);
}

TEST_CASE("confidence and threshold mix reach the denoiser as constants", "[gpu]")
{
    Folder folder;
    const std::string capture = makeCapture(folder.path / "capture", {.isNoisy = true}).string();
    const std::string report = (folder.path / "report.json").string();
    const std::string flags = " --set isHistoryConfidenceAvailable=true --set isDisocclusionThresholdMixAvailable=true";
    const auto psnrOf = [&](const std::string& arguments)
    {
        const Outcome outcome = run(capture + " --denoiser REBLUR_DIFFUSE --validation --report " + report + arguments);
        INFO(outcome.text);
        REQUIRE(outcome.exitCode == 0);
        return nlohmann::json::parse(std::ifstream(report))["mean"]["denoised"]["diffuse"]["psnr"].get<double>();
    };
    const double plain = psnrOf("");
    CHECK(psnrOf(flags) == Approx(plain).epsilon(1e-6)); // 1 and 0 are what the denoiser takes without them
    // Without history the picture is blurred more, which happens to suit a flat wall.
    CHECK(std::abs(psnrOf(flags + " --confidence 0 --disocclusion-mix 1") - plain) > 0.3);
}

TEST_CASE("a preset comes before --set", "[gpu]")
{
    Folder folder;
    const std::string capture = makeCapture(folder.path / "capture", {.isNoisy = true}).string();
    const std::string report = (folder.path / "report.json").string();
    const auto reportOf = [&](const std::string& arguments)
    {
        const Outcome outcome = run(capture + " --denoiser RELAX_DIFFUSE --validation --report " + report + arguments);
        INFO(outcome.text);
        REQUIRE(outcome.exitCode == 0);
        return nlohmann::json::parse(std::ifstream(report));
    };
    const nlohmann::json plain = reportOf(""), fast = reportOf(" --preset FAST"),
                         longer = reportOf(" --preset FAST --set atrousIterationNum=5");
    CHECK(plain["preset"] == "BALANCED");
    CHECK(fast["preset"] == "FAST");
    CHECK(fast["mean"]["denoised"] != plain["mean"]["denoised"]);
    CHECK(longer["mean"]["denoised"] != fast["mean"]["denoised"]);
}

TEST_CASE("the validation overlay comes out as pictures", "[gpu]")
{
    Folder folder;
    const std::string capture = makeCapture(folder.path / "capture").string();
    const std::string out = (folder.path / "out").string();
    const Outcome outcome =
        run(capture + " --denoiser REBLUR_DIFFUSE --validation --frames 2 --set enableValidation=true --out " + out);
    INFO(outcome.text);
    REQUIRE(outcome.exitCode == 0);
    const auto bytesOf = [&](const char* name)
    {
        std::ifstream file(folder.path / "out" / name, std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(file), {});
    };
    const std::string first = bytesOf("validation_0000.png"), second = bytesOf("validation_0001.png");
    REQUIRE(first.rfind("\x89PNG", 0) == 0);
    REQUIRE(second.rfind("\x89PNG", 0) == 0);
    CHECK(second != first);                        // history lengths have grown
    CHECK(second != bytesOf("denoised_0001.png")); // something is drawn over the picture
}

TEST_CASE("REFERENCE and NONE replay too", "[gpu]")
{
    Folder folder;
    const std::string capture = makeCapture(folder.path / "capture").string();
    const std::string report = (folder.path / "report.json").string();
    const Outcome reference = run(capture + " --denoiser REFERENCE --validation --report " + report);
    INFO(reference.text);
    REQUIRE(reference.exitCode == 0);
    nlohmann::json json = nlohmann::json::parse(std::ifstream(report));
    CHECK(json["mean"]["denoised"]["diffuse"]["psnr"].get<double>() > 100.0);
    CHECK_FALSE(json["mean"]["denoised"].contains("specular"));

    const Outcome none = run(capture + " --denoiser NONE --report " + report);
    REQUIRE(none.exitCode == 0);
    json = nlohmann::json::parse(std::ifstream(report));
    CHECK(json["mean"]["denoised"].empty());
    CHECK(json["mean"]["noisy"]["composed"]["psnr"] == 120.0);
    CHECK_FALSE(json.contains("gpuMs"));
}

TEST_CASE("several denoisers replay one by one, each as alone, and end in one table", "[gpu]")
{
    Folder folder;
    const std::string capture = makeCapture(folder.path / "capture", {.isNoisy = true}).string();
    const std::string out = (folder.path / "out").string(), report = (folder.path / "report").string();
    const std::string common = capture + " --validation --set diffuseMaxAccumulatedFrameNum=8 --denoiser ";
    const Outcome alone = run(common + "RELAX_DIFFUSE --report " + report + ".json");
    INFO(alone.text);
    REQUIRE(alone.exitCode == 0);
    const Outcome both = run(common + "RELAX_DIFFUSE_SH,RELAX_DIFFUSE --report " + report + "-of.json --out " + out);
    INFO(both.text);
    REQUIRE(both.exitCode == 0);
    const auto errorsIn = [](const std::string& file)
    { return nlohmann::json::parse(std::ifstream(file))["mean"]["denoised"]["diffuse"]; };
    CHECK(errorsIn(report + "-of-RELAX_DIFFUSE.json") == errorsIn(report + ".json"));
    CHECK(errorsIn(report + "-of-RELAX_DIFFUSE_SH.json") != errorsIn(report + ".json"));
    for (const char* name : {"RELAX_DIFFUSE", "RELAX_DIFFUSE_SH"})
        CHECK(std::filesystem::exists(out + "/" + name + "/denoised_0000.exr"));
    CHECK_THAT(both.text, containing("RELAX_DIFFUSE_SH, 48 x 32"));
}

TEST_CASE("bad input ends in one sentence and exit code 1", "[gpu]")
{
    Folder folder;
    const std::string capture = makeCapture(folder.path / "capture").string();
    const std::string poor = makeCapture(folder.path / "poor", {.hasNormals = false}).string();
    const std::string flat = makeCapture(folder.path / "flat").string();
    dropChannels(flat, "specular.D");
    const std::pair<std::string, const char*> rows[] = {
        {"", "no capture"},
        {"--bogus", "--bogus"},
        {capture, "--denoiser"},
        {capture + " --denoiser FOO", "FOO"},
        {capture + " --denoiser NONE,FOO", "FOO"},
        {capture + " --denoiser NONE,", "expected one of"},
        {capture + " --denoiser NONE,REFERENCE,NONE", "NONE is there twice"},
        {capture + " --denoiser REFERENCE,RELAX_DIFFUSE --set maxAccumulatedFrameNum=4", "maxAccumulatedFrameNum"},
        {poor + " --denoiser REBLUR_DIFFUSE_SPECULAR", "normal.X"},
        {capture + " --denoiser REBLUR_DIFFUSE_SPECULAR --set foo=1", "foo"},
        {capture + " --denoiser REBLUR_DIFFUSE_SPECULAR --set splitScreen=7", "splitScreen"},
        {capture + " --denoiser REBLUR_DIFFUSE_SPECULAR --device none-such", "none-such"},
        {flat + " --denoiser REBLUR_SPECULAR_SH", "specular.DX"},
        {capture + " --denoiser REBLUR_DIFFUSE --confidence 0.5", "isHistoryConfidenceAvailable"},
        {capture + " --denoiser REBLUR_DIFFUSE --disocclusion-mix 0.5", "isDisocclusionThresholdMixAvailable"},
        {capture + " --denoiser REBLUR_DIFFUSE --confidence 2", "--confidence"},
        {capture + " --denoiser REBLUR_SPECULAR_SH --resolve best", "--resolve"},
        {capture + " --denoiser REBLUR_DIFFUSE --preset GOOD", "FAST BALANCED BEST"},
        {capture + " --denoiser NONE --peer /none.json", "/none.json"},
        {capture + " --denoiser NONE --frames 0", "--frames"},
        {capture + "-none --denoiser NONE", "capture-none"},
        {"--summary " + capture + "/capture.json", "capture.json"},
    };
    for (const auto& [arguments, expected] : rows)
    {
        INFO(arguments);
        const Outcome outcome = run(arguments);
        CHECK(outcome.exitCode == 1);
        CHECK_THAT(outcome.text, containing(expected));
        CHECK(std::count(outcome.text.begin(), outcome.text.end(), '\n') == 1);
    }
}
