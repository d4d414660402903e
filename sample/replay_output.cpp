#include "replay_output.h"
#include "exr.h"

#include <cstdio>

namespace sample
{
namespace
{
std::filesystem::path numbered(const std::filesystem::path& folder, const char* stem, size_t frameIndex,
                               const char* extension)
{
    char name[64];
    std::snprintf(name, sizeof(name), "%s_%04zu.%s", stem, frameIndex, extension);
    return folder / name;
}

Image interleaved(const Picture& colours)
{
    Image image(colours.width, colours.height);
    for (size_t i = 0; i < colours.pixelCount(); i++)
        for (size_t c = 0; c < 3; c++) image.rgba[i * 4 + c] = colours.planes[c][i];
    return image;
}
} // namespace

void writeDenoisedExr(const std::filesystem::path& folder, size_t frameIndex, const Signals& signals)
{
    ExrPicture picture;
    for (size_t s = 0; s < kSignalCount; s++)
    {
        const SignalInfo& info = signalInfo(static_cast<Signal>(s));
        const Picture& source = signals[info.signal];
        for (size_t c = 0; c < source.planes.size(); c++)
        {
            const Channel channel = next(info.reference, static_cast<int>(c));
            picture.channels.push_back({channelInfo(channel).name, ExrType::Float, source.planes[c]});
            picture.width = source.width;
            picture.height = source.height;
        }
    }
    if (!picture.channels.empty()) writeExr(numbered(folder, "denoised", frameIndex, "exr"), picture);
}

void writeComposedPng(const std::filesystem::path& folder, const char* stem, size_t frameIndex, const Picture& composed)
{
    if (composed.exists()) writePng(numbered(folder, stem, frameIndex, "png"), interleaved(composed));
}

void writeOverlayPng(const std::filesystem::path& folder, size_t frameIndex, const Picture& overlay,
                     const Picture& composed)
{
    Image image = composed.exists() ? interleaved(composed) : Image(overlay.width, overlay.height);
    for (size_t i = 0; i < overlay.pixelCount(); i++)
    {
        const float alpha = overlay.planes[3][i];
        for (size_t c = 0; c < 3; c++)
        {
            float& value = image.rgba[i * 4 + c];
            value = alpha * overlay.planes[c][i] + (1.0f - alpha) * toneMap(value);
        }
    }
    writeEncodedPng(numbered(folder, "validation", frameIndex, "png"), image);
}
} // namespace sample
