#include "capture_json.h"
#include "../refusal.h"
#include <charconv>
#include <cstdio>
#include <memory>

namespace nrd::dump
{
namespace
{
constexpr double kDefaultFrameTime = 16.667; // ms, where the library measures
constexpr float kD = -25.0f;                 // the format's fourth hit-distance parameter, which is always this

std::string quoted(const std::string& text)
{
    std::string result = "\"";
    for (const char c : text)
    {
        if (c == '"' || c == '\\') result += '\\';
        result += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
    return result + '"';
}

// Shortest that reads back as it was, whatever the application's locale.
template <class T> std::string number(T value)
{
    char text[64];
    return {text, std::to_chars(text, text + sizeof(text), value).ptr};
}

std::string list(const float* values, size_t count)
{
    std::string result;
    for (size_t i = 0; i < count; i++) result += (i ? ", " : "[") + number(values[i]);
    return result + "]";
}

std::string direction(const SigmaSettings& light)
{
    const float* const d = light.lightDirection;
    const float up[3] = {0.0f, 1.0f, 0.0f};
    const bool isKnown = !light.isLightLocal && (d[0] != 0.0f || d[1] != 0.0f || d[2] != 0.0f);
    return list(isKnown ? d : up, 3);
}

// IN_PENUMBRA has the light's size in it already: with a tangent of 1 it is a distance.
std::string lightOf(const FrameContext& frame)
{
    return sentence("\"light\": {\"direction\": %s, \"tanAngularRadius\": 1}", direction(frame.light).c_str());
}

std::string frameEntry(const std::vector<FrameContext>& frames, size_t index)
{
    const FrameContext& frame = frames[index];
    const CommonSettings& common = frame.common;
    const bool isCut = index == 0 || common.accumulationMode != AccumulationMode::CONTINUE;
    const double time =
        common.timeDeltaBetweenFrames > 0.0f ? double(common.timeDeltaBetweenFrames) : kDefaultFrameTime;
    std::string text = "  {\"frame\": " + quoted(frameFileName(index)) + ", \"deltaTimeMs\": " + number(time);
    text += std::string(", \"cut\": ") + (isCut ? "true" : "false");
    text += ", \"jitter\": " + list(common.cameraJitter, 2);
    text += ",\n   \"viewToClip\": " + list(common.viewToClipMatrix, 16);
    text += ",\n   \"worldToView\": " + list(common.worldToViewMatrix, 16);
    if (frame.hasLight) text += ",\n   " + lightOf(frame);
    return text + "}";
}

std::string document(const std::string& name, const std::vector<FrameContext>& frames,
                     const std::vector<std::string>& notes)
{
    const CommonSettings& common = frames[0].common;
    const HitDistanceParameters& hit = frames[0].hitDistanceParameters;
    std::string text = "{\n \"format\": \"nrd-capture\",\n \"version\": 1,\n \"name\": " + quoted(name);
    text += sentence(",\n \"resolution\": [%u, %u]", common.rectSize[0], common.rectSize[1]);
    text += ",\n \"metersPerUnit\": " + number(1.0 / double(common.metersToUnits));
    text += ",\n \"denoisingRange\": " + number(common.denoisingRange);
    const float parameters[4] = {hit.A * common.metersToUnits, hit.B, hit.C, kD};
    text += ",\n \"hitDistanceParameters\": " + list(parameters, 4);
    if (frames[0].hasLight) text += ",\n " + lightOf(frames[0]);
    for (size_t i = 0; i < notes.size(); i++) text += (i ? ",\n  " : ",\n \"notes\": [\n  ") + quoted(notes[i]);
    if (!notes.empty()) text += "\n ]";
    text += ",\n \"frames\": [\n";
    for (size_t i = 0; i < frames.size(); i++) text += (i ? ",\n" : "") + frameEntry(frames, i);
    return text + "\n ]\n}\n";
}
} // namespace

std::string frameFileName(size_t index) { return sentence("frame_%04zu.exr", index); }

void writeCaptureJson(const std::filesystem::path& folder, const std::vector<FrameContext>& frames,
                      const std::vector<std::string>& notes)
{
    const std::string text = document(std::filesystem::absolute(folder).filename().string(), frames, notes);
    const std::string file = (folder / "capture.json").string();
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(std::fopen(file.c_str(), "wb"), std::fclose);
    if (!stream || std::fwrite(text.data(), text.size(), 1, stream.get()) != 1 || std::fflush(stream.get()) != 0)
        throw Refusal(Result::FAILURE, sentence("DumpInputs(): %s cannot be written", file.c_str()));
}
} // namespace nrd::dump
