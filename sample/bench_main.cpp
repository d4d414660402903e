// nrd-bench: GPU time by pass against the bandwidth floor, CPU time and memory, on generated input.
#include "bench_bandwidth.h"
#include "bench_report.h"
#include "bench_run.h"

#include "program.h"

namespace
{
using namespace sample;
using namespace sample::bench;

std::vector<PeerRow> peerRows(const Options& options)
{
    const std::filesystem::path file = peerFile(options.peer, "nrd-4.17.4-h200.json");
    return file.empty() ? std::vector<PeerRow>() : readPeer(file);
}

std::unique_ptr<engine::Device> createDevice(const Options& options)
{
    const nrd::RequiredDeviceFeatures required = nrd::GetRequiredDeviceFeatures();
    engine::DeviceDesc desc;
    desc.device = options.device;
    desc.validation = options.validation;
    desc.features = required.features;
    desc.extensions.assign(required.deviceExtensions, required.deviceExtensions + required.deviceExtensionsNum);
    return std::make_unique<engine::Device>(desc);
}

Result measure(const engine::Device& device, const ReplayDenoiser& denoiser, Extent size, const Options& options)
{
    Run run({device, denoiser, size, options.workload});
    if (!options.isMemoryOnly) return run.measure();
    return {denoiser.name, size, run.memory(), {}, {}, {}};
}

void bench(const Options& options)
{
    const std::vector<PeerRow> peers = peerRows(options);
    prepareFile(options.json);
    const std::unique_ptr<engine::Device> device = createDevice(options);
    Report report;
    report.device = device->properties().deviceName;
    report.workload = options.workload;
    std::cout << report.device;
    if (!options.isMemoryOnly)
    {
        report.bytesPerSecond = measureCopyBandwidth(*device);
        std::cout << ", copies " << report.bytesPerSecond * 1e-9 << " GB/s";
    }
    std::cout << '\n';
    for (const ReplayDenoiser* denoiser : options.denoisers)
    {
        for (const Extent& size : options.sizes)
        {
            const Result& result = report.results.emplace_back(measure(*device, *denoiser, size, options));
            std::cout << formatResult(report, result, findPeer(peers, result)) << std::flush;
        }
    }
    if (!options.json.empty()) writeJson(options.json, report);
    if (const uint32_t messageCount = device->validationMessageCount())
        throw engine::Error("the validation layers had " + std::to_string(messageCount) + " messages");
}

int run(int argumentCount, char** arguments)
{
    const std::optional<Options> options = parseOptions(argumentCount, arguments);
    if (!options) return 0;
    if (options->isDeviceListWanted)
        for (const std::string& line : engine::listDevices()) std::cout << line << '\n';
    else
        bench(*options);
    return 0;
}
} // namespace

int main(int argumentCount, char** arguments)
{
    return runProgram("nrd-bench", [&] { return run(argumentCount, arguments); });
}
