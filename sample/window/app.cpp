#include "window/app_parts.h"

#include <GLFW/glfw3.h>
#include <algorithm>
#include <cmath>
#include <cstdio>

namespace sample
{
namespace
{
constexpr glm::ivec2 kDefaultSize(1280, 720);
constexpr float kDefaultScale = 0.5f;   // so that a CPU shows something soon; the panel and --size say otherwise
constexpr float kTurnPerPixel = 0.005f; // radians
constexpr float kSplitReach = 6.0f;     // pixels

Options windowOptions(Options options)
{
    if (options.hasSize) return options;
    options.width = uint32_t(float(kDefaultSize.x) * kDefaultScale);
    options.height = uint32_t(float(kDefaultSize.y) * kDefaultScale);
    return options;
}

engine::DeviceDesc deviceDesc(const Options& options, const window::Window& window)
{
    engine::DeviceDesc desc = deviceDescOf(options);
    window.addRequirements(desc);
    return desc;
}

uint32_t scaled(int pixels, float scale)
{
    return uint32_t(std::clamp(std::lround(float(pixels) * scale), 16l, 8192l));
}
} // namespace

App::App(const Options& options)
    : m_options(windowOptions(options)),
      m_window("nrd-sample", options.hasSize ? glm::ivec2(options.width, options.height) : kDefaultSize),
      m_device(deviceDesc(options, m_window)), m_screen(m_device, m_window), m_recorder(m_device)
{
    m_wishes.renderScale = options.hasSize ? 1.0f : kDefaultScale;
    if (isScripted()) m_script = readScript(options.script);
    m_loader.start(m_options);
}

void App::run()
{
    while (!m_window.isClosing()) frame();
    m_recorder.stopTest();
    m_recorder.stopCapture();
    m_device.waitIdle();
    checkValidation(m_device);
}

// A script's frames are all of the same length, so that what it records is the same each time.
double App::secondsOfFrame()
{
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - m_last).count();
    m_last = now;
    return isScripted() ? 1.0 / double(m_options.framesPerSecond) : seconds;
}

void App::frame()
{
    m_window.poll();
    for (const std::filesystem::path& file : m_window.takeDroppedFiles()) m_wishes.file = file;
    if (m_loader.isReady()) finishLoading();
    if (m_loader.isBusy()) return show("Reading " + m_loader.name());
    runScript();
    if (m_loader.isBusy() || m_window.isClosing()) return;
    followWindow();
#ifdef NRD_HOT_RELOAD
    m_shaderReload.poll(*m_viewer);
#endif
    const double seconds = secondsOfFrame();
    listen(seconds);
    m_viewer->traceAllPixels(m_recorder.isCapturing());
    if (m_viewer->awaitsDenoisers()) show("Compiling " + m_viewer->state.sides[0].set.name());
    const bool isNew = m_viewer->advance(seconds);
    if (isScripted() && m_viewer->wasRefused()) throw ScriptError(m_viewer->message());
    m_picked.reset();
    if (m_viewer->state.picked) m_picked = m_viewer->readPicked();
    show("");
    if (!m_firstPicture)
        m_firstPicture = std::chrono::duration<double>(std::chrono::steady_clock::now() - m_start).count();
    if (isNew) m_recorder.addFrame(*m_viewer);
    if (m_waitFrames > 0) --m_waitFrames;
    fulfil();
}

// With a progress where something loads; over the picture as it was.
void App::show(const std::string& progress)
{
    m_screen.gui().beginFrame();
    if (!progress.empty())
        drawProgress(progress, m_loader.seconds());
    else if (m_viewer && !m_isPanelHidden)
        drawPanel({*m_viewer, m_wishes, m_recorder, m_picked});
    const auto record = [&](VkCommandBuffer cmd, uint32_t slot) -> engine::Image*
    {
        if (!m_viewer) return nullptr;
        m_viewer->recordPicture(cmd, slot);
        return &m_viewer->picture();
    };
    if (!m_wishes.windowPicture || !m_viewer || !progress.empty())
    {
        m_screen.present(record);
        return;
    }
    Image picture;
    if (m_screen.present(record, &picture)) writeEncodedPng(*std::exchange(m_wishes.windowPicture, {}), picture);
}

void App::finishLoading()
{
    try
    {
        Stage stage = m_loader.take();
        for (const std::string& note : stage.notes) std::printf("%s\n", note.c_str());
        show("Compiling for " + m_loader.name());
        Options options = m_loader.options();
        const glm::ivec2 size = m_window.pixelSize();
        options.width = scaled(size.x, m_wishes.renderScale);
        options.height = scaled(size.y, m_wishes.renderScale);
        auto viewer = std::make_unique<Viewer>(m_device, std::move(stage), options, window::Swapchain::kFramesInFlight,
                                               FirstPicture::Noisy);
        if (m_viewer)
        {
            viewer->state.view = m_viewer->state.view;
            viewer->state.exposure = m_viewer->state.exposure;
            viewer->state.tone = m_viewer->state.tone;
            viewer->state.hasReference = m_viewer->state.hasReference;
            viewer->state.hasConfidence = m_viewer->state.hasConfidence;
        }
        m_recorder.stopTest();
        m_recorder.stopCapture();
        m_device.waitIdle();
        m_viewer = std::move(viewer);
        m_options = m_loader.options();
        m_window.setTitle("nrd-sample - " + m_loader.name());
    }
    catch (const std::exception& error)
    {
        if (!m_viewer || isScripted()) throw; // nothing to go back to
        m_viewer->setMessage(error.what());
    }
}

void App::followWindow()
{
    const glm::ivec2 size = m_window.pixelSize();
    if (size == glm::ivec2(0)) return;
    const uint32_t width = scaled(size.x, m_wishes.renderScale), height = scaled(size.y, m_wishes.renderScale);
    if (width == m_viewer->options().width && height == m_viewer->options().height) return;
    m_viewer->resize(width, height);
}

// Of panel, keys and script.
void App::fulfil()
{
    try
    {
        Wishes& w = m_wishes;
        if (w.picture) m_recorder.savePicture(*m_viewer, *std::exchange(w.picture, {}));
        if (w.buffer) m_recorder.saveBuffer(*m_viewer, *std::exchange(w.buffer, {}));
        if (const auto folder = std::exchange(w.capture, {}))
            folder->empty() ? m_recorder.stopCapture() : m_recorder.startCapture(*m_viewer, *folder);
        if (const auto folder = std::exchange(w.sequence, {}))
            folder->empty() ? m_recorder.stopSequence() : m_recorder.startSequence(*folder);
        if (const auto folder = std::exchange(w.test, {}))
            folder->empty() ? m_recorder.stopTest() : m_recorder.startTest(*m_viewer, *folder);
        if (const auto isWanted = std::exchange(w.fullscreen, {})) m_window.setFullscreen(*isWanted);
        if (const auto scene = std::exchange(w.scene, {})) m_loader.start(withScene(m_options, *scene));
        if (const auto file = std::exchange(w.file, {})) m_loader.start(withFile(m_options, *file));
    }
    catch (const std::exception& error)
    {
        if (isScripted()) throw;
        m_viewer->setMessage(error.what());
    }
}

void App::listen(double seconds)
{
    if (!window::Gui::wantsKeys()) listenToKeys();
    const glm::vec2 cursor = m_window.cursor();
    CameraInput input;
    input.seconds = float(std::min(seconds, 0.1));
    const auto axis = [&](int more, int less)
    { return float(m_window.isKeyDown(more)) - float(m_window.isKeyDown(less)); };
    if (!window::Gui::wantsKeys())
        input.move = {axis(GLFW_KEY_D, GLFW_KEY_A), axis(GLFW_KEY_E, GLFW_KEY_Q), axis(GLFW_KEY_W, GLFW_KEY_S)};
    input.isFast = m_window.isKeyDown(GLFW_KEY_LEFT_SHIFT);
    const glm::vec2 wheel = m_window.takeWheel();
    const bool isRight = m_window.isButtonDown(GLFW_MOUSE_BUTTON_RIGHT);
    const bool isLeft =
        m_window.isButtonDown(GLFW_MOUSE_BUTTON_LEFT) && !m_isSplitHeld && !m_window.isKeyDown(GLFW_KEY_LEFT_CONTROL);
    if (!window::Gui::wantsMouse())
    {
        input.zoom = wheel.y;
        if (isRight || isLeft) input.turn = kTurnPerPixel * (cursor - m_cursor);
        listenToMouse();
    }
    else
        m_isSplitHeld = false;
    m_cursor = cursor;
    const bool isMoved = input.move != glm::vec3(0.0f) || input.turn != glm::vec2(0.0f) || input.zoom != 0.0f;
    if (!isMoved) return;
    if (m_viewer->state.cameraMode == CameraMode::Scene)
        m_viewer->startCamera(isLeft && !isRight ? CameraMode::Orbit : CameraMode::Fly);
    m_viewer->state.camera.apply(m_viewer->state.cameraMode, input);
}

void App::listenToKeys()
{
    const auto isHit = [&](int key)
    {
        const bool isDown = m_window.isKeyDown(key);
        const bool wasDown = std::exchange(m_wereKeysDown[key], isDown);
        return isDown && !wasDown;
    };
    ViewerState& state = m_viewer->state;
    if (isHit(GLFW_KEY_SPACE)) state.isPaused = !state.isPaused;
    if (isHit(GLFW_KEY_N)) state.isPaused = true, state.steps = 1;
    if (isHit(GLFW_KEY_R)) state.isRestarted = true;
    if (isHit(GLFW_KEY_C)) state.isCompared = !state.isCompared;
    if (isHit(GLFW_KEY_TAB)) state.view = state.view == 0 ? 1 : 0; // denoised, noisy
    if (isHit(GLFW_KEY_1)) m_viewer->startCamera(CameraMode::Scene);
    if (isHit(GLFW_KEY_H)) m_isPanelHidden = !m_isPanelHidden;
    if (isHit(GLFW_KEY_F11)) m_wishes.fullscreen = !m_window.isFullscreen();
    if (isHit(GLFW_KEY_F12)) m_wishes.picture = "picture.png";
}

void App::listenToMouse()
{
    ViewerState& state = m_viewer->state;
    const glm::vec2 size(m_window.pixelSize()), cursor = m_window.cursor();
    const bool isLeft = m_window.isButtonDown(GLFW_MOUSE_BUTTON_LEFT);
    if (isLeft && m_window.isKeyDown(GLFW_KEY_LEFT_CONTROL)) pick(cursor / size);
    const bool isNear = std::abs(cursor.x - state.split * size.x) < kSplitReach;
    m_isSplitHeld = isLeft && state.isCompared && (m_isSplitHeld || isNear);
    if (m_isSplitHeld) state.split = std::clamp(cursor.x / size.x, 0.0f, 1.0f);
}

void App::pick(glm::vec2 share)
{
    const glm::vec2 size(m_viewer->options().width, m_viewer->options().height);
    m_viewer->state.picked = glm::ivec2(glm::clamp(share * size, glm::vec2(0.0f), size - 1.0f));
}

void runWindow(const Options& options) { App(options).run(); }
} // namespace sample
