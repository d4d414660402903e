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

// A column of figures.
struct FigureColumn
{
    const char* title;
    const FrameMeasures* measures;
};

std::vector<FigureColumn> columnsOf(const ReplayReport& report, const std::optional<PeerFigures>& peer)
{
    std::vector<FigureColumn> columns = {{"noisy", &report.noisy}, {"denoised", &report.denoised}};
    if (hasMeasures(report.extracted)) columns.push_back({"extracted", &report.extracted});
    if (!peer) return columns;
    columns.push_back({"peer noisy", &peer->noisy});
    columns.push_back({"peer", &peer->denoised});
    return columns;
}

// A measure that we don't have is left out.
std::string formatMeasures(const ReplayReport& report, const std::optional<PeerFigures>& peer)
{
    const std::vector<FigureColumn> columns = columnsOf(report, peer);
    std::string text = print("%-22s %-8s", "mean of the references", "");
    for (const FigureColumn& column : columns) text += print("%12s", column.title);
    text += "\n";
    for (size_t s = 0; s < kSignalCount; s++)
    {
        for (const MeasureInfo& measure : kMeasures)
        {
            if (!(report.noisy[s].*measure.field) && !(report.denoised[s].*measure.field)) continue;
            text += print("%-22s %-8s", signalInfo(static_cast<Signal>(s)).name, measure.name);
            for (const FigureColumn& column : columns)
                text += cell((*column.measures)[s].*measure.field, measure.decimals);
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
    {"hit distance flicker", Signal::NormHitDist, &SignalMeasures::flicker, 4},
    {"specular hit distance RMSE", Signal::SpecularNormHitDist, &SignalMeasures::rmse, 4},
};

// What the figures of one line are taken from.
struct SummaryLine
{
    std::string capture;
    std::string denoiser;
    const FrameMeasures* noisy;
    const FrameMeasures* denoised;
    const FrameMeasures* peer; // null: none
};

std::vector<SummaryLine> summaryLines(const std::vector<ReplayReport>& reports,
                                      const std::vector<std::optional<PeerFigures>>& peers)
{
    std::vector<SummaryLine> lines;
    for (size_t i = 0; i < reports.size(); i++)
    {
        const ReplayReport& r = reports[i];
        const bool isSh = hasMeasures(r.extracted);
        lines.push_back({r.capture, r.denoiser + (isSh ? " resolved" : ""), &r.noisy, &r.denoised,
                         peers[i] ? &peers[i]->denoised : nullptr});
        if (isSh) lines.push_back({r.capture, r.denoiser + " extracted", &r.noisy, &r.extracted, nullptr});
    }
    return lines;
}

std::string narrow(const std::optional<double>& value, int decimals)
{
    return value ? print("%8.*f", decimals, *value) : print("%8s", "-");
}

std::string textLine(const SummaryLine& line)
{
    std::string text = print("%-18s %-44s", line.capture.c_str(), line.denoiser.c_str());
    for (const SummaryColumn& column : kSummary)
    {
        const auto figure = [&](const FrameMeasures* measures)
        {
            const size_t s = static_cast<size_t>(column.signal);
            return narrow(measures ? (*measures)[s].*column.field : std::nullopt, column.decimals);
        };
        text += " | " + figure(line.noisy) + " >" + figure(line.denoised) + " (" + figure(line.peer) + ")";
    }
    return text + "\n";
}

// A cell without our figure is empty, and so are the brackets without the peer's.
std::string markdownLine(const SummaryLine& line)
{
    std::string text = "| " + line.denoiser + " | " + line.capture + " |";
    for (const SummaryColumn& column : kSummary)
    {
        const size_t s = static_cast<size_t>(column.signal);
        const auto value = [&](const FrameMeasures* measures)
        { return measures ? (*measures)[s].*column.field : std::nullopt; };
        const std::optional<double> noisy = value(line.noisy), ours = value(line.denoised), peer = value(line.peer);
        if (ours && noisy) text += print(" %.*f \u2192", column.decimals, *noisy);
        if (ours) text += print(" %.*f", column.decimals, *ours);
        if (ours && peer) text += print(" (%.*f)", column.decimals, *peer);
        text += " |";
    }
    return text + "\n";
}

std::string summaryHead(TableStyle style)
{
    if (style == TableStyle::Text)
    {
        std::string text = print("%-63s", "noisy > denoised (peer)");
        for (const SummaryColumn& column : kSummary) text += print(" | %-30s", column.title);
        return text + "\n";
    }
    std::string text = "| denoiser | capture |", rule = "| --- | --- |";
    for (const SummaryColumn& column : kSummary)
    {
        text += std::string(" ") + column.title + " |";
        rule += " --- |";
    }
    return text + "\n" + rule + "\n";
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
                          const std::vector<std::optional<PeerFigures>>& peers, TableStyle style)
{
    std::string text = summaryHead(style);
    for (const SummaryLine& line : summaryLines(reports, peers))
        text += style == TableStyle::Text ? textLine(line) : markdownLine(line);
    return text;
}
} // namespace sample
