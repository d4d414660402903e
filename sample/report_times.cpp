#include "report_times.h"
#include "bench_run.h"

#include <algorithm>
#include <iostream>

namespace sample::report
{
namespace
{
constexpr uint32_t kFrameCount = 48;
// The fastest run counts, once others confirm it: a GPU that has rested clocks up only by and by, and others slow it.
constexpr int kMaxRunCount = 12;
constexpr int kConfirmedCount = 4;
constexpr double kSame = 1.01; // of the fastest
} // namespace

Times::Times(std::shared_ptr<engine::Device> device, bench::Extent size, const std::filesystem::path& peer)
    : m_device(std::move(device)), m_size(size)
{
    if (!peer.empty()) m_peers = bench::readPeer(peer);
}

void Times::setTime(Row& row, const ReplayDenoiser& denoiser, const Point& point)
{
    const std::string key = std::string(denoiser.name) + ", " + point.name;
    if (!m_times.contains(key)) m_times[key] = measure(denoiser, point);
    setTime(row, m_times[key]);
}

void Times::setPeerTime(Row& row) const
{
    const bench::PeerRow* peer = bench::findPeer(m_peers, {row.denoiser, m_size, {}, {}, {}, {}});
    row.gpuMs.reset();
    row.msPerMegapixel.reset();
    if (peer) setTime(row, peer->gpuMs);
}

double Times::measure(const ReplayDenoiser& denoiser, const Point& point) const
{
    std::cerr << "time at " << m_size.width << "x" << m_size.height << ", " << denoiser.name << ", " << point.name
              << '\n';
    bench::Workload workload;
    workload.preset = point.preset;
    workload.settings = point.settings;
    workload.resolution = point.resolution;
    workload.frameCount = kFrameCount;
    std::vector<double> times;
    for (int i = 0; i < kMaxRunCount; i++)
    {
        const bench::Result result = bench::Run({*m_device, denoiser, m_size, workload}).measure();
        if (!result.gpu) throw engine::Error("--time-size: the device has no timestamps");
        times.push_back(result.gpu->total);
        const double limit = kSame * *std::min_element(times.begin(), times.end());
        const auto isConfirmed = [limit](double time) { return time <= limit; };
        if (std::count_if(times.begin(), times.end(), isConfirmed) >= kConfirmedCount) break;
    }
    return *std::min_element(times.begin(), times.end());
}

void Times::setTime(Row& row, double ms) const
{
    row.gpuMs = ms;
    row.msPerMegapixel = ms * 1e6 / (double(m_size.width) * m_size.height);
}
} // namespace sample::report
