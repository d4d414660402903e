// Captures: one recorded run of a renderer, a folder of capture.json, frame_NNNN.exr and reference_NNNN.exr.
// Reading checks everything first; what fails is a FileError: one sentence with the file, the channel and the pixel.
#pragma once
#include "image_io.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace sample
{
using Matrix = std::array<double, 16>; // column-major, for column vectors

// Every channel of the format; rows of the table channelInfo() answers from. X, Y, Z (R, G, B) follow each other.
enum class Channel : uint8_t
{
    // clang-format off
    // frame_NNNN.exr
    ViewZ,
    NormalX, NormalY, NormalZ,
    Roughness, MaterialId,
    MotionX, MotionY, MotionZ,
    DiffuseR, DiffuseG, DiffuseB, DiffuseHitDist, DiffuseDX, DiffuseDY, DiffuseDZ,
    SpecularR, SpecularG, SpecularB, SpecularHitDist, SpecularDX, SpecularDY, SpecularDZ,
    SpecularMX, SpecularMY, SpecularMZ,
    ShadowDist, ShadowR, ShadowG, ShadowB,
    DiffuseFactorR, DiffuseFactorG, DiffuseFactorB,
    SpecularFactorR, SpecularFactorG, SpecularFactorB,
    SunR, SunG, SunB,
    DirectR, DirectG, DirectB,
    // reference_NNNN.exr
    RefDiffuseR, RefDiffuseG, RefDiffuseB, RefDiffuseNormHitDist,
    RefSpecularR, RefSpecularG, RefSpecularB, RefSpecularNormHitDist,
    RefShadowV, RefShadowR, RefShadowG, RefShadowB,
    RefComposedR, RefComposedG, RefComposedB,
    Count
    // clang-format on
};
inline constexpr size_t kChannelCount = static_cast<size_t>(Channel::Count);
inline constexpr float kHitDistMiss = 65504.0f; // a ray that hit nothing

struct ChannelInfo
{
    Channel channel;
    const char* name; // "diffuse.R"; the part before the dot is the layer
    bool isReference; // in reference_NNNN.exr
    bool isFloat;     // stored as float, else as half
    bool isGuide;     // must be finite in every pixel
    bool isOptional;  // may be absent from its layer
};
const ChannelInfo& channelInfo(Channel channel);

// The channel `offset` places after the given one: next(NormalX, 2) is NormalZ.
constexpr Channel next(Channel channel, int offset) { return static_cast<Channel>(static_cast<int>(channel) + offset); }

// Channels of one frame or one reference, row 0 on top; a channel that was not recorded is empty.
struct Planes
{
    int width = 0;
    int height = 0;
    std::array<std::vector<float>, kChannelCount> values;

    Planes() = default;
    Planes(int w, int h) : width(w), height(h) {}
    size_t pixelCount() const { return static_cast<size_t>(width) * static_cast<size_t>(height); }
    bool has(Channel c) const { return !values[static_cast<size_t>(c)].empty(); }
    const std::vector<float>& operator[](Channel c) const { return values[static_cast<size_t>(c)]; }
    std::vector<float>& operator[](Channel c) { return values[static_cast<size_t>(c)]; }

    // Copies the first `count` (1 to 4) components of an RGBA picture of the same size to `count` consecutive channels.
    void set(Channel first, const Image& source, int count, int firstComponent = 0);
};

// The light the shadow layer belongs to.
struct CaptureLight
{
    bool isLocal = false;
    std::array<double, 3> direction = {0.0, 1.0, 0.0}; // unit, world space, surface to light; not for local lights
    double tanAngularRadius = 0.0;                     // >= 0, tangent of the angular radius; not for local lights
    std::array<double, 3> position = {};               // world space; local lights only
    double radius = 0.0;                               // > 0, world units; local lights only
    bool operator==(const CaptureLight&) const = default;
};

struct CaptureFrame
{
    std::string frame;                 // file name in the folder
    std::string reference;             // file name in the folder, empty: none
    double deltaTimeMs = 16.667;       // >= 0, milliseconds since the frame before
    std::array<double, 2> jitter = {}; // [-0.5; 0.5], pixels
    bool isCut = false;                // no history; always true for frame 0
    Matrix viewToClip = {};            // without jitter, depth in [0; 1]
    Matrix worldToView = {};           // rigid
    std::optional<CaptureLight> light; // where it differs from the capture's
};

// Which pixels have the samples of the diffuse lobe, when each lobe was traced in every second pixel; specular has the
// others. Black: those whose x + y + frame is even.
enum class CaptureCheckerboard : uint8_t
{
    Off,
    Black,
    White
};

struct CaptureInfo
{
    std::string name;
    int width = 0;                                                       // pixels
    int height = 0;                                                      // pixels
    double metersPerUnit = 1.0;                                          // > 0
    double denoisingRange = 1000.0;                                      // > 0, world units; sky is beyond it
    std::array<double, 4> hitDistanceParameters = {3.0, 0.1, 20.0, -25}; // A (world units), B, C, D
    CaptureCheckerboard checkerboard = CaptureCheckerboard::Off;
    std::optional<CaptureLight> light;
    std::vector<CaptureFrame> frames;
};

// A capture on disk. open() reads capture.json and the head of every file; pixels are read frame by frame.
class Capture
{
public:
    // Throws FileError for whatever capture-format's "Reading one" names, pixels excepted.
    static Capture open(const std::filesystem::path& folder);

    const CaptureInfo& info() const { return m_info; }
    // True when every frame holds the channel (frames cannot differ), for reference channels every reference.
    bool has(Channel channel) const { return m_has[static_cast<size_t>(channel)]; }
    // The light of a frame; null when the capture has none.
    const CaptureLight* light(size_t frameIndex) const;

    // Reads one frame; throws FileError, also for a guide that holds a NaN or an infinity.
    Planes readFrame(size_t frameIndex) const;
    // Reads the reference of a frame that has one; throws FileError.
    Planes readReference(size_t frameIndex) const;

private:
    Planes read(const std::string& name, bool isReference) const;

    std::filesystem::path m_folder;
    CaptureInfo m_info;
    std::array<bool, kChannelCount> m_has = {};
};

// Writes a capture: frames in order, references for any frame already added, then finish().
class CaptureWriter
{
public:
    // Creates the folder. `info` is complete but for its frames. Throws FileError.
    CaptureWriter(std::filesystem::path folder, CaptureInfo info);

    // Adds a frame; the file names in `frame` are set here. Throws FileError, also for half a layer, planes of another
    // size and guides that are not finite: what is written can be read.
    void addFrame(CaptureFrame frame, const Planes& planes);
    // Adds the reference of frame `frameIndex`. Throws FileError.
    void addReference(size_t frameIndex, const Planes& planes);
    // Writes capture.json; without it the folder is no capture. Throws FileError.
    void finish();

private:
    std::string write(const char* stem, size_t frameIndex, const Planes& planes, bool isReference);

    std::filesystem::path m_folder;
    CaptureInfo m_info;
};
} // namespace sample
