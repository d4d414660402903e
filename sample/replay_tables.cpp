// The printed half of replay_report.h.
#include "replay_report.h"

#include <cstdarg>
#include <cstdio>

namespace sample
{
namespace
{
#if defined(__GNUC__)
__attribute__((format(printf, 1, 2)))
#endif
std::string
print(const char* format, ...)
{
    char text[256];
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(text, sizeof(text), format, arguments);
    va_end(arguments);
    return text;
}

std::string cell(const std::optional<double>& value, int decimals)
{
    return value ? print("%12.*f", decimals, *value) : print("%12s", "");
}

std::string formatGpu(const ReplayReport& report, const std::optional<PeerFigures>& peer)
{
    std::string text = "GPU time (median), " + report.device + "\n";
    for (const PassReport& pass : report.passes) text += print("  %-40s %9.4f ms\n", pass.name.c_str(), pass.ms);
    text += print("  %-40s %9.4f ms", "total", *report.gpuMs);
    if (peer && peer->gpuMs) text += print("  (peer, on its own device: %.4f ms)", *peer->gpuMs);
    return text + "\n";
}

// A measure that neither side has is left out.
std::string formatMeasures(const ReplayReport& report, const std::optional<PeerFigures>& peer)
{
    std::string text = print("%-20s %-8s%12s%12s", "mean of the references", "", "noisy", "denoised");
    if (peer) text += print("%12s%12s", "peer noisy", "peer");
    text += "\n";
    for (size_t s = 0; s < kSignalCount; s++)
    {
        for (const MeasureInfo& measure : kMeasures)
        {
            const std::optional<double>& noisy = report.noisy[s].*measure.field;
            const std::optional<double>& denoised = report.denoised[s].*measure.field;
            if (!noisy && !denoised) continue;
            text += print("%-22s %-8s", signalInfo(static_cast<Signal>(s)).name, measure.name) +
                    cell(noisy, measure.decimals) + cell(denoised, measure.decimals);
            if (peer)
                text += cell(peer->noisy[s].*measure.field, measure.decimals) +
                        cell(peer->denoised[s].*measure.field, measure.decimals);
            text += "\n";
        }
    }
    return text;
}

struct SummaryColumn
{
    const char* title;
    Signal signal;
    std::optional<double> SignalMeasures::*field;
    int decimals;
};
constexpr SummaryColumn kSummary[] = {
    {"PSNR dB", Signal::Composed, &SignalMeasures::psnr, 2},
    {"FLIP", Signal::Composed, &SignalMeasures::flip, 4},
    {"relMSE", Signal::Composed, &SignalMeasures::relMse, 4},
    {"flicker", Signal::Composed, &SignalMeasures::flicker, 4},
    {"hit distance RMSE", Signal::NormHitDist, &SignalMeasures::rmse, 4},
};

std::string narrow(const std::optional<double>& value, int decimals)
{
    return value ? print("%8.*f", decimals, *value) : print("%8s", "-");
}
} // namespace

std::string formatReport(const ReplayReport& report, const std::optional<PeerFigures>& peer)
{
    std::string text =
        print("%s, %s, %d x %d\n", report.capture.c_str(), report.denoiser.c_str(), report.width, report.height);
    if (report.gpuMs) text += formatGpu(report, peer);
    if (report.memory)
        text += print("memory: %.2f MiB permanent + %.2f MiB transient, %.2f MiB in all\n", report.memory->permanent,
                      report.memory->transient, report.memory->total);
    if (report.nonFiniteCount)
        text += print("WARNING: %zu denoised values are NaN or infinite\n", report.nonFiniteCount);
    if (report.frames.empty()) return text + "no frame has a reference: nothing to measure\n";
    return text + formatMeasures(report, peer);
}

std::string formatSummary(const std::vector<ReplayReport>& reports,
                          const std::vector<std::optional<PeerFigures>>& peers)
{
    std::string text = print("%-52s", "noisy > denoised (peer)");
    for (const SummaryColumn& column : kSummary) text += print(" | %-30s", column.title);
    text += "\n";
    for (size_t i = 0; i < reports.size(); i++)
    {
        text += print("%-18s %-33s", reports[i].capture.c_str(), reports[i].denoiser.c_str());
        for (const SummaryColumn& column : kSummary)
        {
            const size_t s = static_cast<size_t>(column.signal);
            std::optional<double> recorded;
            if (peers[i]) recorded = peers[i]->denoised[s].*column.field;
            text += " | " + narrow(reports[i].noisy[s].*column.field, column.decimals) + " >" +
                    narrow(reports[i].denoised[s].*column.field, column.decimals) + " (" +
                    narrow(recorded, column.decimals) + ")";
        }
        text += "\n";
    }
    return text;
}
} // namespace sample
