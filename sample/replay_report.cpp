#include "replay_report.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>

namespace sample
{
namespace
{
using Json = nlohmann::ordered_json;

Json toJson(const FrameMeasures& measures)
{
    Json json = Json::object();
    for (size_t s = 0; s < kSignalCount; s++)
    {
        Json entry = Json::object();
        for (const MeasureInfo& measure : kMeasures)
        {
            const std::optional<double>& value = measures[s].*measure.field;
            if (value && std::isfinite(*value)) entry[measure.name] = *value;
        }
        if (!entry.empty()) json[signalInfo(static_cast<Signal>(s)).name] = std::move(entry);
    }
    return json;
}

Json toJson(const FrameMeasures& noisy, const FrameMeasures& denoised, const FrameMeasures& extracted)
{
    Json json = {{"noisy", toJson(noisy)}, {"denoised", toJson(denoised)}};
    if (hasMeasures(extracted)) json["extracted"] = toJson(extracted);
    return json;
}

FrameMeasures fromJson(const Json& json)
{
    FrameMeasures measures;
    for (size_t s = 0; s < kSignalCount; s++)
    {
        const auto entry = json.find(signalInfo(static_cast<Signal>(s)).name);
        if (entry == json.end()) continue;
        for (const MeasureInfo& measure : kMeasures)
            if (entry->contains(measure.name)) measures[s].*measure.field = entry->at(measure.name).get<double>();
    }
    return measures;
}

Json gpuJson(const ReplayReport& report)
{
    Json passes = Json::array();
    for (const PassReport& pass : report.passes) passes.push_back({{"name", pass.name}, {"ms", pass.ms}});
    return {{"total", *report.gpuMs}, {"passes", std::move(passes)}};
}

Json toJson(const ReplayReport& report)
{
    Json json = {{"capture", report.capture}, {"denoiser", report.denoiser}};
    if (!report.device.empty()) json["device"] = report.device;
    json["resolution"] = {report.width, report.height};
    if (!report.device.empty()) json["preset"] = nameOf(report.preset);
    json["settings"] = Json::object();
    for (const auto& [key, value] : report.settings) json["settings"][key] = value;
    if (report.resolution.divisor > 1)
        json["denoisedAt"] = {{"divisor", report.resolution.divisor}, {"sparse", report.resolution.isSparse}};
    if (report.gpuMs) json["gpuMs"] = gpuJson(report);
    if (report.memory)
        json["memoryMiB"] = {{"permanent", report.memory->permanent},
                             {"transient", report.memory->transient},
                             {"total", report.memory->total}};
    json["frames"] = Json::array();
    for (const SequenceFrame& frame : report.frames)
    {
        json["frames"].push_back({{"frame", frame.frame}});
        json["frames"].back().update(toJson(frame.noisy, frame.denoised, frame.extracted));
    }
    json["mean"] = toJson(report.noisy, report.denoised, report.extracted);
    return json;
}

// Runs `read` on the parsed file; every way in which JSON disappoints becomes a FileError.
template <class F> auto withJson(const std::filesystem::path& file, F&& read)
{
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw FileError(file.string() + " cannot be opened");
    try
    {
        return read(Json::parse(stream));
    }
    catch (const Json::exception& e)
    {
        throw FileError(file.string() + " is not a report: " + e.what());
    }
}
} // namespace

bool hasMeasures(const FrameMeasures& measures)
{
    for (const SignalMeasures& signal : measures)
        for (const MeasureInfo& measure : kMeasures)
            if (signal.*measure.field) return true;
    return false;
}

std::optional<PeerFigures> readPeer(const std::filesystem::path& file, const std::string& capture,
                                    const std::string& denoiser)
{
    const auto read = [&](const Json& rows) -> std::optional<PeerFigures>
    {
        for (const Json& row : rows)
        {
            if (row.at("capture") != capture || row.at("denoiser") != denoiser) continue;
            PeerFigures figures{fromJson(row.at("mean").at("noisy")), fromJson(row.at("mean").at("denoised")), {}, {}};
            if (!row.contains("gpuMs")) return figures;
            figures.gpuMs = row.at("gpuMs").at("total").get<double>();
            figures.device = row.at("gpuMs").value("device", "unknown device");
            return figures;
        }
        return std::nullopt;
    };
    return withJson(file, read);
}

void writeReport(const std::filesystem::path& file, const ReplayReport& report)
{
    std::ofstream stream(file, std::ios::binary);
    stream << toJson(report).dump(1, ' ', false, Json::error_handler_t::replace) << '\n';
    if (!stream.flush()) throw FileError(file.string() + " cannot be written");
}

ReplayReport readReport(const std::filesystem::path& file)
{
    const auto read = [](const Json& json)
    {
        ReplayReport report;
        report.capture = json.at("capture").get<std::string>();
        report.denoiser = json.at("denoiser").get<std::string>();
        report.noisy = fromJson(json.at("mean").at("noisy"));
        report.denoised = fromJson(json.at("mean").at("denoised"));
        if (json.at("mean").contains("extracted")) report.extracted = fromJson(json.at("mean").at("extracted"));
        if (json.contains("gpuMs")) report.gpuMs = json.at("gpuMs").at("total").get<double>();
        return report;
    };
    return withJson(file, read);
}
} // namespace sample
