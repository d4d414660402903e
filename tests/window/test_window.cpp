// nrd-sample with its window, under a virtual display, validation on, led by scripts.
#include "capture.h"
#include "catch.h"
#include "gltf_builder.h"
#include "image_io.h"
#include "long_form.h"
#include "program.h"
#include "sample_denoisers.h"

#include <cstdio>
#include <fstream>
#include <sstream>

using test::Outcome;

namespace
{
bool hasDisplay()
{
    const bool isThere = NRD_HAS_WINDOW && std::string(NRD_XVFB_RUN) != "";
    if (!isThere) std::printf("SKIPPED the window: this build has none, or xvfb-run is not here\n");
    return isThere;
}

Outcome runScript(const test::TemporaryFolder& folder, const std::string& script, const std::string& arguments = "")
{
    std::ofstream(folder / "script.txt") << script;
    return test::runProgram(NRD_XVFB_RUN, "-a -s '-screen 0 800x600x24' " NRD_SAMPLE " --validation --size 128x80 "
                                          "--script " +
                                              (folder / "script.txt").string() + " " + arguments);
}

// In the short form one of each family and kind of signal.
std::vector<sample::SampleDenoiser> switchedThrough()
{
    const auto all = sample::sampleDenoisers();
    if (test::isMiddle()) return {all.begin(), all.end()};
    std::vector<sample::SampleDenoiser> few;
    for (const char* name : {"REBLUR_DIFFUSE_SPECULAR_SH", "REBLUR_DIFFUSE_OCCLUSION", "RELAX_SPECULAR", "SIGMA_SHADOW",
                             "REFERENCE", "NONE"})
        few.push_back(*sample::findSampleDenoiser(name));
    return few;
}

std::string screenshot(const test::TemporaryFolder& folder, const std::string& name)
{
    return "screenshot " + (folder / name).string() + "\n";
}
} // namespace

TEST_CASE("a script resizes, switches, records and takes pictures in the window", "[program]")
{
    if (!hasDisplay()) return;
    const test::TemporaryFolder folder;
    std::string script =
        "frames 2\nprint size\nresize 160x96\nframes 3\nprint size\nfullscreen on\nscale 0.2\nframes 2\n"
        "print size\nfullscreen off\nscale 1\nframes 2\nminimize on\nminimize off\n";
    script += "capture " + (folder / "capture").string() + "\nframes 2\ncapture off\n";
    script += "window " + (folder / "window.png").string() + "\npick 60,40\nframes 1\nprint pixel\n";
    script += "denoiser REBLUR_DIFFUSE_SPECULAR,RELAX_DIFFUSE_SPECULAR\nset maxBlurRadius=10\nsplit 0.3\nframes 2\n";
    script += screenshot(folder, "split.png") + screenshot(folder, "split.exr") + "scene panes\nframes 1\nquit\n";
    const Outcome outcome = runScript(folder, script);
    INFO(outcome.errors << outcome.output);
    REQUIRE(outcome.exitCode == 0);
    CHECK_THAT(outcome.output, containing("size 128 x 80 of 128 x 80"));
    CHECK_THAT(outcome.output, containing("size 160 x 96 of 160 x 96"));
    CHECK_THAT(outcome.output, containing("size 160 x 120 of 800 x 600"));
    CHECK_THAT(outcome.output, containing("pixel 60,40 viewZ -"));
    CHECK(sample::Capture::open(folder / "capture").info().frames.size() == 2);
    CHECK(std::filesystem::file_size(folder / "window.png") > 1000);
    CHECK(sample::readImage(folder / "split.exr").width == 160);
}

namespace
{
// The lines that start with `word`.
std::vector<std::string> linesOf(const std::string& text, const std::string& word)
{
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);)
        if (line.rfind(word, 0) == 0) lines.push_back(line);
    return lines;
}

// A key is seen by the frame that follows.
std::string tap(const std::string& key)
{
    return "hold " + key + "\nframes 1\nrelease " + key + "\nframes 1\nprint state\n";
}

std::string drag(const std::string& button, const std::string& from, const std::string& to)
{
    return "cursor " + from + "\nframes 1\nhold " + button + "\nframes 1\ncursor " + to + "\nframes 1\nrelease " +
           button + "\nframes 1\nprint state\n";
}
} // namespace

TEST_CASE("keys and mouse of the window do what they are for", "[program]")
{
    if (!hasDisplay()) return;
    const test::TemporaryFolder folder;
    struct Step
    {
        std::string script;
        std::string part; // of the state it leaves
    };
    const Step steps[] = {
        {"print state\n", "paused 0 compared 0 split 0.50 view 'denoised' panel 1 fullscreen 0 picked -1,-1"},
        {tap("h"), "panel 0"}, // out of the mouse's way
        {tap("space"), "paused 1"},
        {"frames 2\n" + tap("n"), "paused 1"},
        {tap("space"), "paused 0"},
        {tap("c"), "compared 1"},
        {tap("tab"), "view 'noisy'"},
        {tap("tab"), "view 'denoised'"},
        {tap("f11"), "fullscreen 1"},
        {tap("f11"), "fullscreen 0"},
        {drag("left", "64,40", "96,40"), "split 0.75"},   // the bar
        {drag("left", "20,20", "30,20"), "camera orbit"}, // and not the bar
        {tap("1"), "camera scene"},
        {drag("right", "20,20", "30,20"), "camera fly"},
        {tap("w"), "camera fly"},
        {"hold ctrl\n" + drag("left", "32,16", "32,16") + "release ctrl\n", "picked 32,16"},
        {tap("h"), "panel 1"},
    };
    std::string script = "frames 1\n";
    for (const Step& step : steps) script += step.script;
    const Outcome outcome = runScript(folder, script);
    INFO(outcome.errors << outcome.output);
    REQUIRE(outcome.exitCode == 0);
    const std::vector<std::string> states = linesOf(outcome.output, "state ");
    REQUIRE(states.size() == std::size(steps));
    for (size_t i = 0; i < states.size(); ++i)
    {
        INFO(steps[i].script << states[i]);
        CHECK_THAT(states[i], containing(steps[i].part));
    }
    const auto after = [&](size_t i, const std::string& word) { return states[i].substr(states[i].find(word)); };
    const auto frame = [&](size_t i) { return std::stoi(after(i, "frames ").substr(7)); };
    CHECK(frame(3) == frame(2) + 1);             // while paused, one step
    CHECK(after(13, "eye") != after(14, "eye")); // it flew
}

TEST_CASE("an unknown key is refused with the names of those there are", "[program]")
{
    if (!hasDisplay()) return;
    const test::TemporaryFolder folder;
    const Outcome outcome = runScript(folder, "frames 1\nhold escape\n");
    CHECK(outcome.exitCode == 1);
    CHECK_THAT(outcome.errors, containing("script.txt:2: 'escape' is no key"));
}

TEST_CASE("shaders of the denoisers are compiled anew, and what does not compile is told and changes nothing",
          "[program]")
{
    if (!hasDisplay()) return;
    if (!NRD_HAS_HOT_RELOAD) return void(std::printf("SKIPPED hot reload: this build has none\n"));
    const test::TemporaryFolder folder;
    const auto copyShaders = [&](const char* name, const std::string& from, const std::string& to)
    {
        std::filesystem::copy(NRD_SHADER_SOURCES, folder / name, std::filesystem::copy_options::recursive);
        const std::filesystem::path file = folder / name / "relax/atrous.comp.glsl";
        std::stringstream text;
        text << std::ifstream(file).rdbuf();
        const std::string whole = text.str();
        const size_t at = whole.find(from);
        REQUIRE(at != std::string::npos);
        std::ofstream(file) << whole.substr(0, at) << to << whole.substr(at + from.size());
        return "reload " + (folder / name).string() + "\nframes 1\nprint message\n";
    };
    const std::string early = "void main()\n{\n", shot = "view denoised diffuse\nframes 1\n";
    std::string script =
        "denoiser RELAX_DIFFUSE\nlobes merged\nspeed 0\nframes 2\n" + shot + screenshot(folder, "a.exr");
    script += copyShaders("same", early, early + " ") + shot + screenshot(folder, "b.exr");
    script += copyShaders("black", early, early + "    if (gl_GlobalInvocationID.x < 100000u) return;\n") +
              "restart\n" + shot + screenshot(folder, "c.exr");
    script += copyShaders("broken", early, early + "    nonsense;\n") + shot + screenshot(folder, "d.exr") + "quit\n";
    const Outcome outcome = runScript(folder, script);
    INFO(outcome.errors << outcome.output);
    REQUIRE(outcome.exitCode == 0);
    const std::vector<std::string> messages = linesOf(outcome.output, "message ");
    REQUIRE(messages.size() == 3);
    CHECK(messages[0] == "message ''");
    CHECK(messages[1] == "message ''");
    CHECK_THAT(messages[2], containing("shaders are as before: RelaxAtrousDiffuse"));
    CHECK_THAT(outcome.output, containing("nonsense"));
    const auto meanOf = [&](const char* name)
    {
        double sum = 0.0;
        for (float x : sample::readImage(folder / name).rgba) sum += double(x);
        return sum;
    };
    CHECK(meanOf("b.exr") > 0.5 * meanOf("a.exr"));
    CHECK(meanOf("c.exr") < 0.5 * meanOf("a.exr")); // its last pass writes nothing
    CHECK(meanOf("d.exr") < 0.5 * meanOf("a.exr"));
}

TEST_CASE("a test recorded in the window runs headless", "[program]")
{
    if (!hasDisplay()) return;
    const test::TemporaryFolder folder;
    const std::string tests = (folder / "tests").string();
    const Outcome recorded =
        runScript(folder, "denoiser RELAX_DIFFUSE_SPECULAR\nset diffuseMaxAccumulatedFrameNum=20\nconfidence on\n"
                          "frames 2\ntest " +
                              tests + "\nturn 5,0\nframes 3\nturn 5,0\nframes 2\ntest off\nquit\n");
    INFO(recorded.errors << recorded.output);
    REQUIRE(recorded.exitCode == 0);
    CHECK(sample::Capture::open(folder / "tests/001/capture").info().frames.size() == 5);
    const auto before = sample::Capture::open(folder / "tests/001/capture").info();
    const Outcome run = test::runProgram(NRD_SAMPLE, "--tests " + tests);
    INFO(run.errors << run.output);
    REQUIRE(run.exitCode == 0);
    CHECK_THAT(run.output, containing("001: RELAX_DIFFUSE_SPECULAR"));
    const auto after = sample::Capture::open(folder / "tests/001/capture").info();
    REQUIRE(after.frames.size() == 5);
    for (size_t i = 0; i < 16; ++i)
        CHECK(after.frames[4].worldToView[i] == Approx(before.frames[4].worldToView[i]).margin(1e-4));
    CHECK(std::filesystem::exists(folder / "tests/001/report.json"));
}

TEST_CASE("the window switches through all denoisers", "[program]")
{
    if (!hasDisplay()) return;
    const test::TemporaryFolder folder;
    std::string script = "lobes both\n";
    for (const sample::SampleDenoiser& row : switchedThrough())
        script +=
            std::string("denoiser ") + row.name + "\nframes 1\n" + screenshot(folder, row.name + std::string(".png"));
    const Outcome outcome = runScript(folder, script, "--scene panes");
    INFO(outcome.errors);
    REQUIRE(outcome.exitCode == 0);
    for (const sample::SampleDenoiser& row : switchedThrough())
        CHECK(std::filesystem::exists(folder / (row.name + std::string(".png"))));
}

TEST_CASE("all recorded scenes are shown in the window, and an environment that is dropped", "[program]")
{
    const std::filesystem::path scenes = std::filesystem::path(NRD_TEST_DATA) / "scenes";
    if (!std::filesystem::exists(scenes)) return void(std::printf("SKIPPED: %s does not exist\n", scenes.c_str()));
    if (!hasDisplay()) return;
    const test::TemporaryFolder folder;
    std::string script;
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(scenes))
    {
        const bool isScene = entry.path().extension() == ".glb";
        if (!isScene && entry.path().extension() != ".hdr") continue;
        names.push_back(entry.path().stem().string() + ".png");
        script +=
            (isScene ? "scene " : "drop ") + entry.path().string() + "\nframes 1\n" + screenshot(folder, names.back());
    }
    const Outcome outcome = runScript(folder, script);
    INFO(outcome.errors);
    REQUIRE(outcome.exitCode == 0);
    for (const std::string& name : names) CHECK(std::filesystem::file_size(folder / name) > 500);
}

TEST_CASE("what a script gets wrong ends the program with its line", "[program]")
{
    if (!hasDisplay()) return;
    const test::TemporaryFolder folder;
    for (const auto& [script, part] :
         {std::pair("frames 1\nfly away\n", "script.txt:2: "),
          std::pair("frames 1\n\nscene /nowhere.glb\nframes 1\n", "/nowhere.glb"),
          std::pair("frames 1\ndenoiser NOTHING\n", "script.txt:2: "), std::pair("drop x.txt\n", "x.txt")})
    {
        const Outcome outcome = runScript(folder, script);
        INFO(script << outcome.errors);
        CHECK(outcome.exitCode == 1);
        CHECK_THAT(outcome.errors, containing("error: ") && containing(part));
    }
}

TEST_CASE("without a display the window is refused with a sentence", "[program]")
{
    if (!NRD_HAS_WINDOW) return;
    const Outcome outcome = test::runProgram("env", "-u DISPLAY -u WAYLAND_DISPLAY " NRD_SAMPLE);
    CHECK(outcome.exitCode == 1);
    CHECK_THAT(outcome.errors, containing("cannot open a window") && containing("--headless"));
}
