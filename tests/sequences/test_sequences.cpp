// Every denoiser on the recorded sequences against the peer's recorded figures.
//
// A replay of 64 frames of 320x180 takes 5 to 14 seconds of one core on lavapipe, so two run at a time.
#include "catch.h"
#include "long_form.h"

#include <nrd/nrd.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <future>
#include <nlohmann/json.hpp>
#include <string>

using nlohmann::json;
namespace fs = std::filesystem;

namespace
{
constexpr size_t kConcurrentReplays = 2;

// What must be better than in the noisy input, not behind the peer, or both. The slack of a measure is a factor.
struct Limit
{
    const char* signal;
    const char* measure;
    bool isHigherBetter;
    bool isHeldAgainstNoisy;
    bool isHeldAgainstPeer;
    double slack;
};
constexpr Limit kLimits[] = {
    {"composed", "psnr", true, true, true, 1.0},
    {"composed", "flip", false, false, true, 1.0}, // charges blur too: where there is little noise it may rise
    {"composed", "relMSE", false, true, true, 1.0},
    {"composed", "flicker", false, true, true, 1.01}, // recorded to three digits
    {"normHitDist", "rmse", false, true, true, 1.0},
    {"normHitDist", "flicker", false, true, true, 1.0},
    {"shadow", "rmse", false, true, true, 0.9},
    {"shadow", "flicker", false, true, true, 1.0},
    {"translucency", "rmse", false, true, true, 0.9},
};

// Rows known to fall short of the peer, by how much, and why.
struct Shortfall
{
    const char* denoiser;
    const char* capture;
    const char* signal;
    const char* measure;
    double slack;
};
constexpr Shortfall kShortfalls[] = {
    // No pre-pass, whose radius followed the noise and took 3 % of the mean; the error is less than half the peer's.
    {"REBLUR_DIFFUSE_DIRECTIONAL_OCCLUSION", "cornell-pan", "normHitDist", "flicker", 1.07},
};

struct Row
{
    std::string capture;
    std::string denoiser;
    json peer; // means; empty where the peer has no figure
    int exitCode = -1;

    fs::path report() const { return fs::path(NRD_OUTPUT) / (denoiser + "-" + capture + ".json"); }
};

json readJson(const fs::path& path)
{
    std::ifstream file(path);
    REQUIRE(file.good());
    return json::parse(file);
}

bool isSupported(const std::string& denoiser)
{
    const nrd::LibraryDesc& library = nrd::GetLibraryDesc();
    const nrd::Denoiser* last = library.supportedDenoisers + library.supportedDenoisersNum;
    return std::any_of(library.supportedDenoisers, last, [&](nrd::Denoiser d) { return nrd::toString(d) == denoiser; });
}

bool isMoving(const Row& row) { return row.capture == "cornell-pan" || row.capture == "roughness-ladder"; }

// Denoisers of both lobes run the code of those of one, and the moving sequences ask more than the still ones. The
// short form has the denoisers of both lobes on those and on one still one, and every kind of signal on one of them.
bool isInForm(const Row& row)
{
    if (test::isLong()) return true;
    const bool isMain = row.denoiser.ends_with("DIFFUSE_SPECULAR") || row.denoiser.starts_with("SIGMA");
    if (test::isMiddle()) return isMain || isMoving(row);
    if (isMain && (isMoving(row) || row.capture == "sun-shadow")) return true;
    const bool isOfBoth = row.denoiser.find("DIFFUSE_SPECULAR") != std::string::npos;
    return row.capture == "roughness-ladder" && (isOfBoth || row.denoiser.ends_with("DIRECTIONAL_OCCLUSION"));
}

// The peer's rows that the library supports and whose sequence is here. A row without figures, which is specular
// occlusion where the references have none, would say nothing.
std::vector<Row> findRows()
{
    std::vector<Row> rows;
    const fs::path peerFile = fs::path(NRD_TEST_DATA) / "peer" / "nrd-4.17.4-sequences.json";
    if (!fs::exists(peerFile)) return rows;
    for (const json& entry : readJson(peerFile))
    {
        const Row row = {entry["capture"], entry["denoiser"], entry["mean"]["denoised"]};
        const bool isHere = fs::exists(fs::path(NRD_SEQUENCES) / row.capture / "capture.json");
        const bool isOfFamily = row.denoiser != "REFERENCE"; // which does not denoise
        if (!isInForm(row)) continue;
        if (isHere && isOfFamily && !row.peer.empty() && isSupported(row.denoiser)) rows.push_back(row);
    }
    return rows;
}

void replay(Row& row)
{
    const std::string report = row.report().string();
    const std::string command = std::string("\"") + NRD_REPLAY + "\" \"" + NRD_SEQUENCES + "/" + row.capture +
                                "\" --denoiser " + row.denoiser + " --validation --report \"" + report + "\" > \"" +
                                report + ".log\" 2>&1";
    row.exitCode = std::system(command.c_str());
}

void replayAll(std::vector<Row>& rows)
{
    std::atomic<size_t> next = 0;
    const auto work = [&]
    {
        for (size_t i = next++; i < rows.size(); i = next++) replay(rows[i]);
    };
    std::vector<std::future<void>> workers;
    for (size_t i = 0; i < kConcurrentReplays; i++) workers.push_back(std::async(std::launch::async, work));
    for (std::future<void>& worker : workers) worker.get();
}

double figureOf(const json& means, const Limit& limit) { return means[limit.signal][limit.measure].get<double>(); }

double slackOf(const Row& row, const Limit& limit)
{
    for (const Shortfall& s : kShortfalls)
    {
        const bool isOfRow = row.denoiser == s.denoiser && row.capture == s.capture;
        if (isOfRow && std::string(limit.signal) == s.signal && std::string(limit.measure) == s.measure) return s.slack;
    }
    return limit.slack;
}

void checkLimit(const Row& row, const json& mean, const Limit& limit)
{
    if (!row.peer.contains(limit.signal) || !row.peer[limit.signal].contains(limit.measure)) return;
    const double noisy = figureOf(mean["noisy"], limit), denoised = figureOf(mean["denoised"], limit);
    const double peer = figureOf(row.peer, limit);
    std::printf("FIGURE %s %s %s %s: %.4f noisy, %.4f denoised, ", row.denoiser.c_str(), row.capture.c_str(),
                limit.signal, limit.measure, noisy, denoised);
    if (mean.contains("extracted")) std::printf("%.4f extracted, ", figureOf(mean["extracted"], limit));
    std::printf("%.4f peer\n", peer);
    INFO(row.denoiser << " on " << row.capture << ": " << limit.signal << " " << limit.measure);
    const double sign = limit.isHigherBetter ? -1.0 : 1.0;
    if (limit.isHeldAgainstNoisy) CHECK(sign * denoised < sign * noisy);
    if (limit.isHeldAgainstPeer) CHECK(sign * denoised <= sign * peer * slackOf(row, limit));
}

void checkRow(const Row& row)
{
    INFO(row.denoiser << " on " << row.capture << ", see " << row.report().string() << ".log");
    REQUIRE(row.exitCode == 0);
    const json mean = readJson(row.report())["mean"];
    for (const Limit& limit : kLimits) checkLimit(row, mean, limit);
}

int runQuietly(const std::string& command) { return std::system((command + " > /dev/null 2>&1").c_str()); }
} // namespace

TEST_CASE("the recorded sequences are denoised at least as well as by the peer", "[golden]")
{
    std::vector<Row> rows = findRows();
    if (rows.empty()) std::printf("SKIPPED errors on the recorded sequences: they are not here\n");
    replayAll(rows);
    for (const Row& row : rows) checkRow(row);
}

// No recorded sequence holds it, so the sample records one.
TEST_CASE("specular occlusion keeps a third of the noise's error at most, whatever comes with it", "[golden]")
{
    const std::string capture = (fs::path(NRD_OUTPUT) / "specular-occlusion").string();
    fs::remove_all(capture);
    REQUIRE(runQuietly(std::string("\"") + NRD_SAMPLE + "\" --headless --denoiser NONE --jitter --size 128x72 " +
                       "--frames 24 --reference-spp 256 --reference-frames 22,23 --capture \"" + capture + "\"") == 0);
    for (const char* denoiser : {"REBLUR_SPECULAR_OCCLUSION", "REBLUR_DIFFUSE_SPECULAR_OCCLUSION", "REBLUR_SPECULAR"})
    {
        INFO(denoiser);
        const std::string report = capture + "-" + denoiser + ".json";
        REQUIRE(runQuietly(std::string("\"") + NRD_REPLAY + "\" \"" + capture + "\" --validation --denoiser " +
                           denoiser + " --report \"" + report + "\"") == 0);
        const json mean = readJson(report)["mean"];
        for (const char* measure : {"rmse", "flicker"})
        {
            const double noisy = mean["noisy"]["specularNormHitDist"][measure].get<double>();
            const double denoised = mean["denoised"]["specularNormHitDist"][measure].get<double>();
            std::printf("FIGURE %s specular hit distance %s: %.4f noisy, %.4f denoised\n", denoiser, measure, noisy,
                        denoised);
            CHECK(denoised < noisy / 3.0);
        }
    }
}
