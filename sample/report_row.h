// One measured, recorded or given point of the report.
#pragma once
#include "replay_report.h"

namespace sample::report
{
enum class RowKind : uint8_t
{
    Ours,
    Noisy, // the input as it is, for no time
    Peer   // recorded, on the device it names
};

struct Row
{
    RowKind kind = RowKind::Ours;
    std::string capture;
    std::string group;    // as groupOf()
    std::string denoiser; // empty: none, the noisy input
    std::string point;
    std::string settings; // preset and key=value, separated by blanks
    std::string device;
    std::optional<double> gpuMs;
    std::optional<double> msPerMegapixel;
    SignalMeasures errors; // of the composed picture, else of the hit distance
    bool isOnFlipFront = false;
    bool isOnPsnrFront = false;
};

// The composed picture's where it is measured, else those of the hit distance; empty without either.
SignalMeasures errorsOf(const FrameMeasures& measures);

// A replay as a row of the point. Kind Noisy: its input, for no time.
Row rowOf(const ReplayReport& report, const std::string& group, const std::string& point, RowKind kind = RowKind::Ours);

// What is recorded for the replay's capture and denoiser.
Row rowOf(const PeerFigures& peer, const ReplayReport& report, const std::string& group);
} // namespace sample::report
