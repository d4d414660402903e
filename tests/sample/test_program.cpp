// nrd-sample as a user runs it, validation on.
#include "capture.h"
#include "catch.h"
#include "gltf_builder.h"
#include "program.h"
#include "sample_denoisers.h"

#include <algorithm>
#include <cstdio>
#include <fstream>

using sample::Channel;
using test::Outcome;
using test::readText;
using test::run;
using test::runProgram;

namespace
{
// One line that starts with "error: " and names `part`, exit code 1.
void checkRefused(const Outcome& outcome, const std::string& part)
{
    CHECK(outcome.exitCode == 1);
    CHECK(outcome.errors.rfind("error: ", 0) == 0);
    CHECK(std::count(outcome.errors.begin(), outcome.errors.end(), '\n') == 1);
    CHECK_THAT(outcome.errors, containing(part));
}
} // namespace

TEST_CASE("the default scene renders, denoises, compares and records", "[program]")
{
    const test::TemporaryFolder folder;
    const Outcome outcome =
        run("--headless --validation --size 96x54 --frames 10 --reference-spp 16 --reference-frames 8,9"
            " --demo " +
            (folder / "demo").string() + " --capture " + (folder / "capture").string() + " --screenshot " +
            (folder / "last.exr").string() + " --noisy-screenshot " + (folder / "noisy.png").string() +
            " --reference-screenshot " + (folder / "ref.png").string());
    INFO(outcome.errors);
    REQUIRE(outcome.exitCode == 0);
    CHECK_THAT(outcome.output, containing("built-in Cornell box"));
    for (const char* name : {"psnr", "ssim", "flip", "relMSE", "flicker", "bias"})
        CHECK_THAT(outcome.output, containing(name));
    for (const char* name : {"demo/noisy.png", "demo/denoised.png", "demo/reference.png", "demo/side-by-side.png",
                             "last.exr", "noisy.png", "ref.png"})
    {
        INFO(name);
        CHECK(std::filesystem::file_size(folder / name) > 500);
    }
    const sample::Capture capture = sample::Capture::open(folder / "capture");
    REQUIRE(capture.info().frames.size() == 10);
    CHECK(capture.info().frames[0].isCut);
    CHECK_FALSE(capture.info().frames[1].isCut);
    CHECK(capture.info().frames[7].reference.empty());
    CHECK_FALSE(capture.info().frames[9].reference.empty());
    CHECK(capture.info().frames[1].worldToView != capture.info().frames[9].worldToView);
    CHECK(capture.readFrame(9).has(sample::Channel::SpecularDX));
    CHECK(capture.readReference(9).has(sample::Channel::RefSpecularNormHitDist));
}

TEST_CASE("every denoiser choice runs", "[program]")
{
    for (const sample::SampleDenoiser& row : sample::sampleDenoisers())
    {
        const char* name = row.name;
        const test::TemporaryFolder folder;
        const Outcome outcome =
            run("--headless --validation --size 33x17 --frames 4 --jitter --denoiser " + std::string(name) +
                (row.isOfShadow() ? " --scene panes" : "") + " --screenshot " + (folder / "a.png").string());
        INFO(name << ": " << outcome.errors);
        CHECK(outcome.exitCode == 0);
        CHECK(std::filesystem::exists(folder / "a.png"));
    }
}

TEST_CASE("several denoisers run on the same input, and each gives what it gives alone", "[program]")
{
    const test::TemporaryFolder folder;
    const std::string common = "--headless --validation --size 48x32 --frames 12 --denoiser ";
    const auto picture = [&](const std::string& name, const std::string& options)
    {
        const std::string file = (folder / (name + ".exr")).string();
        const Outcome outcome = run(common + options + " --screenshot " + file);
        INFO(outcome.errors);
        CHECK(outcome.exitCode == 0);
        return readText(file);
    };
    const std::string reblur = picture("reblur", "REBLUR_DIFFUSE_SPECULAR");
    const std::string relax = picture("relax", "RELAX_DIFFUSE_SPECULAR");
    CHECK(reblur != relax);
    const std::string both = "REBLUR_DIFFUSE_SPECULAR,RELAX_DIFFUSE_SPECULAR";
    CHECK(picture("first", both) == reblur);
    // Shown from frame 11 on, with the history of the frames in which the other was.
    CHECK(picture("switched", both + " --switch-every 11") == relax);
    CHECK(picture("back", both + " --switch-every 5") == reblur);
    const Outcome outcome = run(common + both + " --switch-every 6");
    CHECK_THAT(outcome.output, containing("frame 0: REBLUR_DIFFUSE_SPECULAR\nframe 6: RELAX_DIFFUSE_SPECULAR\n"));
    CHECK_THAT(outcome.output, containing("denoised 2 times. Memory in MiB: REBLUR_DIFFUSE_SPECULAR "));
}

TEST_CASE("the demo has a picture and a column of each denoiser", "[program]")
{
    const test::TemporaryFolder folder;
    const Outcome outcome = run("--validation --size 64x36 --frames 9 --reference-spp 16 --reference-frames 7,8 "
                                "--denoiser REBLUR_DIFFUSE,RELAX_DIFFUSE_SPECULAR --demo " +
                                (folder / "demo").string());
    INFO(outcome.errors);
    REQUIRE(outcome.exitCode == 0);
    for (const char* name : {"noisy.png", "denoised-REBLUR_DIFFUSE.png", "denoised-RELAX_DIFFUSE_SPECULAR.png",
                             "reference.png", "side-by-side.png"})
        CHECK(std::filesystem::exists(folder / "demo" / name));
    double noisy = 0.0, reblur = 0.0, relax = 0.0;
    const char* row = std::strstr(outcome.output.c_str(), "psnr ");
    REQUIRE(row);
    REQUIRE(std::sscanf(row, "psnr %lf %lf %lf", &noisy, &reblur, &relax) == 3);
    CHECK((reblur > noisy && relax > noisy && reblur != relax));
}

TEST_CASE("auto says what it takes, and leaves out what the scene doesn't need", "[program]")
{
    const std::string common = "--headless --validation --size 32x18 --frames 2 ";
    CHECK_THAT(run(common).output, containing("auto: REBLUR_DIFFUSE_SPECULAR: there are metals\nauto: no SIGMA"));
    const test::TemporaryFolder folder;
    test::GltfFile file = test::makeTriangle(); // without a material: glTF's default is a metal
    file.json["materials"] = {{{"pbrMetallicRoughness", {{"metallicFactor", 0.0}, {"roughnessFactor", 1.0}}}}};
    file.json["meshes"][0]["primitives"][0]["material"] = 0;
    file.writeBinary(folder / "rough.glb");
    const Outcome outcome = run(common + (folder / "rough.glb").string() + " --denoiser auto");
    CHECK(outcome.exitCode == 0);
    CHECK_THAT(outcome.output, containing("auto: REBLUR_DIFFUSE: no surface is metal or smoother than 0.9"));
    CHECK_THAT(run(common + "--lobes merged").output, containing("auto: REBLUR_DIFFUSE: the lobes are asked for"));
    CHECK(run(common + "--denoiser RELAX_DIFFUSE --lobes merged").exitCode == 0);
}

TEST_CASE("one lobe per pixel is denoised", "[program]")
{
    for (const char* option : {"--lobes probabilistic", "--checkerboard black", "--checkerboard white"})
        for (const char* denoiser :
             {"REBLUR_DIFFUSE_SPECULAR", "REBLUR_DIFFUSE_SPECULAR_SH", "RELAX_DIFFUSE_SPECULAR_SH"})
        {
            const std::string arguments = std::string(option) + " --denoiser " + denoiser;
            const Outcome outcome = run("--headless --validation --size 33x17 --frames 4 " + arguments);
            INFO(arguments << ": " << outcome.errors);
            CHECK(outcome.exitCode == 0);
        }
}

TEST_CASE("half and third resolution are denoised in every form of the signals, captured whole", "[program]")
{
    for (const char* option : {"--divisor 2", "--divisor 2 --sparse", "--divisor 3 --sparse --confidence"})
        for (const char* denoiser :
             {"REBLUR_DIFFUSE_SPECULAR_SH+SIGMA_SHADOW_TRANSLUCENCY", "RELAX_DIFFUSE_SPECULAR_SH+SIGMA_SHADOW",
              "REBLUR_DIFFUSE_DIRECTIONAL_OCCLUSION", "REBLUR_DIFFUSE --lobes merged", "RELAX_SPECULAR,REFERENCE"})
        {
            const test::TemporaryFolder folder;
            const std::string arguments = std::string(option) + " --denoiser " + denoiser;
            const Outcome outcome = run("--headless --validation --scene panes --size 33x17 --frames 3 " + arguments +
                                        " --capture " + (folder / "capture").string());
            INFO(arguments << ": " << outcome.errors);
            REQUIRE(outcome.exitCode == 0);
            const sample::Planes planes = sample::Capture::open(folder / "capture").readFrame(2);
            size_t withoutPath = 0;
            for (size_t i = 0; i < planes.pixelCount(); ++i)
                withoutPath += planes[Channel::ViewZ][i] > -1000.0f && planes[Channel::DiffuseHitDist][i] == 0.0f &&
                               planes[Channel::SpecularHitDist][i] == 0.0f;
            CHECK(withoutPath == 0);
        }
}

TEST_CASE("resolved SH brings normal-mapped relief back", "[program]")
{
    // Of the denoised picture against its reference.
    struct Errors
    {
        double ssim = 0.0;
        double flip = 0.0;
    };
    const auto measure = [](const std::string& denoiser)
    {
        const test::TemporaryFolder folder;
        const Outcome outcome = run("--scene bumps --size 240x135 --frames 20 --reference-spp 96 --reference-frames 19"
                                    " --denoiser " +
                                    denoiser + " --demo " + (folder / "demo").string());
        REQUIRE(outcome.exitCode == 0);
        Errors errors;
        double noisy = 0.0;
        const char* text = outcome.output.c_str();
        REQUIRE(std::sscanf(std::strstr(text, "ssim "), "ssim %lf %lf", &noisy, &errors.ssim) == 2);
        REQUIRE(std::sscanf(std::strstr(text, "flip "), "flip %lf %lf", &noisy, &errors.flip) == 2);
        return errors;
    };
    const Errors plain = measure("REBLUR_DIFFUSE_SPECULAR"), sh = measure("REBLUR_DIFFUSE_SPECULAR_SH");
    CHECK(sh.flip < 0.95 * plain.flip);
    CHECK(1.0 - sh.ssim < 0.6 * (1.0 - plain.ssim));
}

TEST_CASE("--set changes the picture", "[program]")
{
    const test::TemporaryFolder folder;
    const auto picture = [&](const std::string& name, const std::string& options)
    {
        const std::string file = (folder / (name + ".exr")).string();
        CHECK(run("--headless --scene bumps --size 40x24 --frames 3 --screenshot " + file + options).exitCode == 0);
        return readText(file);
    };
    const std::string plain = picture("plain", "");
    CHECK(picture("same", " --set maxBlurRadius=30") == plain);
    CHECK(picture("reblur", " --set maxBlurRadius=2") != plain);
    CHECK(picture("common", " --set splitScreen=1") != plain);
}

TEST_CASE("a run can be repeated to the last bit", "[program]")
{
    const test::TemporaryFolder folder;
    std::string pictures[3];
    for (int i = 0; i < 3; ++i)
    {
        const std::string file = (folder / std::to_string(i)).string() + ".exr";
        CHECK(run("--headless --size 40x24 --frames 3 --screenshot " + file + (i == 2 ? " --seed 5" : "")).exitCode ==
              0);
        pictures[i] = readText(file);
    }
    CHECK(pictures[0] == pictures[1]);
    CHECK(pictures[0] != pictures[2]);
}

TEST_CASE("bad arguments and broken files end in one sentence and exit code 1", "[program]")
{
    const test::TemporaryFolder folder;
    std::ofstream(folder / "broken.glb") << "glTF but not really";
    std::ofstream(folder / "broken.hdr") << "#?RADIANCE\n";
    test::makeTriangle().writeBinary(folder / "triangle.glb");
    const std::string triangle = (folder / "triangle.glb").string();
    checkRefused(run("--headless " + (folder / "broken.glb").string()), "broken.glb");
    checkRefused(run("--headless " + (folder / "absent.glb").string()), "absent.glb");
    checkRefused(run("--headless " + triangle + " --environment " + (folder / "broken.hdr").string()), "broken.hdr");
    checkRefused(run("--headless --size 12"), "--size");
    checkRefused(run("--headless --denoiser MAGIC"), "--denoiser");
    checkRefused(run("--headless --denoiser RELAX"), "REBLUR_DIFFUSE_SH");
    checkRefused(run("--headless --lobes one"), "probabilistic");
    checkRefused(run("--headless --checkerboard red"), "white");
    checkRefused(run("--headless --checkerboard black --lobes probabilistic"), "--checkerboard");
    checkRefused(run("--headless --divisor 2 --checkerboard black"), "--checkerboard");
    checkRefused(run("--headless --divisor 2 --sparse --lobes probabilistic"), "probabilistic");
    checkRefused(run("--headless --divisor 2 --denoiser REFERENCE"), "REBLUR");
    checkRefused(run("--headless --sparse"), "--divisor");
    checkRefused(run("--headless --scene rome"), "bumps");
    checkRefused(run("--headless --scene bumps " + triangle), "--scene");
    checkRefused(run("--headless --set maxBlurRadius"), "key=value");
    checkRefused(run("--headless --set maxBlurRadius=wide"), "maxBlurRadius");
    checkRefused(run("--headless --set noSuchSetting=1"), "noSuchSetting");
    checkRefused(run("--headless --set checkerboardMode=BLACK"), "--checkerboard");
    checkRefused(run("--headless --set maxBlurRadius=1 --denoiser NONE"), "--set");
    checkRefused(run("--headless --size 16x16 --frames 1 --set maxBlurRadius=-1"), "maxBlurRadius");
    checkRefused(run("--demo out --denoiser REBLUR_DIFFUSE_OCCLUSION"), "--demo");
    checkRefused(run("--headless --frames 0"), "--frames");
    checkRefused(run("--headless --denoiser RELAX_DIFFUSE,RELAX_DIFFUSE"), "twice");
    checkRefused(run("--headless --denoiser RELAX_DIFFUSE+REBLUR_SPECULAR"), "same picture");
    checkRefused(run("--headless --denoiser RELAX_DIFFUSE --switch-every 4"), "--switch-every");
    checkRefused(run("--headless --denoiser RELAX_DIFFUSE,NONE --switch-every 0"), "--switch-every");
    checkRefused(run("--headless --denoiser RELAX_DIFFUSE_SPECULAR --lobes merged"), "--lobes merged");
    checkRefused(run("--headless --checkerboard black --lobes merged"), "--checkerboard");
    checkRefused(run("--headless --sun-radius 90"), "--sun-radius");
    checkRefused(run("--headless --shadow-signal"), "neither a sun nor a spot");
    checkRefused(run("--demo out --denoiser RELAX_DIFFUSE,NONE"), "NONE denoises no radiance");
    checkRefused(run("--headless --screenshot a.jpg"), "a.jpg");
    checkRefused(run("--headless --reference-frames every-1"), "every-K");
    checkRefused(run("--headless --unknown"), "--unknown");
    checkRefused(run("--headless --device 99"), "99");
    checkRefused(run("--headless --size 16x16 --frames 1 --screenshot " + (folder / "no/such/folder.png").string()),
                 "folder.png");
    checkRefused(run(triangle), "--headless");
}

TEST_CASE("help, version and the list of devices need no scene", "[program]")
{
    CHECK_THAT(run("--help").output, containing("--reference-spp"));
    CHECK_THAT(run("--version").output, containing("nrd-sample 0."));
    const Outcome list = run("--list-devices");
    CHECK(list.exitCode == 0);
    CHECK_THAT(list.output, containing("0: "));
}

TEST_CASE("a scene without light and camera gets both, and the program says so", "[program]")
{
    const test::TemporaryFolder folder;
    test::makeTriangle().writeBinary(folder / "triangle.glb");
    const Outcome outcome =
        run("--headless --validation --size 32x32 --frames 2 " + (folder / "triangle.glb").string());
    INFO(outcome.errors);
    CHECK(outcome.exitCode == 0);
    CHECK_THAT(outcome.output, containing("no light"));
    CHECK_THAT(outcome.output, containing("no camera"));
}

TEST_CASE("real scenes and a real environment render", "[program]")
{
    const std::filesystem::path scenes = std::filesystem::path(NRD_TEST_DATA) / "scenes";
    if (!std::filesystem::exists(scenes))
    {
        std::printf("SKIPPED: %s does not exist\n", scenes.c_str());
        return;
    }
    size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(scenes))
    {
        if (entry.path().extension() != ".glb") continue;
        for (const std::string& environment :
             std::vector<std::string>{"", " --environment " + (scenes / "spruit_sunrise_1k.hdr").string()})
        {
            const Outcome outcome =
                run("--headless --validation --size 64x48 --frames 3 " + entry.path().string() + environment);
            INFO(entry.path() << environment << ": " << outcome.errors);
            CHECK(outcome.exitCode == 0);
            ++count;
        }
    }
    CHECK(count >= 2);
}

TEST_CASE("the example of native handles denoises", "[program]")
{
    // The layer's own report goes to stdout.
    const std::string layers = "VK_INSTANCE_LAYERS=VK_LAYER_KHRONOS_validation "
                               "VK_LAYER_ENABLES=VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT ";
    const Outcome outcome = runProgram(layers + NRD_EXAMPLE, "");
    INFO(outcome.errors << outcome.output);
    CHECK(outcome.exitCode == 0);
    CHECK(outcome.output.find("Validation Error") == std::string::npos);
    CHECK(outcome.output.find("SYNC-HAZARD") == std::string::npos);
    CHECK_THAT(outcome.output, containing("denoised"));
}
