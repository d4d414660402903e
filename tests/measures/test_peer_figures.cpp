// The noisy input of the recorded sequences has the figures that were recorded with them: our measures are the same.
#include "catch.h"

#include "sequence.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>

using namespace sample;
using Json = nlohmann::json;

namespace
{
struct Row
{
    const char* denoiser; // whose noisy figures
    std::vector<Signal> signals;
};

FrameMeasures measureNoisy(const std::filesystem::path& folder, const std::vector<Signal>& signals)
{
    const Capture capture = Capture::open(folder);
    SignalSet set = {};
    for (Signal signal : signals) set[static_cast<size_t>(signal)] = true;
    SequenceMeasurer measurer(capture.info(), set);
    for (size_t i = 0; i < capture.info().frames.size(); i++)
        if (!capture.info().frames[i].reference.empty())
            measurer.add(i, capture.readFrame(i), capture.readReference(i), nullptr);
    return measurer.meanNoisy();
}

// The first recorded row of a sequence and denoiser; null when there is none.
const Json* findRow(const Json& peer, const std::string& capture, const std::string& denoiser)
{
    for (const Json& row : peer)
        if (row["capture"] == capture && row["denoiser"] == denoiser) return &row;
    return nullptr;
}

int checkAgainst(const Json& recorded, const FrameMeasures& measured)
{
    int count = 0;
    for (size_t s = 0; s < kSignalCount; s++)
    {
        const char* name = signalInfo(static_cast<Signal>(s)).name;
        if (!recorded.contains(name)) continue;
        for (const MeasureInfo& measure : kMeasures)
        {
            if (!recorded[name].contains(measure.name)) continue;
            INFO(name << "." << measure.name);
            REQUIRE(measured[s].*measure.field);
            CHECK(*(measured[s].*measure.field) ==
                  Approx(recorded[name][measure.name].get<double>()).epsilon(3e-4).margin(2e-6));
            count++;
        }
    }
    return count;
}
} // namespace

TEST_CASE("the noisy sequences have the recorded figures", "[golden]")
{
    const std::filesystem::path sequences = std::getenv("NRD_SEQUENCES") ? std::getenv("NRD_SEQUENCES") : NRD_SEQUENCES;
    std::ifstream stream(std::filesystem::path(NRD_TEST_DATA) / "peer" / "nrd-4.17.4-sequences.json");
    const Row rows[] = {
        {"REBLUR_DIFFUSE_SPECULAR", {Signal::Diffuse, Signal::Specular, Signal::NormHitDist}},
        {"REBLUR_DIFFUSE", {Signal::Diffuse, Signal::NormHitDist}},
        {"SIGMA_SHADOW", {Signal::Shadow}},
        {"SIGMA_SHADOW_TRANSLUCENCY", {Signal::Shadow, Signal::Translucency}},
    };
    const char* const names[] = {"cornell-pan", "roughness-ladder", "sun-shadow", "sun-shadow-soft", "ao-room"};
    const Json peer = stream ? Json::parse(stream) : Json::array();
    int count = 0;
    for (const char* name : names)
    {
        const bool exists = std::filesystem::exists(sequences / name / "capture.json");
        if (!exists || peer.empty()) continue;
        for (const Row& row : rows)
        {
            const Json* recorded = findRow(peer, name, row.denoiser);
            if (!recorded) continue;
            INFO(name << ", " << row.denoiser);
            count += checkAgainst((*recorded)["mean"]["noisy"], measureNoisy(sequences / name, row.signals));
        }
    }
    if (count == 0)
        std::printf("SKIPPED noisy figures: no sequences or no recorded figures\n");
    else
        std::printf("FIGURE %d noisy figures agree with the recorded ones\n", count);
}
