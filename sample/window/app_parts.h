// What the program with a window is made of; for app*.cpp only.
#pragma once
#include "window/app.h"
#include "window/loader.h"
#include "window/panel.h"
#include "window/screen.h"
#include "window/script.h"
#ifdef NRD_HOT_RELOAD
#include "window/shader_reload.h"
#endif

#include <map>

namespace sample
{
class App
{
public:
    explicit App(const Options& options);
    void run();

private:
    void frame();
    void show(const std::string& progress);
    void finishLoading();
    void fulfil();
    void listen(double seconds);
    void listenToKeys();
    void listenToMouse();
    void pick(glm::vec2 share);
    void followWindow();
    double secondsOfFrame();

    // The script, app_script.cpp.
    void runScript();
    void run(const ScriptCommand& command);
    void runViewing(const ScriptCommand& command);
    void runTracing(const ScriptCommand& command);
    void runWindowing(const ScriptCommand& command);
    void hold(const std::string& name, bool isHeld);
    void printState() const;
    void printTimes() const;
    void print(const std::string& what);
    bool isScripted() const { return !m_options.script.empty(); }

    std::chrono::steady_clock::time_point m_start = std::chrono::steady_clock::now(); // of the program
    std::optional<double> m_firstPicture;                                             // seconds from there
    Options m_options;                                                                // of the next scene
    window::Window m_window;
    engine::Device m_device;
    window::Screen m_screen;
    Loader m_loader;
    std::unique_ptr<Viewer> m_viewer;
    Recorder m_recorder;
#ifdef NRD_HOT_RELOAD
    ShaderReload m_shaderReload;
#endif
    Wishes m_wishes;
    std::optional<PickedPixel> m_picked;
    std::vector<ScriptCommand> m_script;
    size_t m_next = 0;         // of the script
    uint32_t m_waitFrames = 0; // before it goes on
    std::chrono::steady_clock::time_point m_last = std::chrono::steady_clock::now();
    glm::vec2 m_cursor = glm::vec2(0.0f);
    bool m_isSplitHeld = false;
    bool m_isPanelHidden = false;
    std::map<int, bool> m_wereKeysDown; // by GLFW_KEY_...
};
} // namespace sample
