// The program itself, on tiny pictures, with the validation layers on.
#include "outcome.h"

#include <nrd/nrd.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>

namespace
{
using test::Outcome;

Outcome run(const std::string& arguments, const char* redirection = "2>&1")
{
    return test::runCommand(std::string(NRD_BENCH) + " " + arguments + " " + redirection);
}

struct File
{
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("nrd-test-bench-" + std::to_string(std::random_device()()) + ".json");
    ~File()
    {
        std::error_code error;
        std::filesystem::remove(path, error);
    }
};

void checkRow(const nlohmann::json& row)
{
    INFO(row.dump());
    CHECK(row["resolution"] == nlohmann::json({64, 36}));
    CHECK(row["memoryMiB"]["total"].get<double>() ==
          Approx(row["memoryMiB"]["permanent"].get<double>() + row["memoryMiB"]["transient"].get<double>()));
    CHECK(row["cpuUs"]["emit"].get<double>() > 0.0);
    CHECK(row["createMs"].get<double>() > 0.0);
    CHECK(row["cpuUs"]["record"].get<double>() > row["cpuUs"]["emit"].get<double>());
    CHECK(row["copyGBPerSecond"].get<double>() > 0.0);
    CHECK(row["gpuMs"]["p10"].get<double>() <= row["gpuMs"]["total"].get<double>());
    CHECK(row["gpuMs"]["p90"].get<double>() >= row["gpuMs"]["total"].get<double>());
    REQUIRE(row["gpuMs"]["passes"].size() >= 2);
    for (const nlohmann::json& pass : row["gpuMs"]["passes"])
    {
        CHECK(pass["ms"].get<double>() > 0.0);
        CHECK(pass["floorMs"].get<double>() > 0.0);
    }
    if (row["denoiser"] == "REFERENCE") return; // reads no depth
    CHECK(row["input"]["skyPercent"].get<double>() > 1.0);
    CHECK(row["input"]["skyPercent"].get<double>() < 3.0);
}
} // namespace

TEST_CASE("every denoiser of the library is measured without a message of the validation layers", "[gpu]")
{
    File file;
    const Outcome outcome = run("--sizes 64x36 --frames 4 --validation --json " + file.path.string());
    INFO(outcome.text);
    REQUIRE(outcome.exitCode == 0);
    const nlohmann::json json = nlohmann::json::parse(std::ifstream(file.path));
    REQUIRE(json.size() == nrd::GetLibraryDesc().supportedDenoisersNum);
    for (const nlohmann::json& row : json) checkRow(row);
}

TEST_CASE("the expression selects, and a still camera and settings are passed on", "[gpu]")
{
    File file;
    const Outcome outcome = run("--denoisers 'REBLUR_(DIFFUSE|SPECULAR)' --sizes 32x32,48x20 --frames 2 --static "
                                "--sky 10 --set diffusePrepassBlurRadius=0 --json " +
                                file.path.string());
    INFO(outcome.text);
    REQUIRE(outcome.exitCode == 0);
    const nlohmann::json json = nlohmann::json::parse(std::ifstream(file.path));
    REQUIRE(json.size() == 4);
    CHECK(json[0]["denoiser"] == "REBLUR_DIFFUSE");
    CHECK(json[1]["resolution"] == nlohmann::json({48, 20}));
    CHECK(json[3]["denoiser"] == "REBLUR_SPECULAR");
    CHECK(json[0]["input"]["static"] == true);
    CHECK(json[0]["settings"]["diffusePrepassBlurRadius"] == "0");
    CHECK(json[0]["input"]["skyPercent"].get<double>() > 7.0);
    for (const nlohmann::json& pass : json[0]["gpuMs"]["passes"]) CHECK(pass["name"] != "Pre-pass");
}

TEST_CASE("memory alone is told at any size at once", "[gpu]")
{
    File file;
    const Outcome outcome = run("--memory --denoisers 'REBLUR.*' --sizes 2560x1440 --json " + file.path.string());
    INFO(outcome.text);
    REQUIRE(outcome.exitCode == 0);
    for (const nlohmann::json& row : nlohmann::json::parse(std::ifstream(file.path)))
    {
        INFO(row.dump());
        CHECK_FALSE(row.contains("gpuMs"));
        CHECK_FALSE(row.contains("cpuUs"));
        CHECK(row["bytesPerPixel"].get<double>() > 5.0);
        CHECK(row["bytesPerPixel"].get<double>() * 2560 * 1440 ==
              Approx(row["memoryMiB"]["total"].get<double>() * 1024 * 1024));
    }
}

TEST_CASE("bad options of the benchmark end in one sentence and exit code 1", "[gpu]")
{
    const std::pair<const char*, const char*> rows[] = {
        {"--bogus", "--bogus"},
        {"--denoisers FOO", "FOO"},
        {"--denoisers '('", "regular expression"},
        {"--sizes 64", "--sizes 64"},
        {"--sizes 0x36", "--sizes 0x36"},
        {"--frames 0", "--frames"},
        {"--sky 50", "--sky"},
        {"--set foo", "foo"},
        {"--memory --set foo=1", "foo"},
        {"--memory --denoisers 'REBLUR.*' --set splitScreen=x", "splitScreen"},
        {"--denoisers REBLUR_DIFFUSE --sizes 32x32 --set splitScreen=7", "splitScreen"},
        {"--memory --device none-such", "none-such"},
        {"--memory --peer /none.json", "/none.json"},
        {"--memory --json /none/none.json", "/none/none.json"},
    };
    for (const auto& [arguments, expected] : rows)
    {
        INFO(arguments);
        const Outcome outcome = run(arguments, "2>&1 >/dev/null");
        INFO(outcome.text);
        CHECK(outcome.exitCode == 1);
        CHECK_THAT(outcome.text, containing(expected));
        CHECK(std::count(outcome.text.begin(), outcome.text.end(), '\n') == 1);
    }
    CHECK(run("--help").exitCode == 0);
    CHECK_THAT(run("--version").text, containing("nrd-bench"));
    CHECK(run("--list-devices").exitCode == 0);
}
