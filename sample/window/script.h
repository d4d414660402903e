// What --script reads: one command a line, for tests and recordings. Pure.
#pragma once
#include <array>
#include <filesystem>
#include <istream>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace sample
{
/// A script that cannot be run, in one sentence with file and line.
class ScriptError : public std::runtime_error
{
public:
    using std::runtime_error::runtime_error;
};

enum class Verb : uint8_t
{
    Scene,
    Environment,
    Drop,
    Denoiser,
    Set,
    Reset,
    View,
    Split,
    Lobes,
    Checkerboard,
    Half,
    Bounces,
    Psr,
    Taa,
    Camera,
    Turn,
    Pick,
    Exposure,
    Tone,
    Sun,
    Rotate,
    Confidence,
    Speed,
    Pause,
    Step,
    Restart,
    Reference,
    Resize,
    Scale,
    Fullscreen,
    Minimize,
    Frames,
    Screenshot,
    Buffer,
    WindowShot,
    Capture,
    Sequence,
    Test,
    Reload,
    Hold,
    Release,
    Cursor,
    Print,
    Quit
};

enum class ArgumentKind : uint8_t
{
    None,
    Text,
    Switch, // on, off
    Count,  // whole number >= 1
    Number,
    Numbers, // two, with a comma
    Size     // WxH
};

struct VerbRow
{
    Verb verb;
    const char* name;
    ArgumentKind kind;
    const char* argument; // as the help shows it
    const char* meaning;
};
std::span<const VerbRow> verbs();

struct ScriptCommand
{
    Verb verb = Verb::Quit;
    std::string text;                // the argument as it stands
    std::array<double, 2> numbers{}; // of kinds with numbers; Switch: 1 or 0
    int line = 0;                    // from 1 on
};

/// `name` stands in errors. Empty lines and what follows a # don't count. Throws ScriptError.
std::vector<ScriptCommand> parseScript(std::istream& stream, const std::string& name);
std::vector<ScriptCommand> readScript(const std::filesystem::path& file);
} // namespace sample
