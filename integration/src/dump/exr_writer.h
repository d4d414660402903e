// Pictures as OpenEXR files: scan lines of 32-bit floats, uncompressed. So little of the format needs no library, which
// an engine that links the integration would have to bring.
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace nrd::dump
{
/// A type of our own keeps what the map is made of out of the symbols that the shared library exports.
struct ChannelOrder
{
    bool operator()(const std::string& a, const std::string& b) const { return a < b; }
};

/// Values by channel, row 0 on top; the order is that of the file.
using Channels = std::map<std::string, std::vector<float>, ChannelOrder>;

/// Every channel has width * height values, and a name of at most 31 characters. Throws a Refusal.
void writeExr(const std::filesystem::path& file, uint32_t width, uint32_t height, const Channels& channels);
} // namespace nrd::dump
