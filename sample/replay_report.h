// The JSON report of a replay, the printed tables, and the recorded figures of the peer beside them.
#pragma once
#include "replay_settings.h"
#include "resolution.h"
#include "sequence.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace sample
{
struct PassReport
{
    std::string name; // without the denoiser's
    double ms = 0.0;
};

struct ReplayReport
{
    std::string capture;
    std::string denoiser;
    std::string device; // empty without a denoiser
    int width = 0;
    int height = 0;
    nrd::Quality preset = nrd::Quality::BALANCED;
    std::vector<Assignment> settings; // what --set changed on top of it
    Resolution resolution = {};
    std::optional<double> gpuMs;    // median of the frames' totals
    std::vector<PassReport> passes; // medians
    struct Memory
    {
        double permanent = 0.0, transient = 0.0, total = 0.0; // MiB
    };
    std::optional<Memory> memory;
    std::vector<SequenceFrame> frames;
    FrameMeasures noisy;       // means
    FrameMeasures denoised;    // means, empty without a denoiser
    FrameMeasures extracted;   // means of the colours before the resolve, empty but for SH denoisers
    size_t nonFiniteCount = 0; // denoised values that are NaN or infinite: the measures take them for 0
};

// Recorded means of another denoiser on the same capture.
struct PeerFigures
{
    FrameMeasures noisy;
    FrameMeasures denoised;
    std::optional<double> gpuMs;
    std::string device; // that it was timed on
};

// The recorded row of a capture and denoiser in a file of the shape of nrd-*-sequences.json; without one, nothing.
// Throws FileError when the file is missing or not of that shape.
std::optional<PeerFigures> readPeer(const std::filesystem::path& file, const std::string& capture,
                                    const std::string& denoiser);

// Writes one JSON object; throws FileError.
void writeReport(const std::filesystem::path& file, const ReplayReport& report);

// Reads what --summary needs of a report: names and means. Throws FileError.
ReplayReport readReport(const std::filesystem::path& file);

// Whether any measure is there.
bool hasMeasures(const FrameMeasures& measures);

// GPU time by pass, memory, and every measure: noisy, denoised, extracted and the peer's where there are some.
std::string formatReport(const ReplayReport& report, const std::optional<PeerFigures>& peer);

enum class TableStyle : uint8_t
{
    Text,
    Markdown
};

// One line per report, two where there are extracted colours: noisy, ours and the peer's errors of the composed picture
// and of the hit distances. peers[i] belongs to reports[i].
std::string formatSummary(const std::vector<ReplayReport>& reports,
                          const std::vector<std::optional<PeerFigures>>& peers, TableStyle style = TableStyle::Text);
} // namespace sample
