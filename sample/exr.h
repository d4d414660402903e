// OpenEXR files as named channels of floats, row 0 on top. Throws FileError (one sentence that names the file).
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace sample
{
enum class ExrType : uint8_t
{
    Half,
    Float
};

struct ExrChannel
{
    std::string name;
    ExrType type = ExrType::Half; // how it is stored; in memory it is always float
    std::vector<float> values;    // width * height
};

struct ExrPicture
{
    int width = 0;
    int height = 0;
    std::vector<ExrChannel> channels;

    // The channel of that name; null when there is none.
    const ExrChannel* find(std::string_view name) const;
};

// What the head of a file says, without its pixels.
struct ExrHeader
{
    int width = 0;
    int height = 0;
    bool isLossless = true;
    std::vector<std::string> channelNames; // sorted
};

// Largest width and height that is read, in pixels, and the largest number of pixels.
inline constexpr int kMaxExrSize = 16384;
inline constexpr int64_t kMaxExrPixels = int64_t(1) << 26;

// Reads the head of a scanline or tiled file and checks that no part of the picture is missing.
// Throws FileError: file missing, not OpenEXR, truncated, deep, or larger than kMaxExrSize or kMaxExrPixels.
ExrHeader readExrHeader(const std::filesystem::path& file);

// Reads all half and float channels. Throws what readExrHeader() throws, and for subsampled or integer channels.
ExrPicture readExr(const std::filesystem::path& file);

// Writes a ZIP-compressed scanline file. Finite values beyond the range of half are clamped to it, so that they stay
// finite; NaN and infinity are kept. Throws FileError.
void writeExr(const std::filesystem::path& file, const ExrPicture& picture);
} // namespace sample
