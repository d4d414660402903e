// nrd-bench: GPU time by pass against the bandwidth floor, CPU time and memory, on generated input.
#include "bench_bandwidth.h"
#include "bench_report.h"
#include "bench_run.h"

#include "capture.h"

#include <fstream>
#include <iostream>

namespace
{
using namespace sample;
using namespace sample::bench;

// The file given, else the recorded figures of the test data when they are there.
std::vector<PeerRow> peerRows(const Options& options)
{
    if (!options.peer.empty()) return readPeer(options.peer);
    const std::filesystem::path file = std::filesystem::path(NRD_TEST_DATA) / "peer" / "nrd-4.17.4-h200.json";
    std::error_code error;
    return std::filesystem::is_regular_file(file, error) ? readPeer(file) : std::vector<PeerRow>();
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

// What would only fail after all the work fails before it.
void prepareJson(const Options& options)
{
    if (!options.json.empty() && !std::ofstream(options.json, std::ios::app))
        throw FileError(options.json + " cannot be written");
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
    prepareJson(options);
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

void run(int argumentCount, char** arguments)
{
    const std::optional<Options> options = parseOptions(argumentCount, arguments);
    if (!options) return;
    if (!options->isDeviceListWanted) return bench(*options);
    for (const std::string& line : engine::listDevices()) std::cout << line << '\n';
}
} // namespace

int main(int argumentCount, char** arguments)
{
    try
    {
        run(argumentCount, arguments);
        return 0;
    }
    catch (const std::bad_alloc&)
    {
        std::cerr << "nrd-bench: out of memory\n";
    }
    catch (const std::exception& e)
    {
        std::cerr << "nrd-bench: " << e.what() << '\n';
    }
    return 1;
}
