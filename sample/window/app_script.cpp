// The commands of a script, as if a user did them.
#include "window/app_parts.h"
#include "window/views.h"

#include <GLFW/glfw3.h>
#include <algorithm>
#include <cstdio>

namespace sample
{
namespace
{
// Index of `name` in the list; throws with `what` where it is not there.
template <size_t N> uint32_t indexOf(const char* const (&names)[N], const std::string& name, const char* what)
{
    std::string text = "'" + name + "' is no " + what + "; there are";
    for (uint32_t i = 0; i < N; ++i)
    {
        if (name == names[i]) return i;
        text += std::string(" ") + names[i];
    }
    throw SettingError(text);
}

constexpr const char* kCameras[] = {"scene", "fly", "orbit"};
constexpr const char* kTones[] = {"compress", "filmic", "clamp"};
constexpr const char* kLobeNames[] = {"both", "probabilistic", "merged"};
constexpr const char* kColors[] = {"off", "black", "white"};
constexpr const char* kResolutions[] = {"off", "means", "sparse"};

struct NamedKey
{
    const char* name;
    int code; // GLFW_KEY_... or GLFW_MOUSE_BUTTON_...
    bool isButton = false;
};
constexpr NamedKey kKeys[] = {{"space", GLFW_KEY_SPACE},
                              {"tab", GLFW_KEY_TAB},
                              {"shift", GLFW_KEY_LEFT_SHIFT},
                              {"ctrl", GLFW_KEY_LEFT_CONTROL},
                              {"f11", GLFW_KEY_F11},
                              {"f12", GLFW_KEY_F12},
                              {"left", GLFW_MOUSE_BUTTON_LEFT, true},
                              {"right", GLFW_MOUSE_BUTTON_RIGHT, true}};

// A letter or digit is its own name.
NamedKey keyNamed(const std::string& name)
{
    for (const NamedKey& key : kKeys)
        if (name == key.name) return key;
    const char c = name.size() == 1 ? name[0] : ' ';
    if (c >= 'a' && c <= 'z') return {"", GLFW_KEY_A + (c - 'a')};
    if (c >= '0' && c <= '9') return {"", GLFW_KEY_0 + (c - '0')};
    throw SettingError("'" + name + "' is no key; there are a to z, 0 to 9, space tab shift ctrl f11 f12 left right");
}

std::filesystem::path pathOrEnd(const std::string& text) { return text == "off" ? "" : text; }
} // namespace

// Commands take their turn until one needs frames to go by, or a scene to load.
void App::runScript()
{
    while (m_next < m_script.size() && m_waitFrames == 0 && !m_loader.isBusy() && !m_window.isClosing())
    {
        const ScriptCommand& command = m_script[m_next++];
        try
        {
            run(command);
            fulfil();
        }
        catch (const std::exception& error)
        {
            throw ScriptError(m_options.script.string() + ":" + std::to_string(command.line) + ": " + error.what());
        }
    }
    if (isScripted() && m_next == m_script.size() && m_waitFrames == 0 && !m_loader.isBusy()) m_window.close();
}

void App::run(const ScriptCommand& command)
{
    switch (command.verb)
    {
    case Verb::Scene:
        m_wishes.scene = command.text;
        break;
    case Verb::Environment:
    case Verb::Drop:
        m_wishes.file = command.text;
        break;
    case Verb::Screenshot:
        m_wishes.picture = command.text;
        break;
    case Verb::Buffer:
        m_wishes.buffer = command.text;
        break;
    case Verb::Capture:
        m_wishes.capture = pathOrEnd(command.text);
        break;
    case Verb::Sequence:
        m_wishes.sequence = pathOrEnd(command.text);
        break;
    case Verb::Test:
        m_wishes.test = pathOrEnd(command.text);
        break;
    case Verb::Print:
        print(command.text);
        break;
    case Verb::Frames:
        m_waitFrames = uint32_t(command.numbers[0]);
        break;
    default:
        runViewing(command);
    }
}

void App::runViewing(const ScriptCommand& command)
{
    ViewerState& state = m_viewer->state;
    const auto number = float(command.numbers[0]), second = float(command.numbers[1]);
    const bool isOn = command.numbers[0] != 0.0;
    CameraInput turn;
    switch (command.verb)
    {
    case Verb::Denoiser:
        return m_viewer->setDenoisers(command.text);
    case Verb::Set:
        return m_viewer->set(parseAssignment(command.text));
    case Verb::Reset:
        for (Side& side : state.sides) side.settings.clear();
        return;
    case Verb::View:
        state.view = findView(command.text);
        return;
    case Verb::Split:
        state.split = std::clamp(number, 0.0f, 1.0f);
        return;
    case Verb::Exposure:
        state.exposure = number;
        return;
    case Verb::Tone:
        state.tone = indexOf(kTones, command.text, "tone mapping");
        return;
    case Verb::Pick:
        return pick((glm::vec2(number, second) + 0.5f) /
                    glm::vec2(m_viewer->options().width, m_viewer->options().height));
    case Verb::Camera:
        return m_viewer->startCamera(CameraMode(indexOf(kCameras, command.text, "camera")));
    case Verb::Turn:
        turn.turn = glm::radians(glm::vec2(number, second));
        if (state.cameraMode == CameraMode::Scene) m_viewer->startCamera(CameraMode::Orbit);
        return state.camera.apply(state.cameraMode, turn);
    case Verb::Pause:
        state.isPaused = isOn;
        return;
    case Verb::Step:
        ++state.steps;
        return;
    case Verb::Restart:
        state.isRestarted = true;
        return;
    case Verb::Reference:
        state.hasReference = isOn;
        return;
    default:
        return runTracing(command);
    }
}

void App::runTracing(const ScriptCommand& command)
{
    ViewerState& state = m_viewer->state;
    const auto number = float(command.numbers[0]), second = float(command.numbers[1]);
    switch (command.verb)
    {
    case Verb::Lobes:
        state.lobes = Lobes(indexOf(kLobeNames, command.text, "kind of lobes"));
        return;
    case Verb::Checkerboard:
        state.checkerboard = nrd::CheckerboardMode(indexOf(kColors, command.text, "checkerboard"));
        return;
    case Verb::Half:
    {
        const uint32_t how = indexOf(kResolutions, command.text, "way to denoise at half resolution");
        for (Side& side : state.sides) side.resolution = {how == 0 ? 1u : 2u, how == 2};
        return;
    }
    case Verb::Bounces:
        state.bounces = std::min(uint32_t(number), 64u);
        return;
    case Verb::Psr:
        state.hasPsr = command.numbers[0] != 0.0;
        return;
    case Verb::Taa:
        state.hasTemporalAa = command.numbers[0] != 0.0;
        return;
    case Verb::Sun:
        state.sun = {number, second};
        return;
    case Verb::Rotate:
        state.environmentTurn = number;
        return;
    case Verb::Confidence:
        state.hasConfidence = command.numbers[0] != 0.0;
        return;
    case Verb::Speed:
        state.animationSpeed = std::clamp(number, 0.0f, 4.0f);
        return;
    default:
        return runWindowing(command);
    }
}

void App::runWindowing(const ScriptCommand& command)
{
    const bool isOn = command.numbers[0] != 0.0;
    switch (command.verb)
    {
    case Verb::Resize:
        return m_window.setPixelSize({int(command.numbers[0]), int(command.numbers[1])});
    case Verb::Scale:
        m_wishes.renderScale = std::clamp(float(command.numbers[0]), 0.1f, 2.0f);
        return;
    case Verb::Fullscreen:
        return m_window.setFullscreen(isOn);
    case Verb::Minimize:
        return m_window.setMinimized(isOn);
    case Verb::Reload:
#ifdef NRD_HOT_RELOAD
        return m_shaderReload.watch(*m_viewer, command.text);
#else
        throw SettingError("this build has no hot reload of shaders");
#endif
    case Verb::Hold:
    case Verb::Release:
        return hold(command.text, command.verb == Verb::Hold);
    case Verb::Cursor:
        return m_window.moveCursor({float(command.numbers[0]), float(command.numbers[1])});
    case Verb::WindowShot:
        m_wishes.windowPicture = command.text;
        m_waitFrames = 1; // it is taken as the next frame is shown
        return;
    default:
        return m_window.close();
    }
}

void App::hold(const std::string& name, bool isHeld)
{
    const NamedKey key = keyNamed(name);
    key.isButton ? m_window.holdButton(key.code, isHeld) : m_window.holdKey(key.code, isHeld);
}

// What keys and mouse change.
void App::printState() const
{
    const ViewerState& s = m_viewer->state;
    const glm::vec3 eye = s.camera.eye(), target = s.camera.target();
    std::printf(
        "state paused %d compared %d split %.2f view '%s' panel %d fullscreen %d picked %d,%d frames %u camera %s",
        s.isPaused, s.isCompared, double(s.split), views()[s.view].name, !m_isPanelHidden, m_window.isFullscreen(),
        s.picked ? s.picked->x : -1, s.picked ? s.picked->y : -1, m_viewer->renderer().frameIndex(),
        kCameras[size_t(s.cameraMode)]);
    if (s.cameraMode != CameraMode::Scene)
        std::printf(" eye %.3f %.3f %.3f target %.3f %.3f %.3f", double(eye.x), double(eye.y), double(eye.z),
                    double(target.x), double(target.y), double(target.z));
    std::printf("\n");
}

void App::printTimes() const
{
    const auto show = [](const nrd::PassTime& pass)
    { std::printf("time %8.3f ms %s\n", double(pass.milliseconds), pass.name); };
    for (const nrd::PassTime& pass : m_viewer->renderer().tracingTimes()) show(pass);
    const nrd::Timings timings = m_viewer->side(0).timings();
    for (uint32_t i = 0; i < timings.passesNum; ++i) show(timings.passes[i]);
}

void App::print(const std::string& what)
{
    if (what == "views")
        for (const ViewRow& row : views()) std::printf("%s\n", row.name);
    else if (what == "state")
        printState();
    else if (what == "start")
        std::printf("first picture after %.2f s\n", m_firstPicture.value_or(0.0));
    else if (what == "message")
        std::printf("message '%s'\n", m_viewer->message().c_str());
    else if (what == "memory")
        std::printf("memory %.2f MiB\n", m_viewer->side(0).memoryMiB());
    else if (what == "times")
        printTimes();
    else if (what == "size")
        std::printf("size %u x %u of %u x %u\n", m_viewer->options().width, m_viewer->options().height,
                    m_screen.extent().width, m_screen.extent().height);
    else if (what == "error")
        std::printf("reference %u samples, PSNR %.2f dB\n", m_viewer->reference().sampleCount(),
                    m_viewer->errors()[0].value_or(0.0));
    else if (what == "pixel")
    {
        const PickedPixel p = m_viewer->readPicked();
        std::printf("pixel %d,%d viewZ %g history %g %g\n", p.pixel.x, p.pixel.y, double(p.viewZ),
                    double(p.historyLength[0].value_or(0.0f)), double(p.historyLength[1].value_or(0.0f)));
    }
    else
        throw SettingError("print takes pixel, error, memory, times, size, views, state, start or message, not '" +
                           what + "'");
}
} // namespace sample
