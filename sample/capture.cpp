#include "capture.h"
#include "capture_json.h"
#include "exr.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string_view>

namespace sample
{
namespace
{
// clang-format off
constexpr ChannelInfo kChannels[] = {
    //                                                              reference float  guide  optional
    {Channel::ViewZ,                  "viewZ",                      false, true,  true,  false},
    {Channel::NormalX,                "normal.X",                   false, false, true,  false},
    {Channel::NormalY,                "normal.Y",                   false, false, true,  false},
    {Channel::NormalZ,                "normal.Z",                   false, false, true,  false},
    {Channel::Roughness,              "roughness",                  false, false, true,  false},
    {Channel::MaterialId,             "materialID",                 false, false, false, false},
    {Channel::MotionX,                "motion.X",                   false, true,  true,  false},
    {Channel::MotionY,                "motion.Y",                   false, true,  true,  false},
    {Channel::MotionZ,                "motion.Z",                   false, true,  true,  false},
    {Channel::DiffuseR,               "diffuse.R",                  false, false, false, false},
    {Channel::DiffuseG,               "diffuse.G",                  false, false, false, false},
    {Channel::DiffuseB,               "diffuse.B",                  false, false, false, false},
    {Channel::DiffuseHitDist,         "diffuse.hitDist",            false, false, false, false},
    {Channel::DiffuseDX,              "diffuse.DX",                 false, false, false, false},
    {Channel::DiffuseDY,              "diffuse.DY",                 false, false, false, false},
    {Channel::DiffuseDZ,              "diffuse.DZ",                 false, false, false, false},
    {Channel::SpecularR,              "specular.R",                 false, false, false, false},
    {Channel::SpecularG,              "specular.G",                 false, false, false, false},
    {Channel::SpecularB,              "specular.B",                 false, false, false, false},
    {Channel::SpecularHitDist,        "specular.hitDist",           false, false, false, false},
    {Channel::SpecularDX,             "specular.DX",                false, false, false, false},
    {Channel::SpecularDY,             "specular.DY",                false, false, false, false},
    {Channel::SpecularDZ,             "specular.DZ",                false, false, false, false},
    {Channel::SpecularMX,             "specular.MX",                false, true,  false, true},
    {Channel::SpecularMY,             "specular.MY",                false, true,  false, true},
    {Channel::SpecularMZ,             "specular.MZ",                false, true,  false, true},
    {Channel::ShadowDist,             "shadow.dist",                false, false, false, false},
    {Channel::ShadowR,                "shadow.R",                   false, false, false, false},
    {Channel::ShadowG,                "shadow.G",                   false, false, false, false},
    {Channel::ShadowB,                "shadow.B",                   false, false, false, false},
    {Channel::DiffuseFactorR,         "diffuseFactor.R",            false, false, false, false},
    {Channel::DiffuseFactorG,         "diffuseFactor.G",            false, false, false, false},
    {Channel::DiffuseFactorB,         "diffuseFactor.B",            false, false, false, false},
    {Channel::SpecularFactorR,        "specularFactor.R",           false, false, false, false},
    {Channel::SpecularFactorG,        "specularFactor.G",           false, false, false, false},
    {Channel::SpecularFactorB,        "specularFactor.B",           false, false, false, false},
    {Channel::SunR,                   "sun.R",                      false, false, false, false},
    {Channel::SunG,                   "sun.G",                      false, false, false, false},
    {Channel::SunB,                   "sun.B",                      false, false, false, false},
    {Channel::DirectR,                "direct.R",                   false, false, false, false},
    {Channel::DirectG,                "direct.G",                   false, false, false, false},
    {Channel::DirectB,                "direct.B",                   false, false, false, false},
    {Channel::RefDiffuseR,            "diffuse.R",                  true,  true,  false, false},
    {Channel::RefDiffuseG,            "diffuse.G",                  true,  true,  false, false},
    {Channel::RefDiffuseB,            "diffuse.B",                  true,  true,  false, false},
    {Channel::RefDiffuseNormHitDist,  "diffuse.normHitDist",        true,  true,  false, false},
    {Channel::RefSpecularR,           "specular.R",                 true,  true,  false, false},
    {Channel::RefSpecularG,           "specular.G",                 true,  true,  false, false},
    {Channel::RefSpecularB,           "specular.B",                 true,  true,  false, false},
    {Channel::RefSpecularNormHitDist, "specular.normHitDist",       true,  true,  false, true},
    {Channel::RefShadowV,             "shadow.V",                   true,  true,  false, false},
    {Channel::RefShadowR,             "shadow.R",                   true,  true,  false, false},
    {Channel::RefShadowG,             "shadow.G",                   true,  true,  false, false},
    {Channel::RefShadowB,             "shadow.B",                   true,  true,  false, false},
    {Channel::RefComposedR,           "composed.R",                 true,  true,  false, false},
    {Channel::RefComposedG,           "composed.G",                 true,  true,  false, false},
    {Channel::RefComposedB,           "composed.B",                 true,  true,  false, false},
};
// clang-format on

constexpr bool rowsMatchKeys()
{
    for (size_t i = 0; i < std::size(kChannels); i++)
        if (static_cast<size_t>(kChannels[i].channel) != i) return false;
    return std::size(kChannels) == kChannelCount;
}
static_assert(rowsMatchKeys()); // row i describes channel i

std::string_view layerOf(const ChannelInfo& info)
{
    const std::string_view name = info.name;
    return name.substr(0, name.find('.'));
}

using ChannelSet = std::array<bool, kChannelCount>;

// Throws when a layer of the file is there in part.
void checkLayers(const std::filesystem::path& file, const ChannelSet& present, bool isReference)
{
    for (const ChannelInfo& missing : kChannels)
    {
        const bool isPresent = present[static_cast<size_t>(missing.channel)];
        if (missing.isReference != isReference || missing.isOptional || isPresent) continue;
        for (const ChannelInfo& other : kChannels)
        {
            const bool isSameLayer = other.isReference == isReference && layerOf(other) == layerOf(missing);
            if (isSameLayer && present[static_cast<size_t>(other.channel)])
                throw FileError(file.string() + " has no channel " + missing.name + ", though it has " + other.name);
        }
    }
    if (!isReference && !present[static_cast<size_t>(Channel::ViewZ)])
        throw FileError(file.string() + " has no channel viewZ");
}

std::string sizeText(int width, int height) { return std::to_string(width) + " x " + std::to_string(height); }

void checkSize(const std::filesystem::path& file, int width, int height, const CaptureInfo& info)
{
    if (width != info.width || height != info.height)
        throw FileError(file.string() + " has " + sizeText(width, height) + " pixels, but the capture states " +
                        sizeText(info.width, info.height));
}

// The channels of a file, checked by its head alone.
ChannelSet checkFile(const std::filesystem::path& file, const CaptureInfo& info, bool isReference)
{
    const ExrHeader header = readExrHeader(file);
    checkSize(file, header.width, header.height, info);
    if (!header.isLossless) throw FileError(file.string() + " uses a lossy compression; a capture must be lossless");
    ChannelSet present = {};
    for (const ChannelInfo& row : kChannels)
        if (row.isReference == isReference)
            present[static_cast<size_t>(row.channel)] =
                std::find(header.channelNames.begin(), header.channelNames.end(), row.name) !=
                header.channelNames.end();
    checkLayers(file, present, isReference);
    return present;
}

// The first file of a kind, which the others are held against.
struct Baseline
{
    std::filesystem::path file;
    ChannelSet present = {};
};

// Throws when two files of a kind hold different channels: a denoiser cannot change its inputs on the way.
void checkSame(const std::filesystem::path& file, const ChannelSet& present, Baseline& first)
{
    if (first.file.empty()) first = {file, present};
    for (const ChannelInfo& row : kChannels)
    {
        const size_t c = static_cast<size_t>(row.channel);
        if (present[c] == first.present[c]) continue;
        const std::filesystem::path& with = present[c] ? file : first.file;
        const std::filesystem::path& without = present[c] ? first.file : file;
        throw FileError(without.string() + " has no channel " + row.name + ", though " + with.filename().string() +
                        " has it");
    }
}

void checkGuides(const std::filesystem::path& file, const Planes& planes)
{
    for (const ChannelInfo& row : kChannels)
    {
        if (!row.isGuide || !planes.has(row.channel)) continue;
        const std::vector<float>& values = planes[row.channel];
        const auto bad = std::find_if(values.begin(), values.end(), [](float v) { return !std::isfinite(v); });
        if (bad == values.end()) continue;
        const int index = static_cast<int>(bad - values.begin());
        throw FileError(file.string() + ", channel " + row.name + " is " + (std::isnan(*bad) ? "NaN" : "infinite") +
                        " at pixel (" + std::to_string(index % planes.width) + ", " +
                        std::to_string(index / planes.width) + ")");
    }
}
} // namespace

const ChannelInfo& channelInfo(Channel channel) { return kChannels[static_cast<size_t>(channel)]; }

void Planes::set(Channel first, const Image& source, int count, int firstComponent)
{
    for (int c = 0; c < count; c++)
    {
        std::vector<float>& plane = (*this)[next(first, c)];
        plane.resize(pixelCount());
        for (size_t i = 0; i < plane.size(); i++)
            plane[i] = source.rgba[i * 4 + static_cast<size_t>(firstComponent + c)];
    }
}

Capture Capture::open(const std::filesystem::path& folder)
{
    std::error_code error;
    if (!std::filesystem::is_directory(folder, error)) throw FileError(folder.string() + " is not a folder");
    Capture capture;
    capture.m_folder = folder;
    capture.m_info = readCaptureInfo(folder / "capture.json");
    Baseline frames;
    Baseline references;
    for (const CaptureFrame& frame : capture.m_info.frames)
    {
        checkSame(folder / frame.frame, checkFile(folder / frame.frame, capture.m_info, false), frames);
        if (frame.reference.empty()) continue;
        checkSame(folder / frame.reference, checkFile(folder / frame.reference, capture.m_info, true), references);
    }
    for (size_t c = 0; c < kChannelCount; c++) capture.m_has[c] = frames.present[c] || references.present[c];
    for (size_t i = 0; i < capture.m_info.frames.size(); i++)
        if (capture.has(Channel::ShadowDist) && !capture.light(i))
            throw FileError((folder / "capture.json").string() + ": light is missing, though the frames have the " +
                            "layer shadow");
    return capture;
}

const CaptureLight* lightOf(const CaptureInfo& info, size_t frameIndex)
{
    const CaptureFrame& frame = info.frames.at(frameIndex);
    if (frame.light) return &*frame.light;
    return info.light ? &*info.light : nullptr;
}

Planes Capture::readFrame(size_t frameIndex) const { return read(m_info.frames.at(frameIndex).frame, false); }

Planes Capture::readReference(size_t frameIndex) const { return read(m_info.frames.at(frameIndex).reference, true); }

Planes Capture::read(const std::string& name, bool isReference) const
{
    const std::filesystem::path file = m_folder / name;
    ExrPicture picture = readExr(file);
    checkSize(file, picture.width, picture.height, m_info); // the file may have changed since open()
    Planes planes(picture.width, picture.height);
    for (ExrChannel& channel : picture.channels)
        for (const ChannelInfo& row : kChannels)
            if (row.isReference == isReference && channel.name == row.name)
                planes[row.channel] = std::move(channel.values);
    for (const ChannelInfo& row : kChannels)
        if (row.isReference == isReference && has(row.channel) && !planes.has(row.channel))
            throw FileError(file.string() + " has no channel " + row.name);
    checkGuides(file, planes);
    return planes;
}

CaptureWriter::CaptureWriter(std::filesystem::path folder, CaptureInfo info)
    : m_folder(std::move(folder)), m_info(std::move(info))
{
    m_info.frames.clear();
    std::error_code error;
    std::filesystem::create_directories(m_folder, error);
    if (error) throw FileError(m_folder.string() + " cannot be created: " + error.message());
    std::filesystem::remove(m_folder / "capture.json", error); // an older capture is gone from the first frame on
}

std::string CaptureWriter::write(const char* stem, size_t frameIndex, const Planes& planes, bool isReference)
{
    char name[48];
    std::snprintf(name, sizeof(name), "%s_%04zu.exr", stem, frameIndex);
    const std::filesystem::path file = m_folder / name;
    checkSize(file, planes.width, planes.height, m_info);
    ChannelSet present = {};
    ExrPicture picture{planes.width, planes.height, {}};
    for (const ChannelInfo& row : kChannels)
    {
        if (row.isReference != isReference || !planes.has(row.channel)) continue;
        present[static_cast<size_t>(row.channel)] = true;
        if (planes[row.channel].size() != planes.pixelCount())
            throw FileError(file.string() + ", channel " + row.name + " has a wrong number of pixels");
        picture.channels.push_back({row.name, row.isFloat ? ExrType::Float : ExrType::Half, planes[row.channel]});
    }
    checkLayers(file, present, isReference);
    checkGuides(file, planes);
    writeExr(file, picture);
    return name;
}

void CaptureWriter::addFrame(CaptureFrame frame, const Planes& planes)
{
    frame.frame = write("frame", m_info.frames.size(), planes, false);
    frame.reference.clear();
    if (m_info.frames.empty()) frame.isCut = true;
    m_info.frames.push_back(std::move(frame));
}

void CaptureWriter::addReference(size_t frameIndex, const Planes& planes)
{
    m_info.frames.at(frameIndex).reference = write("reference", frameIndex, planes, true);
}

void CaptureWriter::finish()
{
    // Renamed into place, so that a capture.json is always whole.
    const std::filesystem::path file = m_folder / "capture.json";
    const std::filesystem::path part = m_folder / "capture.json.part";
    writeCaptureInfo(part, m_info);
    std::error_code error;
    std::filesystem::rename(part, file, error);
    if (error) throw FileError(file.string() + " cannot be written: " + error.message());
}
} // namespace sample
