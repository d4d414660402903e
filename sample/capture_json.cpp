#include "capture_json.h"
#include "exr.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>

namespace sample
{
namespace
{
using Json = nlohmann::json;

constexpr const char* kFormat = "nrd-capture";
constexpr int kVersion = 1;
constexpr size_t kMaxFrames = 100000;

// A JSON object with the path that leads to it ("frames[3]"), for the error texts.
struct Node
{
    const std::filesystem::path& file;
    const Json& json;
    std::string path;

    std::string keyPath(const std::string& key) const { return path.empty() ? key : path + "." + key; }

    [[noreturn]] void fail(const std::string& key, const std::string& expected) const
    {
        const auto found = json.find(key);
        std::string text = file.string() + ": " + keyPath(key);
        if (found == json.end())
            text += " is missing";
        else
            text += " is " + found->dump(-1, ' ', false, Json::error_handler_t::replace).substr(0, 60);
        throw FileError(text + "; expected " + expected);
    }
    bool has(const std::string& key) const { return json.contains(key); }

    double number(const std::string& key, double low, double high, const std::string& expected) const
    {
        const auto found = json.find(key);
        if (found == json.end() || !found->is_number()) fail(key, expected);
        const double value = found->get<double>();
        if (!(value >= low && value <= high)) fail(key, expected);
        return value;
    }
    template <size_t N>
    std::array<double, N> numbers(const std::string& key, double limit, const std::string& expected) const
    {
        const auto found = json.find(key);
        if (found == json.end() || !found->is_array() || found->size() != N) fail(key, expected);
        std::array<double, N> values = {};
        for (size_t i = 0; i < N; i++)
        {
            if (!(*found)[i].is_number()) fail(key, expected);
            values[i] = (*found)[i].template get<double>();
            if (!(std::abs(values[i]) <= limit)) fail(key, expected);
        }
        return values;
    }
    std::string text(const std::string& key, const std::string& expected) const
    {
        const auto found = json.find(key);
        if (found == json.end() || !found->is_string()) fail(key, expected);
        return found->get<std::string>();
    }
    // A plain file name: a capture is one folder, and a bug report from elsewhere must not reach beyond it.
    std::string fileName(const std::string& key) const
    {
        const std::string name = text(key, "a file name");
        if (name.empty() || name.find_first_of("/\\") != std::string::npos) fail(key, "a file name without a folder");
        return name;
    }
};

constexpr double kHuge = std::numeric_limits<float>::max(); // everything ends up in floats on the device

std::optional<CaptureLight> parseLight(const Node& owner)
{
    if (!owner.has("light")) return std::nullopt;
    const Json& json = owner.json["light"];
    if (!json.is_object()) owner.fail("light", "an object");
    const Node node{owner.file, json, owner.keyPath("light")};
    CaptureLight light;
    light.isLocal = node.has("position");
    if (light.isLocal)
    {
        light.position = node.numbers<3>("position", kHuge, "three finite numbers");
        light.radius = node.number("radius", std::numeric_limits<float>::min(), kHuge, "a number above 0");
        return light;
    }
    light.direction = node.numbers<3>("direction", kHuge, "three finite numbers");
    const auto& d = light.direction;
    const double length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    if (!(length > 1e-20 && length < kHuge)) node.fail("direction", "a direction that is not zero");
    for (double& x : light.direction) x /= length;
    light.tanAngularRadius = node.number("tanAngularRadius", 0.0, kHuge, "a number of at least 0");
    return light;
}

constexpr const char* kCheckerboards[] = {"off", "black", "white"}; // in the order of CaptureCheckerboard

CaptureCheckerboard parseCheckerboard(const Node& root)
{
    constexpr const char* kKey = "checkerboard";
    if (!root.has(kKey)) return CaptureCheckerboard::Off;
    const std::string expected = "\"off\", \"black\" or \"white\"";
    const std::string name = root.text(kKey, expected);
    for (size_t i = 0; i < std::size(kCheckerboards); i++)
        if (name == kCheckerboards[i]) return static_cast<CaptureCheckerboard>(i);
    root.fail(kKey, expected);
}

CaptureFrame parseFrame(const Node& node, bool isFirst)
{
    CaptureFrame frame;
    frame.frame = node.fileName("frame");
    if (node.has("reference")) frame.reference = node.fileName("reference");
    frame.deltaTimeMs = node.number("deltaTimeMs", 0.0, 1e6, "milliseconds in [0; 1000000]");
    frame.jitter = node.numbers<2>("jitter", 0.5, "two numbers in [-0.5; 0.5]");
    const auto cut = node.json.find("cut");
    if (cut == node.json.end() || !cut->is_boolean()) node.fail("cut", "true or false");
    frame.isCut = cut->get<bool>();
    if (isFirst && !frame.isCut) node.fail("cut", "true, since frame 0 has no history");
    frame.viewToClip = node.numbers<16>("viewToClip", kHuge, "16 finite numbers");
    frame.worldToView = node.numbers<16>("worldToView", kHuge, "16 finite numbers");
    frame.light = parseLight(node);
    return frame;
}

void parseFrames(const Node& root, CaptureInfo& info)
{
    const auto frames = root.json.find("frames");
    if (frames == root.json.end() || !frames->is_array() || frames->empty() || frames->size() > kMaxFrames)
        root.fail("frames", "a list of 1 to 100000 frames");
    for (size_t i = 0; i < frames->size(); i++)
    {
        const std::string path = "frames[" + std::to_string(i) + "]";
        if (!(*frames)[i].is_object()) throw FileError(root.file.string() + ": " + path + " is not an object");
        info.frames.push_back(parseFrame(Node{root.file, (*frames)[i], path}, i == 0));
    }
}

CaptureInfo parseInfo(const std::filesystem::path& file, const Json& json)
{
    if (!json.is_object()) throw FileError(file.string() + " is not a JSON object");
    const Node root{file, json, ""};
    if (root.text("format", "\"nrd-capture\"") != kFormat) root.fail("format", "\"nrd-capture\"");
    if (root.number("version", -kHuge, kHuge, "1") != kVersion) root.fail("version", "1");
    CaptureInfo info;
    info.name = root.text("name", "a text");
    const std::string sizes = "two whole numbers in [1; " + std::to_string(kMaxExrSize) + "]";
    const std::array<double, 2> size = root.numbers<2>("resolution", kMaxExrSize, sizes);
    for (double s : size)
        if (s < 1.0 || s != std::floor(s)) root.fail("resolution", sizes);
    info.width = static_cast<int>(size[0]);
    info.height = static_cast<int>(size[1]);
    const double tiny = std::numeric_limits<float>::min();
    if (root.has("metersPerUnit")) info.metersPerUnit = root.number("metersPerUnit", tiny, kHuge, "a number above 0");
    info.denoisingRange = root.number("denoisingRange", tiny, kHuge, "a number above 0");
    info.hitDistanceParameters = root.numbers<4>("hitDistanceParameters", kHuge, "four finite numbers");
    if (!(info.hitDistanceParameters[0] > 0.0) || info.hitDistanceParameters[1] < 0.0)
        root.fail("hitDistanceParameters", "A above 0 and B of at least 0");
    info.checkerboard = parseCheckerboard(root);
    info.light = parseLight(root);
    parseFrames(root, info);
    return info;
}

Json toJson(const CaptureLight& light)
{
    if (light.isLocal) return {{"position", light.position}, {"radius", light.radius}};
    return {{"direction", light.direction}, {"tanAngularRadius", light.tanAngularRadius}};
}

Json toJson(const CaptureFrame& frame)
{
    Json json = {{"frame", frame.frame}, {"deltaTimeMs", frame.deltaTimeMs}, {"jitter", frame.jitter},
                 {"cut", frame.isCut},   {"viewToClip", frame.viewToClip},   {"worldToView", frame.worldToView}};
    if (!frame.reference.empty()) json["reference"] = frame.reference;
    if (frame.light) json["light"] = toJson(*frame.light);
    return json;
}
} // namespace

CaptureInfo readCaptureInfo(const std::filesystem::path& file)
{
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) throw FileError(file.string() + " does not exist");
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw FileError(file.string() + " cannot be opened");
    Json json;
    try
    {
        json = Json::parse(stream);
    }
    catch (const Json::exception& e)
    {
        throw FileError(file.string() + " is not valid JSON: " + e.what());
    }
    return parseInfo(file, json);
}

void writeCaptureInfo(const std::filesystem::path& file, const CaptureInfo& info)
{
    Json json = {{"format", kFormat},
                 {"version", kVersion},
                 {"name", info.name},
                 {"resolution", {info.width, info.height}},
                 {"metersPerUnit", info.metersPerUnit},
                 {"denoisingRange", info.denoisingRange},
                 {"hitDistanceParameters", info.hitDistanceParameters},
                 {"frames", Json::array()}};
    if (info.checkerboard != CaptureCheckerboard::Off)
        json["checkerboard"] = kCheckerboards[static_cast<size_t>(info.checkerboard)];
    if (info.light) json["light"] = toJson(*info.light);
    for (const CaptureFrame& frame : info.frames) json["frames"].push_back(toJson(frame));
    std::ofstream stream(file, std::ios::binary);
    stream << json.dump(1, ' ', false, Json::error_handler_t::replace) << '\n';
    if (!stream.flush()) throw FileError(file.string() + " cannot be written");
}
} // namespace sample
