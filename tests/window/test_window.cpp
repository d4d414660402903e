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
