// What is printed and written of the results, with the recorded figures of the peer beside them.
#pragma once
#include "bench_result.h"

#include <filesystem>

namespace sample::bench
{
// One row of a file of the shape of nrd-*-h200.json.
struct PeerRow
{
    std::string denoiser;
    Extent size;
    std::string device;
    double gpuMs = 0.0;
    double permanent = 0.0, transient = 0.0; // MiB
};

// Throws FileError when the file is missing or not of that shape.
std::vector<PeerRow> readPeer(const std::filesystem::path& file);

// Null when the peer has no such row.
const PeerRow* findPeer(const std::vector<PeerRow>& rows, const Result& result);

// A paragraph per result: passes with time, floor and ratio, CPU time, memory.
std::string formatResult(const Report& report, const Result& result, const PeerRow* peer);

// A list with one object per result. Throws FileError.
void writeJson(const std::filesystem::path& file, const Report& report);
} // namespace sample::bench
