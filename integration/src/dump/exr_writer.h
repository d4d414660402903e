// Pictures as OpenEXR files: scan lines of 32-bit floats, uncompressed. So little of the format needs no library, which
// an engine that links the integration would have to bring.
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace nrd::dump
{
/// Values by channel, row 0 on top; the order is that of the file.
using Channels = std::map<std::string, std::vector<float>>;

/// Every channel has width * height values, and a name of at most 31 characters. Throws a Refusal.
void writeExr(const std::filesystem::path& file, uint32_t width, uint32_t height, const Channels& channels);
} // namespace nrd::dump
