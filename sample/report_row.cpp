#include "report_row.h"

namespace sample::report
{
namespace
{
std::string textOf(const ReplayReport& report)
{
    std::string text = nameOf(report.preset);
    for (const auto& [key, value] : report.settings) text += " " + key + "=" + value;
    if (report.resolution.divisor > 1) text += " divisor=" + std::to_string(report.resolution.divisor);
    if (report.resolution.divisor > 1 && report.resolution.isSparse) text += " sparse";
    return text;
}

void setTime(Row& row, std::optional<double> gpuMs, const ReplayReport& report)
{
    row.gpuMs = gpuMs;
    if (gpuMs) row.msPerMegapixel = *gpuMs * 1e6 / (double(report.width) * report.height);
}
} // namespace

SignalMeasures errorsOf(const FrameMeasures& measures)
{
    for (Signal signal : {Signal::Composed, Signal::NormHitDist, Signal::SpecularNormHitDist})
        if (measures[static_cast<size_t>(signal)].psnr) return measures[static_cast<size_t>(signal)];
    return {};
}

Row rowOf(const ReplayReport& report, const std::string& group, const std::string& point, RowKind kind)
{
    const bool isNoisy = kind == RowKind::Noisy;
    Row row;
    row.kind = kind;
    row.capture = report.capture;
    row.group = group;
    row.point = point;
    row.errors = errorsOf(isNoisy ? report.noisy : report.denoised);
    setTime(row, isNoisy ? 0.0 : report.gpuMs, report);
    if (isNoisy) return row;
    row.denoiser = report.denoiser;
    row.settings = textOf(report);
    row.device = report.device;
    return row;
}

Row rowOf(const PeerFigures& peer, const ReplayReport& report, const std::string& group)
{
    Row row;
    row.kind = RowKind::Peer;
    row.capture = report.capture;
    row.group = group;
    row.denoiser = report.denoiser;
    row.point = "peer";
    row.device = peer.device;
    row.errors = errorsOf(peer.denoised);
    setTime(row, peer.gpuMs, report);
    return row;
}
} // namespace sample::report
