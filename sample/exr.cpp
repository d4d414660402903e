#include "exr.h"
#include "image_io.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfCompression.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfTestFile.h>
#include <OpenEXR/ImfThreading.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <new>
#include <thread>

namespace sample
{
namespace
{
constexpr float kHalfMax = 65504.0f;

// Limits must be known before the library allocates for a broken header; it decodes on no threads unless told to.
void configureLibrary()
{
    static std::once_flag once;
    const auto configure = []
    {
        Imf::Header::setMaxImageSize(kMaxExrSize, kMaxExrSize);
        Imf::setGlobalThreadCount(static_cast<int>(std::thread::hardware_concurrency()));
    };
    std::call_once(once, configure);
}

// Turns whatever the library throws into the one sentence callers expect.
template <class F> auto guarded(const std::filesystem::path& file, const char* verb, F&& body)
{
    configureLibrary();
    try
    {
        return body();
    }
    catch (const FileError&)
    {
        throw;
    }
    catch (const std::bad_alloc&)
    {
        throw FileError(file.string() + " cannot be " + verb + ": out of memory");
    }
    catch (const std::exception& e)
    {
        std::string reason = e.what();
        std::replace(reason.begin(), reason.end(), '\n', ' ');
        throw FileError(file.string() + " cannot be " + verb + ": " + reason);
    }
}

bool isLossless(Imf::Compression compression)
{
    return compression == Imf::NO_COMPRESSION || compression == Imf::RLE_COMPRESSION ||
           compression == Imf::ZIPS_COMPRESSION || compression == Imf::ZIP_COMPRESSION ||
           compression == Imf::PIZ_COMPRESSION;
}

void checkKind(const std::filesystem::path& file)
{
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) throw FileError(file.string() + " does not exist");
    bool isTiled = false;
    bool isDeep = false;
    bool isMultiPart = false;
    if (!Imf::isOpenExrFile(file.c_str(), isTiled, isDeep, isMultiPart))
        throw FileError(file.string() + " is not an OpenEXR file");
    if (isDeep) throw FileError(file.string() + " holds deep data, which is not supported");
    if (isMultiPart) throw FileError(file.string() + " has several parts, which is not supported");
}

ExrHeader describe(const std::filesystem::path& file, const Imf::InputFile& input)
{
    const Imath::Box2i window = input.header().dataWindow();
    const int64_t width = int64_t(window.max.x) - window.min.x + 1;
    const int64_t height = int64_t(window.max.y) - window.min.y + 1;
    const std::string size = std::to_string(width) + " x " + std::to_string(height);
    if (width < 1 || height < 1 || width > kMaxExrSize || height > kMaxExrSize || width * height > kMaxExrPixels)
        throw FileError(file.string() + " has " + size + " pixels, which is out of range");
    if (!input.isComplete()) throw FileError(file.string() + " is truncated: lines of the picture are missing");
    ExrHeader header;
    header.width = static_cast<int>(width);
    header.height = static_cast<int>(height);
    header.isLossless = isLossless(input.header().compression());
    const Imf::ChannelList& channels = input.header().channels();
    for (auto it = channels.begin(); it != channels.end(); ++it) header.channelNames.emplace_back(it.name());
    return header;
}

ExrChannel makeChannel(const std::filesystem::path& file, const std::string& name, const Imf::Channel& source,
                       size_t pixelCount)
{
    if (source.xSampling != 1 || source.ySampling != 1)
        throw FileError(file.string() + ", channel " + name + " is subsampled, which is not supported");
    if (source.type != Imf::HALF && source.type != Imf::FLOAT)
        throw FileError(file.string() + ", channel " + name + " is neither half nor float");
    ExrChannel channel;
    channel.name = name;
    channel.type = source.type == Imf::HALF ? ExrType::Half : ExrType::Float;
    channel.values.resize(pixelCount);
    return channel;
}

std::vector<half> toHalf(const std::vector<float>& values)
{
    std::vector<half> result(values.size());
    for (size_t i = 0; i < values.size(); i++)
    {
        const float v = values[i];
        result[i] = half(std::isfinite(v) ? std::clamp(v, -kHalfMax, kHalfMax) : v);
    }
    return result;
}
ExrPicture readPixels(const std::filesystem::path& file)
{
    checkKind(file);
    Imf::InputFile input(file.c_str());
    const ExrHeader header = describe(file, input);
    const Imath::Box2i window = input.header().dataWindow();
    ExrPicture picture;
    picture.width = header.width;
    picture.height = header.height;
    const size_t pixelCount = static_cast<size_t>(header.width) * static_cast<size_t>(header.height);
    for (const std::string& name : header.channelNames)
        picture.channels.push_back(makeChannel(file, name, input.header().channels()[name.c_str()], pixelCount));
    Imf::FrameBuffer buffer;
    for (ExrChannel& channel : picture.channels)
        buffer.insert(channel.name, Imf::Slice::Make(Imf::FLOAT, channel.values.data(), window));
    input.setFrameBuffer(buffer);
    input.readPixels(window.min.y, window.max.y);
    return picture;
}

void writePixels(const std::filesystem::path& file, const ExrPicture& picture)
{
    Imf::Header header(picture.width, picture.height);
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::FrameBuffer buffer;
    std::vector<std::vector<half>> halves; // alive until the pixels are written
    halves.reserve(picture.channels.size());
    for (const ExrChannel& channel : picture.channels)
    {
        const bool isHalf = channel.type == ExrType::Half;
        const Imf::PixelType type = isHalf ? Imf::HALF : Imf::FLOAT;
        const void* data = channel.values.data();
        if (isHalf) data = halves.emplace_back(toHalf(channel.values)).data();
        header.channels().insert(channel.name, Imf::Channel(type));
        buffer.insert(channel.name, Imf::Slice::Make(type, data, header.dataWindow()));
    }
    Imf::OutputFile output(file.c_str(), header);
    output.setFrameBuffer(buffer);
    output.writePixels(picture.height);
}
} // namespace

const ExrChannel* ExrPicture::find(std::string_view name) const
{
    for (const ExrChannel& channel : channels)
        if (channel.name == name) return &channel;
    return nullptr;
}

ExrHeader readExrHeader(const std::filesystem::path& file)
{
    const auto read = [&]
    {
        checkKind(file);
        return describe(file, Imf::InputFile(file.c_str()));
    };
    return guarded(file, "read", read);
}

ExrPicture readExr(const std::filesystem::path& file)
{
    return guarded(file, "read", [&] { return readPixels(file); });
}

void writeExr(const std::filesystem::path& file, const ExrPicture& picture)
{
    guarded(file, "written", [&] { writePixels(file, picture); });
}
} // namespace sample
