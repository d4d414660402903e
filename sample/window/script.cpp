#include "window/script.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>

namespace sample
{
namespace
{
// clang-format off
constexpr VerbRow kVerbs[] = {
    {Verb::Scene,        "scene",        ArgumentKind::Text,    "FILE|NAME", "load a glTF file or a built-in scene"},
    {Verb::Environment,  "environment",  ArgumentKind::Text,    "FILE",      "load a .hdr or .exr picture"},
    {Verb::Drop,         "drop",         ArgumentKind::Text,    "FILE",      "as if the file were dropped there"},
    {Verb::Denoiser,     "denoiser",     ArgumentKind::Text,    "A[,B]",     "as --denoiser; B: compare"},
    {Verb::Set,          "set",          ArgumentKind::Text,    "KEY=VALUE", "a setting of the left side"},
    {Verb::Reset,        "reset",        ArgumentKind::None,    "",          "all settings to their defaults"},
    {Verb::View,         "view",         ArgumentKind::Text,    "NAME",      "what is shown, as the panel names it"},
    {Verb::Split,        "split",        ArgumentKind::Number,  "X",         "where A ends and B begins, [0; 1]"},
    {Verb::Lobes,        "lobes",        ArgumentKind::Text,    "WHICH",     "as --lobes"},
    {Verb::Checkerboard, "checkerboard", ArgumentKind::Text,    "COLOR",     "as --checkerboard"},
    {Verb::Half,         "half",         ArgumentKind::Text,    "HOW",       "off, means or sparse: at half resolution"},
    {Verb::Bounces,      "bounces",      ArgumentKind::Count,   "N",         "as --bounces"},
    {Verb::Psr,          "psr",          ArgumentKind::Switch,  "on|off",    "follow mirrors, as --psr"},
    {Verb::Taa,          "taa",          ArgumentKind::Switch,  "on|off",    "temporal anti-aliasing"},
    {Verb::Camera,       "camera",       ArgumentKind::Text,    "MODE",      "scene, fly or orbit"},
    {Verb::Turn,         "turn",         ArgumentKind::Numbers, "X,Y",       "degrees to the right and down"},
    {Verb::Pick,         "pick",         ArgumentKind::Numbers, "X,Y",       "pick a pixel of the picture"},
    {Verb::Exposure,     "exposure",     ArgumentKind::Number,  "EV",        "powers of two"},
    {Verb::Tone,         "tone",         ArgumentKind::Text,    "NAME",      "tone mapping, as the panel names it"},
    {Verb::Sun,          "sun",          ArgumentKind::Numbers, "AZ,EL",     "where the sun is, degrees"},
    {Verb::Rotate,       "rotate",       ArgumentKind::Number,  "DEGREES",   "the environment, about the vertical"},
    {Verb::Confidence,   "confidence",   ArgumentKind::Switch,  "on|off",    "as --confidence"},
    {Verb::Speed,        "speed",        ArgumentKind::Number,  "FACTOR",    "of the animation, 0 stands still"},
    {Verb::Pause,        "pause",        ArgumentKind::Switch,  "on|off",    "render no frames"},
    {Verb::Step,         "step",         ArgumentKind::None,    "",          "one frame while paused"},
    {Verb::Restart,      "restart",      ArgumentKind::None,    "",          "forget the history"},
    {Verb::Reference,    "reference",    ArgumentKind::Switch,  "on|off",    "accumulate one while the camera rests"},
    {Verb::Resize,       "resize",       ArgumentKind::Size,    "WxH",       "the window, pixels"},
    {Verb::Scale,        "scale",        ArgumentKind::Number,  "FACTOR",    "rendered pixels per pixel of the window"},
    {Verb::Fullscreen,   "fullscreen",   ArgumentKind::Switch,  "on|off",    ""},
    {Verb::Minimize,     "minimize",     ArgumentKind::Switch,  "on|off",    ""},
    {Verb::Frames,       "frames",       ArgumentKind::Count,   "N",         "show so many frames"},
    {Verb::Screenshot,   "screenshot",   ArgumentKind::Text,    "FILE",      ".png as seen, .exr in linear light"},
    {Verb::Buffer,       "buffer",       ArgumentKind::Text,    "FILE.exr",  "the image that is viewed, all channels"},
    {Verb::WindowShot,   "window",       ArgumentKind::Text,    "FILE.png",  "the whole window with its panel"},
    {Verb::Capture,      "capture",      ArgumentKind::Text,    "DIR|off",   "record the frames that follow"},
    {Verb::Sequence,     "sequence",     ArgumentKind::Text,    "DIR|off",   "pictures of the frames that follow"},
    {Verb::Test,         "test",         ArgumentKind::Text,    "DIR|off",   "record the frames that follow as a test in DIR"},
    {Verb::Reload,       "reload",       ArgumentKind::Text,    "DIR",       "the denoisers' shaders from there, with hot reload"},
    {Verb::Hold,         "hold",         ArgumentKind::Text,    "KEY",       "a key, or the left or right button"},
    {Verb::Release,      "release",      ArgumentKind::Text,    "KEY",       "what is held"},
    {Verb::Cursor,       "cursor",       ArgumentKind::Numbers, "X,Y",       "move the mouse, pixels of the window"},
    {Verb::Print,        "print",        ArgumentKind::Text,    "WHAT",      "pixel, error, memory, size, views, state, start, message"},
    {Verb::Quit,         "quit",         ArgumentKind::None,    "",          "close the window"},
};
// clang-format on

// Reads as many numbers as there are, separated by `separator`, out of the whole text.
bool parseNumbers(const std::string& text, char separator, size_t count, std::array<double, 2>& numbers)
{
    const char* at = text.data();
    const char* end = at + text.size();
    for (size_t i = 0; i < count; ++i)
    {
        if (i > 0 && (at == end || *at++ != separator)) return false;
        const auto [next, error] = std::from_chars(at, end, numbers[i]);
        if (error != std::errc() || !std::isfinite(numbers[i])) return false;
        at = next;
    }
    return at == end;
}

bool isWhole(double number, double low, double high)
{
    return number >= low && number <= high && number == std::floor(number);
}

// Null, or what was expected.
const char* parseArgument(ArgumentKind kind, ScriptCommand& command)
{
    const std::string& text = command.text;
    std::array<double, 2>& numbers = command.numbers;
    switch (kind)
    {
    case ArgumentKind::None:
        return text.empty() ? nullptr : "nothing";
    case ArgumentKind::Text:
        return text.empty() ? "a text" : nullptr;
    case ArgumentKind::Switch:
        numbers[0] = text == "on";
        return text == "on" || text == "off" ? nullptr : "on or off";
    case ArgumentKind::Count:
        return parseNumbers(text, ',', 1, numbers) && isWhole(numbers[0], 1, 1e6) ? nullptr
                                                                                  : "a whole number from 1 on";
    case ArgumentKind::Number:
        return parseNumbers(text, ',', 1, numbers) ? nullptr : "a number";
    case ArgumentKind::Numbers:
        return parseNumbers(text, ',', 2, numbers) ? nullptr : "two numbers with a comma between";
    case ArgumentKind::Size:
        return parseNumbers(text, 'x', 2, numbers) && isWhole(numbers[0], 16, 8192) && isWhole(numbers[1], 16, 8192)
                   ? nullptr
                   : "WxH with both in [16; 8192]";
    }
    return nullptr;
}

std::string trimmed(const std::string& text)
{
    const size_t begin = text.find_first_not_of(" \t\r");
    return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(" \t\r") + 1 - begin);
}

ScriptCommand parseLine(const std::string& line, int number, const std::string& place)
{
    const size_t space = line.find_first_of(" \t");
    const std::string name = line.substr(0, space);
    const auto* row =
        std::find_if(std::begin(kVerbs), std::end(kVerbs), [&](const VerbRow& r) { return name == r.name; });
    if (row == std::end(kVerbs)) throw ScriptError(place + "'" + name + "' is no command");
    ScriptCommand command;
    command.verb = row->verb;
    command.text = space == std::string::npos ? "" : trimmed(line.substr(space));
    command.line = number;
    if (const char* expected = parseArgument(row->kind, command))
        throw ScriptError(place + name + " takes " + expected + ", not '" + command.text + "'");
    return command;
}
} // namespace

std::span<const VerbRow> verbs() { return kVerbs; }

std::vector<ScriptCommand> parseScript(std::istream& stream, const std::string& name)
{
    std::vector<ScriptCommand> commands;
    std::string line;
    for (int number = 1; std::getline(stream, line); ++number)
    {
        line = trimmed(line.substr(0, line.find('#')));
        if (!line.empty()) commands.push_back(parseLine(line, number, name + ":" + std::to_string(number) + ": "));
    }
    return commands;
}

std::vector<ScriptCommand> readScript(const std::filesystem::path& file)
{
    std::ifstream stream(file);
    if (!stream) throw ScriptError("cannot read the script '" + file.string() + "'");
    return parseScript(stream, file.string());
}
} // namespace sample
