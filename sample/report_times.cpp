#include "report_times.h"
#include "bench_run.h"

#include <algorithm>
#include <iostream>
#include <limits>

namespace sample::report
{
namespace
{
constexpr uint32_t kFrameCount = 48;
constexpr int kRunCount = 3; // of which the fastest counts: a GPU that has rested clocks up only by and by
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
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < kRunCount; i++)
    {
        const bench::Result result = bench::Run({*m_device, denoiser, m_size, workload}).measure();
        if (!result.gpu) throw engine::Error("--time-size: the device has no timestamps");
        least = std::min(least, result.gpu->total);
    }
    return least;
}

void Times::setTime(Row& row, double ms) const
{
    row.gpuMs = ms;
    row.msPerMegapixel = ms * 1e6 / (double(m_size.width) * m_size.height);
}
} // namespace sample::report
