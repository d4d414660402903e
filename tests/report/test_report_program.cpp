// The program itself on a small capture of a noisy wall, with the validation layers on.
#include "outcome.h"

#include "capture.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <random>
#include <regex>

using namespace sample;

namespace
{
constexpr int kWidth = 48;
constexpr int kHeight = 32;
constexpr int kFrameCount = 10;

using test::Outcome;

// `before` stands in front of the program's name.
Outcome run(const std::string& arguments, const std::string& before = "")
{
    return test::runCommand(before + NRD_REPORT + " " + arguments + " 2>&1");
}

void fill(Planes& planes, Channel first, std::initializer_list<float> values)
{
    int offset = 0;
    for (float value : values) planes[next(first, offset++)].assign(planes.pixelCount(), value);
}

// A wall that faces the camera, whose diffuse light is 1 times [0; 2).
Planes makeFrame(std::mt19937& rng)
{
    Planes frame(kWidth, kHeight);
    fill(frame, Channel::ViewZ, {5.0f});
    fill(frame, Channel::NormalX, {0.0f, 0.0f, -1.0f});
    fill(frame, Channel::Roughness, {0.5f});
    fill(frame, Channel::MotionX, {0.0f, 0.0f, 0.0f});
    fill(frame, Channel::DiffuseR, {1.0f, 1.0f, 1.0f, 1.75f, 0.0f, 0.0f, -1.0f});
    fill(frame, Channel::DiffuseFactorR, {0.5f, 0.5f, 0.5f});
    std::uniform_real_distribution<float> factor(0.0f, 2.0f);
    for (size_t i = 0; i < frame.pixelCount(); i++)
    {
        const float f = factor(rng);
        for (int c = 0; c < 3; c++) frame[next(Channel::DiffuseR, c)][i] *= f;
    }
    return frame;
}

std::string makeCapture(const std::filesystem::path& folder, bool hasReferences = true)
{
    std::mt19937 rng(1);
    CaptureInfo info;
    info.name = "noisy wall";
    info.width = kWidth;
    info.height = kHeight;
    CaptureWriter writer(folder, info);
    for (int i = 0; i < kFrameCount; i++)
    {
        CaptureFrame frame;
        frame.viewToClip = {1.0, 0, 0, 0, 0, 1.5, 0, 0, 0, 0, 1.00001, 1, 0, 0, -0.0100001, 0};
        frame.worldToView = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
        writer.addFrame(frame, makeFrame(rng));
        if (i < 7 || !hasReferences) continue;
        Planes reference(kWidth, kHeight);
        fill(reference, Channel::RefDiffuseR, {1.0f, 1.0f, 1.0f, 0.5f});
        fill(reference, Channel::RefComposedR, {0.5f, 0.5f, 0.5f});
        writer.addReference(static_cast<size_t>(i), reference);
    }
    writer.finish();
    return folder.string();
}

struct Folder
{
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("nrd-test-report-" + std::to_string(std::random_device()()));
    ~Folder()
    {
        std::error_code error;
        std::filesystem::remove_all(path, error);
    }
};

std::string textOf(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(stream), {});
}

// Whether every tag is closed by its own name, innermost first.
bool isWellFormed(const std::string& xml)
{
    const std::regex tag("<(/?)([A-Za-z:]+)[^<>]*?(/?)>");
    std::vector<std::string> open;
    size_t count = 0;
    for (std::sregex_iterator i(xml.begin(), xml.end(), tag), end; i != end; ++i, ++count)
    {
        const bool isEnd = (*i)[1].length() != 0, isEmpty = (*i)[3].length() != 0;
        if (isEnd && (open.empty() || open.back() != (*i)[2])) return false;
        if (isEnd) open.pop_back();
        if (!isEnd && !isEmpty) open.push_back((*i)[2]);
    }
    return count > 0 && open.empty();
}

std::filesystem::path writePeer(const std::filesystem::path& file)
{
    std::ofstream(file) << R"([{"capture": "noisy wall", "denoiser": "RELAX_DIFFUSE",
        "mean": {"noisy": {}, "denoised": {"composed": {"psnr": 31.5, "flip": 0.07}}},
        "gpuMs": {"total": 0.003072, "device": "Some device"}}])";
    return file;
}

const char* const kFew = " --validation --denoisers 'RELAX_DIFFUSE|REFERENCE|SIGMA_SHADOW' --points 'FAST|default' ";
} // namespace

TEST_CASE("a report of a capture has its points, its fronts and a plot", "[gpu]")
{
    Folder folder;
    const std::string capture = makeCapture(folder.path / "capture");
    const std::string peer = writePeer(folder.path / "peer.json").string();
    const std::filesystem::path out = folder.path / "out folder";
    const Outcome outcome = run(capture + kFew + "--point 'mine <&>: atrousIterationNum=3' --preset BEST --peer " +
                                peer + " --out '" + out.string() + "'");
    INFO(outcome.text);
    REQUIRE(outcome.exitCode == 0);
    const nlohmann::json json = nlohmann::json::parse(textOf(out / "report.json"));
    REQUIRE(json.size() == 5); // without SIGMA_SHADOW, which finds no shadow
    const std::pair<const char*, const char*> expected[] = {
        {"noisy", "noisy input"}, {"ours", "FAST"}, {"ours", "mine <&>"}, {"peer", "peer"}, {"ours", "default"}};
    for (size_t i = 0; i < 5; i++)
    {
        INFO(i);
        CHECK(json[i]["kind"] == expected[i].first);
        CHECK(json[i]["point"] == expected[i].second);
        CHECK(json[i]["group"] == "diffuse");
        CHECK(json[i]["psnr"].get<double>() > 0.0);
    }
    CHECK(json[1]["settings"] == "FAST");
    CHECK(json[2]["settings"] == "BEST atrousIterationNum=3");
    CHECK(json[1]["psnr"].get<double>() > json[0]["psnr"].get<double>() + 3.0);
    CHECK(json[1]["psnr"] != json[2]["psnr"]);
    CHECK(json[0]["flipFront"] == true); // nothing is faster
    CHECK(json[3]["msPerMegapixel"].get<double>() == Approx(2.0));
    CHECK(json[4]["denoiser"] == "REFERENCE");

    const std::string svg = textOf(out / "noisy_wall-diffuse.svg");
    CHECK(isWellFormed(svg));
    for (const char* part : {"<svg", "mine &lt;&amp;", "Pareto front", "on Some device", "noisy wall, diffuse", "PSNR"})
        CHECK_THAT(svg, containing(part));
    CHECK_THAT(textOf(out / "report.md"), containing("![](noisy_wall-diffuse.svg)"));
    CHECK_THAT(textOf(out / "report.csv"), containing("\"mine <&>\""));
}

TEST_CASE("without gnuplot all but the plots is written, and one sentence says so", "[gpu]")
{
    Folder folder;
    const std::string capture = makeCapture(folder.path / "capture");
    const std::filesystem::path out = folder.path / "out";
    const Outcome outcome = run(capture + kFew + "--frames 8 --out " + out.string(), "PATH=/none ");
    INFO(outcome.text);
    CHECK(outcome.exitCode == 1);
    CHECK_THAT(outcome.text, containing("nrd-report: gnuplot, of the package gnuplot-nox, cannot be run"));
    for (const char* name : {"report.md", "report.csv", "report.json", "noisy_wall-diffuse.gnuplot"})
        CHECK_FALSE(textOf(out / name).empty());
    CHECK_FALSE(std::filesystem::exists(out / "noisy_wall-diffuse.svg"));
}

TEST_CASE("bad input of nrd-report ends in one sentence and exit code 1", "[program]")
{
    Folder folder;
    const std::string capture = makeCapture(folder.path / "capture") + " --out " + (folder.path / "out").string();
    std::ofstream(folder.path / "file");
    const std::pair<std::string, const char*> rows[] = {
        {"", "no capture"},
        {"--bogus", "--bogus"},
        {"somewhere", "--out is missing"},
        {capture + "-none --denoisers '('", "--denoisers"},
        {capture + " --denoisers FOO", "FOO"},
        {capture + " --denoisers SIGMA_SHADOW", "has the layers of none"},
        {capture + " --points '('", "--points"},
        {capture + " --points none", "nothing is left to measure"},
        {capture + " --preset GOOD", "FAST BALANCED BEST"},
        {capture + " --point mine", "NAME: key=value"},
        {capture + " --point 'mine: foo=1'", "mine: no chosen denoiser"},
        {capture + " --point 'mine: maxBlurRadius=wide'", "maxBlurRadius=wide"},
        {capture + " --frames 0", "--frames"},
        {"/none --out " + (folder.path / "out").string(), "/none"},
        {makeCapture(folder.path / "other") + " --out " + (folder.path / "file").string(), "cannot be"},
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

TEST_CASE("a capture without references, and a file that is no list of figures, are refused", "[gpu]")
{
    Folder folder;
    const std::string out = " --out " + (folder.path / "out").string();
    const Outcome bare = run(makeCapture(folder.path / "bare", false) + kFew + out);
    CHECK(bare.exitCode == 1);
    CHECK_THAT(bare.text, containing("noisy wall has no reference"));
    const Outcome noPeer = run(makeCapture(folder.path / "capture") + kFew + "--peer /none.json" + out);
    CHECK(noPeer.exitCode == 1);
    CHECK_THAT(noPeer.text, containing("/none.json"));
}

TEST_CASE("nrd-report prints its version, its help and the devices", "[gpu]")
{
    for (const char* option : {"--version", "--help", "--list-devices"})
    {
        const Outcome outcome = run(option);
        CHECK(outcome.exitCode == 0);
        CHECK_FALSE(outcome.text.empty());
    }
}
