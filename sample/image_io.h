// Pictures in memory and on disk: PNG out (tone-mapped), Radiance .hdr and OpenEXR in.
// Everything throws FileError, whose text is one sentence that names the file.
#pragma once
#include <filesystem>
#include <stdexcept>
#include <vector>

namespace sample
{
// What went wrong with a file, in one sentence that names it; the only exception of the file code.
class FileError : public std::runtime_error
{
public:
    using std::runtime_error::runtime_error;
};

// Linear HDR picture; row 0 is the top row, four floats per pixel.
struct Image
{
    int width = 0;
    int height = 0;
    std::vector<float> rgba; // width * height * 4

    Image() = default;
    Image(int w, int h) : width(w), height(h), rgba(static_cast<size_t>(w) * static_cast<size_t>(h) * 4) {}
};

// The sRGB transfer function, from linear [0; 1] to encoded [0; 1].
float encodeSrgb(float linear);

// x / (1 + x) with negative and non-finite values first set to 0: linear HDR to linear [0; 1).
float compressRange(float radiance);

// The project's tone mapping T: encodeSrgb(compressRange(x)).
float toneMap(float radiance);

// Reads an environment picture by its extension: .hdr (Radiance) or .exr (channels R, G, B and, if there, A).
// Throws FileError when the file is missing, broken, larger than 16384 pixels in an axis, or of another kind.
Image readImage(const std::filesystem::path& file);

// Writes the tone-mapped RGB of a linear picture as an 8-bit PNG. Throws FileError when it cannot be written.
void writePng(const std::filesystem::path& file, const Image& linear);

// The same for RGB in [0; 1] that is encoded for the screen already.
void writeEncodedPng(const std::filesystem::path& file, const Image& encoded);
} // namespace sample
