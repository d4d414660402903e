// nrd-replay --doctor: what is wrong with a capture's inputs, by the same way an application asks.
#pragma once
#include <cstddef>
#include <iosfwd>
#include <string>
#include <vector>

namespace sample
{
struct DoctorRun
{
    std::string capture;               // folder
    std::string denoiser;              // empty: the REBLUR that reads the lobes the capture has
    std::vector<std::string> settings; // key=value, on top of what the capture says
    size_t frameCount = 0;             // 0: all
    std::string device;                // as engine::DeviceDesc::device
    bool validation = false;
};

inline constexpr int kHealthy = 0;
inline constexpr int kFindings = 2; // 1 is an error

// Prints one line per finding and a last one with their number; returns kHealthy or kFindings. Throws FileError,
// SettingError and engine::Error.
int runDoctor(const DoctorRun& run, std::ostream& out);
} // namespace sample
