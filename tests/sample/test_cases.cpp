// Numbered tests: what a folder says, and that a run leaves a capture with its report.
#include "capture.h"
#include "catch.h"
#include "gltf_builder.h"
#include "program.h"
#include "replay_report.h"
#include "test_case.h"

#include <fstream>

using namespace sample;
using test::Outcome;

namespace
{
CameraKey keyOf(uint32_t frame, float x, Approach approach = Approach::Smooth)
{
    CameraKey key;
    key.frame = frame;
    key.eye = {x, 0.0f, 1.0f};
    key.target = {x, 0.0f, 0.0f};
    key.approach = approach;
    return key;
}

std::string refusalOf(const std::string& json)
{
    const test::TemporaryFolder folder;
    std::ofstream(folder / kTestFile) << json;
    try
    {
        readTest(folder / ".");
    }
    catch (const std::exception& error)
    {
        return error.what();
    }
    return "";
}
} // namespace

TEST_CASE("a camera path is even between keys, held at its ends, and jumps where it says so", "[unit]")
{
    TestCase test;
    CHECK_FALSE(keyAt(test, 3).has_value());
    test.cameras = {keyOf(2, 0.0f), keyOf(6, 4.0f), keyOf(8, 10.0f, Approach::Cut), keyOf(10, 11.0f, Approach::Jump)};
    const auto x = [&](uint32_t frame) { return keyAt(test, frame)->eye.x; };
    CHECK(x(0) == 0.0f);
    CHECK(x(3) == 1.0f);
    CHECK(x(6) == 4.0f);
    CHECK(x(7) == 4.0f);
    CHECK(x(8) == 10.0f);
    CHECK(x(9) == 10.0f);
    CHECK(x(20) == 11.0f);
    CHECK(keyAt(test, 8)->approach == Approach::Cut);
    CHECK(keyAt(test, 9)->approach == Approach::Smooth);
    test.cameras[0].time = 1.0;
    test.cameras[1].time = 3.0;
    CHECK(keyAt(test, 4)->time.value() == 2.0);
    CHECK_FALSE(keyAt(test, 7)->time.has_value());
}

TEST_CASE("a key's camera comes back from its matrices", "[unit]")
{
    CameraKey key = keyOf(0, 2.0f);
    key.target = {0.5f, -0.25f, -3.0f};
    key.verticalFov = 0.7f;
    const Camera camera = cameraOf(key, 1.5f);
    const CameraKey back = sample::keyOf(camera);
    const Camera again = cameraOf(back, 1.5f);
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r)
        {
            CHECK(again.worldToView[c][r] == Approx(camera.worldToView[c][r]).margin(1e-5));
            CHECK(again.viewToClip[c][r] == Approx(camera.viewToClip[c][r]).margin(1e-5));
        }
}

TEST_CASE("a test is read as it was written, and tests are numbered on", "[unit]")
{
    const test::TemporaryFolder folder;
    TestCase test;
    test.what = "something";
    test.arguments = {"--scene", "bumps", "--set", "a=b"};
    test.cameras = {keyOf(0, 1.0f), keyOf(5, 2.0f, Approach::Jump)};
    test.cameras[1].time = 0.5;
    test.lights = {{3, 0, 0.25f}};
    CHECK(nextTest(folder / "none").filename() == "001");
    writeTest(folder / "041-first", test);
    std::filesystem::create_directories(folder / "900-no-test");
    REQUIRE(findTests(folder / ".").size() == 1);
    CHECK(nextTest(folder / ".").filename() == "901");
    const TestCase read = readTest(folder / "041-first");
    CHECK(read.name == "041-first");
    CHECK(read.what == test.what);
    CHECK(read.arguments == test.arguments);
    REQUIRE(read.cameras.size() == 2);
    CHECK(read.cameras[1].eye == test.cameras[1].eye);
    CHECK(read.cameras[1].time == test.cameras[1].time);
    CHECK(read.cameras[1].approach == Approach::Jump);
    REQUIRE(read.lights.size() == 1);
    CHECK(read.lights[0].factor == 0.25f);
}

TEST_CASE("what is wrong with a test is said in a sentence", "[unit]")
{
    const std::string head = R"({"arguments": [], "cameras": [{"frame": 0, "eye": [0, 0, 1], )";
    for (const auto& [json, part] :
         {std::pair<std::string, std::string>("{", "is no test"),
          {"{}", "arguments"},
          {head + R"("target": [0, 0, 1]}]})", "eye and target are one point"},
          {head + R"("target": [0, 0, 0], "approach": "fly"}]})", "neither smooth, jump nor cut"},
          {head + R"("target": [0, 0, 0], "verticalFov": 0}]})", "verticalFov"},
          {head + R"("target": [0, 0, 0]}, {"frame": 0, "eye": [0, 0, 1], "target": [0, 0, 0]}]})", "do not grow"},
          {R"({"arguments": [], "lights": [{"frame": 0, "light": 0, "factor": -1}]})", "factor"}})
    {
        INFO(json);
        CHECK_THAT(refusalOf(json), containing(part) && containing(kTestFile));
    }
}

TEST_CASE("the tests that come with the sample can be read, and their frames are in their range", "[unit]")
{
    const auto folders = findTests(NRD_SAMPLE_TESTS);
    CHECK(folders.size() >= 19);
    for (const auto& folder : folders)
    {
        INFO(folder.string());
        const TestCase test = readTest(folder);
        CHECK(test.what != "");
        for (const CameraKey& key : test.cameras) CHECK(key.frame < 33);
        for (const LightKey& key : test.lights) CHECK(key.frame < 33);
    }
}

TEST_CASE("a folder of tests is run, each leaves a capture with its report", "[program]")
{
    const test::TemporaryFolder folder;
    const std::string size =
        R"("--size", "48x32", "--reference-spp", "2", "--reference-frames", "7,8", "--frames", "9"])";
    std::filesystem::create_directories(folder / "in/001");
    std::filesystem::create_directories(folder / "in/002");
    std::ofstream(folder / "in/001/test.json")
        << R"({"what": "a", "arguments": ["--denoiser", "RELAX_DIFFUSE_SPECULAR", "--confidence", )" + size +
               R"(, "cameras": [{"frame": 0, "eye": [0, 1.6, 3], "target": [0, 1, 0]},
                                {"frame": 8, "eye": [1, 1.6, 3], "target": [1, 1, 0]}]})";
    std::ofstream(folder / "in/002/test.json")
        << R"({"what": "b", "arguments": ["--scene", "panes", "--denoiser", "REBLUR_DIFFUSE+SIGMA_SHADOW", )" + size +
               R"(, "lights": [{"frame": 3, "light": 0, "factor": 0}]})";
    const Outcome outcome = test::runProgram(NRD_SAMPLE, "--validation --tests " + (folder / "in").string() +
                                                             " --test-results " + (folder / "out").string());
    INFO(outcome.errors << outcome.output);
    REQUIRE(outcome.exitCode == 0);
    CHECK_THAT(outcome.output,
               containing("001: RELAX_DIFFUSE_SPECULAR, PSNR") && containing("002: REBLUR_DIFFUSE+SIGMA_SHADOW, PSNR"));
    for (const char* name : {"001", "002"})
    {
        const std::filesystem::path results = folder / "out" / name;
        const Capture capture = Capture::open(results / "capture");
        CHECK(capture.info().frames.size() == 9);
        const ReplayReport report = readReport(results / "report.json");
        CHECK(report.capture == name);
        CHECK(report.denoised[size_t(Signal::Composed)].flip.has_value());
        CHECK(std::filesystem::file_size(results / "denoised.png") > 100);
        CHECK(readTest(results).arguments.size() > 4); // so that the folder is one report of a bug
    }
    // The camera went where the path says.
    const auto frames = Capture::open(folder / "out/001/capture").info().frames;
    CHECK(frames[0].worldToView != frames[8].worldToView);
    CHECK(frames[4].worldToView[12] == Approx(-0.5).margin(1e-4));

    std::ofstream(folder / "in/002/test.json") << R"({"arguments": ["--denoiser", "NOTHING"]})";
    const Outcome refused = test::runProgram(NRD_SAMPLE, "--tests " + (folder / "in").string() + " --test-results " +
                                                             (folder / "out").string());
    CHECK(refused.exitCode == 1);
    CHECK_THAT(refused.errors, containing("002: ") && containing("NOTHING"));
}
