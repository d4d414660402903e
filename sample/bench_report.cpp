#include "bench_report.h"

#include "capture.h"

#include <nlohmann/json.hpp>

#include <cstdarg>
#include <cstdio>
#include <fstream>

namespace sample::bench
{
namespace
{
using Json = nlohmann::ordered_json;

constexpr double kMiB = 1024.0 * 1024.0;

[[gnu::format(printf, 1, 2)]] std::string print(const char* format, ...)
{
    char text[256];
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(text, sizeof(text), format, arguments);
    va_end(arguments);
    return text;
}

double pixelCount(Extent size) { return double(size.width) * size.height; }

uint64_t byteCountOf(const GpuResult& gpu)
{
    uint64_t byteCount = 0;
    for (const PassResult& pass : gpu.passes) byteCount += pass.byteCount;
    return byteCount;
}

std::string formatRow(const Report& report, const char* name, double ms, uint64_t byteCount)
{
    const double floor = floorMs(byteCount, report.bytesPerSecond);
    std::string text = print("  %-28s %9.4f ms  %9.1f MiB", name, ms, static_cast<double>(byteCount) / kMiB);
    if (floor > 0.0) text += print("  %9.4f ms  %6.2f", floor, ms / floor);
    return text;
}

std::string formatGpu(const Report& report, const GpuResult& gpu, const PeerRow* peer)
{
    std::string text = print("  %-28s %12s  %13s  %12s  %6s\n", "GPU", "median", "least traffic", "floor", "ratio");
    for (const PassResult& pass : gpu.passes)
        text += formatRow(report, pass.name.c_str(), pass.ms, pass.byteCount) + "\n";
    text += formatRow(report, "total", gpu.total, byteCountOf(gpu));
    text += print("  (10 %% to 90 %% of the frames: %.4f to %.4f)\n", gpu.p10, gpu.p90);
    if (peer)
        text += print("  %-28s %9.4f ms  on its %s, ours takes %.2f of it\n", "peer", peer->gpuMs, peer->device.c_str(),
                      gpu.total / peer->gpuMs);
    return text;
}

std::string formatMemory(const char* name, double permanent, double transient, Extent size)
{
    const double sum = permanent + transient;
    return print("  %-28s %.2f MiB permanent + %.2f transient = %.2f, %.1f bytes per pixel\n", name, permanent,
                 transient, sum, sum * kMiB / pixelCount(size));
}

Json gpuJson(const Report& report, const GpuResult& gpu)
{
    Json json = {{"total", gpu.total}, {"p10", gpu.p10}, {"p90", gpu.p90}};
    if (report.bytesPerSecond > 0.0) json["floor"] = floorMs(byteCountOf(gpu), report.bytesPerSecond);
    json["passes"] = Json::array();
    for (const PassResult& pass : gpu.passes)
    {
        Json row = {{"name", pass.name}, {"ms", pass.ms}, {"byteCount", pass.byteCount}};
        if (report.bytesPerSecond > 0.0) row["floorMs"] = floorMs(pass.byteCount, report.bytesPerSecond);
        json["passes"].push_back(std::move(row));
    }
    return json;
}

Json toJson(const Report& report, const Result& result)
{
    Json json = {{"denoiser", result.denoiser},
                 {"resolution", {result.size.width, result.size.height}},
                 {"device", report.device}};
    json["settings"] = Json::object();
    for (const auto& [key, value] : report.workload.settings) json["settings"][key] = value;
    if (report.bytesPerSecond > 0.0) json["copyGBPerSecond"] = report.bytesPerSecond * 1e-9;
    if (result.cpu) json["input"] = {{"static", report.workload.isStatic}, {"frames", report.workload.frameCount}};
    const Resolution& resolution = report.workload.resolution;
    if (resolution.divisor > 1) json["denoisedAt"] = {{"divisor", resolution.divisor}, {"sparse", resolution.isSparse}};
    if (result.skyPercent) json["input"]["skyPercent"] = *result.skyPercent;
    if (result.gpu) json["gpuMs"] = gpuJson(report, *result.gpu);
    const double sum = result.memory.permanent + result.memory.transient;
    json["memoryMiB"] = {{"permanent", result.memory.permanent / kMiB},
                         {"transient", result.memory.transient / kMiB},
                         {"total", sum / kMiB}};
    json["bytesPerPixel"] = sum / pixelCount(result.size);
    if (!result.cpu) return json;
    json["cpuUs"] = {{"emit", result.cpu->emit}, {"record", result.cpu->record}};
    json["createMs"] = result.cpu->createMs;
    return json;
}

PeerRow peerRow(const Json& json)
{
    PeerRow row;
    row.denoiser = json.at("denoiser").get<std::string>();
    row.size = {json.at("resolution").at(0).get<uint32_t>(), json.at("resolution").at(1).get<uint32_t>()};
    row.device = json.at("device").get<std::string>();
    row.gpuMs = json.at("gpuMs").at("total").get<double>();
    row.permanent = json.at("memoryMiB").at("permanent").get<double>();
    row.transient = json.at("memoryMiB").at("transient").get<double>();
    return row;
}
} // namespace

std::vector<PeerRow> readPeer(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw FileError(file.string() + " cannot be opened");
    try
    {
        std::vector<PeerRow> rows;
        for (const Json& json : Json::parse(stream)) rows.push_back(peerRow(json));
        return rows;
    }
    catch (const Json::exception& e)
    {
        throw FileError(file.string() + " is not a list of recorded figures: " + e.what());
    }
}

const PeerRow* findPeer(const std::vector<PeerRow>& rows, const Result& result)
{
    for (const PeerRow& row : rows)
        if (row.denoiser == result.denoiser && row.size.width == result.size.width &&
            row.size.height == result.size.height)
            return &row;
    return nullptr;
}

std::string formatResult(const Report& report, const Result& result, const PeerRow* peer)
{
    std::string text = print("%s, %u x %u", result.denoiser.c_str(), result.size.width, result.size.height);
    if (result.skyPercent) text += print(", %.1f %% sky", *result.skyPercent);
    if (result.cpu) text += report.workload.isStatic ? ", camera still" : ", camera moving";
    text += "\n";
    if (result.gpu) text += formatGpu(report, *result.gpu, peer);
    if (result.cpu)
        text += print("  %-28s emission %.1f us, recording %.1f us, creation %.1f ms\n", "CPU", result.cpu->emit,
                      result.cpu->record, result.cpu->createMs);
    text += formatMemory("memory", result.memory.permanent / kMiB, result.memory.transient / kMiB, result.size);
    if (peer) text += formatMemory("memory of the peer", peer->permanent, peer->transient, result.size);
    return text;
}

void writeJson(const std::filesystem::path& file, const Report& report)
{
    Json json = Json::array();
    for (const Result& result : report.results) json.push_back(toJson(report, result));
    std::ofstream stream(file, std::ios::binary);
    stream << json.dump(1, ' ', false, Json::error_handler_t::replace) << '\n';
    if (!stream.flush()) throw FileError(file.string() + " cannot be written");
}
} // namespace sample::bench
