#include "catch.h"
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

using nlohmann::json;
namespace fs = std::filesystem;

namespace
{
constexpr const char* kDenoisers[] = {"REBLUR_DIFFUSE_SPECULAR", "REBLUR_DIFFUSE", "REBLUR_SPECULAR"};
constexpr const char* kSequences[] = {"cornell-pan", "roughness-ladder", "sun-shadow", "sun-shadow-soft", "ao-room"};

json readJson(const fs::path& path)
{
    std::ifstream file(path);
    REQUIRE(file.good());
    return json::parse(file);
}

// Null where the peer was not measured.
json findPeer(const json& rows, const std::string& capture, const std::string& denoiser)
{
    for (const json& row : rows)
        if (row["capture"] == capture && row["denoiser"] == denoiser) return row["mean"]["denoised"];
    return {};
}

// Four lines of one report: noisy, denoised, peer.
void printFigures(const std::string& name, const json& mean, const json& peer)
{
    for (const char* measure : {"psnr", "flip", "relMSE", "flicker"})
    {
        std::printf("FIGURE %s %s: %.4f noisy, %.4f denoised, %.4f peer\n", name.c_str(), measure,
                    mean["noisy"]["composed"][measure].get<double>(),
                    mean["denoised"]["composed"][measure].get<double>(), peer["composed"][measure].get<double>());
    }
    if (!peer.contains("normHitDist")) return;
    std::printf("FIGURE %s hit distance RMSE: %.4f noisy, %.4f denoised, %.4f peer\n", name.c_str(),
                mean["noisy"]["normHitDist"]["rmse"].get<double>(),
                mean["denoised"]["normHitDist"]["rmse"].get<double>(), peer["normHitDist"]["rmse"].get<double>());
}

void checkSequence(const std::string& name, const std::string& denoiser, const json& peer)
{
    const fs::path report = fs::path(NRD_OUTPUT) / (denoiser + "-" + name + ".json");
    const std::string command = std::string("\"") + NRD_REPLAY + "\" \"" + NRD_SEQUENCES + "/" + name +
                                "\" --denoiser " + denoiser + " --validation --report \"" + report.string() +
                                "\" > \"" + report.string() + ".log\" 2>&1";
    REQUIRE(std::system(command.c_str()) == 0);
    const json mean = readJson(report)["mean"];
    const json &noisy = mean["noisy"]["composed"], &denoised = mean["denoised"]["composed"];
    printFigures(denoiser + " " + name, mean, peer);
    CHECK(denoised["psnr"].get<double>() > noisy["psnr"].get<double>());
    CHECK(denoised["relMSE"].get<double>() < noisy["relMSE"].get<double>());
    CHECK(denoised["flicker"].get<double>() < noisy["flicker"].get<double>());
    // Not behind the peer in anything; flicker is recorded to three digits.
    CHECK(denoised["psnr"].get<double>() >= peer["composed"]["psnr"].get<double>());
    CHECK(denoised["flip"].get<double>() <= peer["composed"]["flip"].get<double>());
    CHECK(denoised["relMSE"].get<double>() <= peer["composed"]["relMSE"].get<double>());
    CHECK(denoised["flicker"].get<double>() <= 1.01 * peer["composed"]["flicker"].get<double>());
    if (!peer.contains("normHitDist")) return;
    CHECK(mean["denoised"]["normHitDist"]["rmse"].get<double>() <= peer["normHitDist"]["rmse"].get<double>());
}
} // namespace

TEST_CASE("the recorded sequences are denoised at least as well as by the peer", "[golden]")
{
    const fs::path peerFile = fs::path(NRD_TEST_DATA) / "peer" / "nrd-4.17.4-sequences.json";
    int count = 0;
    for (const char* name : kSequences)
    {
        if (!fs::exists(peerFile) || !fs::exists(fs::path(NRD_SEQUENCES) / name / "capture.json")) continue;
        for (const char* denoiser : kDenoisers)
        {
            const json peer = findPeer(readJson(peerFile), name, denoiser);
            if (peer.is_null()) continue;
            INFO(denoiser << " on " << name);
            checkSequence(name, denoiser, peer);
            count++;
        }
    }
    if (count == 0) std::printf("SKIPPED errors on the recorded sequences: they are not here\n");
}
