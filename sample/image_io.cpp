#include "image_io.h"
#include "exr.h"

#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <memory>

// Static: the glTF loader brings its own copy of the same functions.
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_HDR
#define STBI_MAX_DIMENSIONS 16384
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#endif
#include <stb/stb_image.h>
#include <stb/stb_image_write.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace sample
{
namespace
{
struct FileCloser
{
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using UniqueFile = std::unique_ptr<std::FILE, FileCloser>;

struct StbFree
{
    void operator()(float* pixels) const { stbi_image_free(pixels); }
};

Image readHdr(const std::filesystem::path& file)
{
    UniqueFile stream(std::fopen(file.c_str(), "rb"));
    if (!stream) throw FileError(file.string() + " cannot be opened");
    if (!stbi_is_hdr_from_file(stream.get())) throw FileError(file.string() + " is not a Radiance .hdr picture");
    Image image;
    int channelCount = 0;
    const std::unique_ptr<float, StbFree> pixels(
        stbi_loadf_from_file(stream.get(), &image.width, &image.height, &channelCount, 4));
    if (!pixels) throw FileError(file.string() + " is broken: " + stbi_failure_reason());
    image.rgba.assign(pixels.get(), pixels.get() + static_cast<size_t>(image.width) * image.height * 4);
    return image;
}

Image readExrImage(const std::filesystem::path& file)
{
    const ExrPicture picture = readExr(file);
    Image image(picture.width, picture.height);
    const char* const names[4] = {"R", "G", "B", "A"};
    for (size_t c = 0; c < 4; c++)
    {
        const ExrChannel* channel = picture.find(names[c]);
        if (!channel && c < 3) throw FileError(file.string() + " has no channel " + names[c]);
        for (size_t i = 0; i < image.rgba.size() / 4; i++) image.rgba[i * 4 + c] = channel ? channel->values[i] : 1.0f;
    }
    return image;
}
} // namespace

float encodeSrgb(float linear)
{
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

float compressRange(float radiance)
{
    if (!std::isfinite(radiance) || radiance < 0.0f) return 0.0f;
    return radiance / (1.0f + radiance);
}

float toneMap(float radiance) { return encodeSrgb(compressRange(radiance)); }

Image readImage(const std::filesystem::path& file)
{
    std::string extension = file.extension().string();
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (extension == ".hdr") return readHdr(file);
    if (extension == ".exr") return readExrImage(file);
    throw FileError(file.string() + " is neither an .hdr nor an .exr picture");
}

void writePng(const std::filesystem::path& file, const Image& linear)
{
    Image encoded = linear;
    for (float& value : encoded.rgba) value = toneMap(value);
    writeEncodedPng(file, encoded);
}

void writeEncodedPng(const std::filesystem::path& file, const Image& encoded)
{
    const size_t pixelCount = static_cast<size_t>(encoded.width) * static_cast<size_t>(encoded.height);
    std::vector<uint8_t> rgb(pixelCount * 3);
    for (size_t i = 0; i < pixelCount; i++)
        for (size_t c = 0; c < 3; c++)
        {
            const float value = encoded.rgba[i * 4 + c];
            rgb[i * 3 + c] = static_cast<uint8_t>(value > 0.0f ? std::min(value, 1.0f) * 255.0f + 0.5f : 0.0f);
        }
    if (!stbi_write_png(file.c_str(), encoded.width, encoded.height, 3, rgb.data(), encoded.width * 3))
        throw FileError(file.string() + " cannot be written");
}
} // namespace sample
