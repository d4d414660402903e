// The renderer under a user's hand: follows ViewerState frame by frame. Knows no window.
#pragma once
#include "renderer.h"
#include "window/display.h"
#include "window/live_reference.h"
#include "window/viewer_state.h"

namespace sample
{
/// What the panel tells about the pixel under the cursor.
struct PickedPixel
{
    glm::ivec2 pixel = glm::ivec2(0);
    float viewZ = 0.0f;
    glm::vec4 normalRoughness = glm::vec4(0.0f);
    glm::vec4 motionMaterial = glm::vec4(0.0f);
    glm::vec4 noisy = glm::vec4(0.0f); // composed
    glm::vec4 denoised = glm::vec4(0.0f);
    std::array<std::optional<float>, 2> historyLength; // frames, by lobe; nullopt: the denoiser does not tell
};

/// What a viewer shows first. Drivers take seconds to compile denoisers, and some only when they run.
enum class FirstPicture : uint8_t
{
    Denoised,
    Noisy, // the sides are made for the second
};

class Viewer
{
public:
    /// Takes over scene, environment and the options' choices. Throws engine::Error, SceneError and SettingError.
    Viewer(const engine::Device& device, Stage stage, const Options& options, uint32_t slotCount,
           FirstPicture first = FirstPicture::Denoised);

    /// Follows the state, renders a frame unless paused, and adds to the reference. True if there is a new frame.
    /// What the state asks and cannot be had is undone in it, with a message. `seconds`: since the last call. Throws as
    /// the constructor where the denoisers that wait for the second picture cannot be made.
    bool advance(double seconds);
    /// The next picture is the first one denoised.
    bool awaitsDenoisers() const { return m_isNoisyFirst && m_frameCount > 0; }
    /// Another size of the picture; history and reference are lost.
    void resize(uint32_t width, uint32_t height);

    /// Records picture().
    void recordPicture(VkCommandBuffer cmd, uint32_t slot);
    engine::Image& picture() { return m_display->picture(); }
    /// The image that the view shows, of A; null when there is none now.
    engine::Image* viewedImage();

    /// Takes "key=value" for side A after checking that the denoiser has the setting and takes the value.
    void set(const Assignment& assignment);
    /// As --denoiser: one set, or two to compare. Throws SettingError.
    void setDenoisers(const std::string& names);
    /// The settings of a side as they are, defaults included; `isDefault`: as they would be without its own.
    ReplaySettings settingsOf(const Side& side, bool isDefault = false) const;
    void startCamera(CameraMode mode); // from where the camera is now
    /// From the next frame on every pixel has paths, also where the denoisers read fewer: for captures.
    void traceAllPixels(bool isWanted) { m_options.hasWholeSignals = isWanted; }
    uint32_t stride() const; // pixels from one that has paths to the next

    PickedPixel readPicked();
    /// Of side A and B, decibels; nullopt without reference. Measured now and then.
    const std::array<std::optional<double>, 2>& errors() const { return m_errors; }
    /// Milliseconds of side A's passes, frame by frame.
    const std::vector<float>& frameTimes() const { return m_frameTimes; }

    Renderer& renderer() { return *m_renderer; }
    const Scene& scene() const { return m_stage.scene; }
    DenoiseStage& side(size_t index) { return m_renderer->stage(index == 0 ? kSideA : kSideB); }
    DenoiseStage& noisy() { return m_renderer->stage(kNoisy); }
    LiveReference& reference() { return *m_reference; }
    bool hasShadowSignal() const { return m_options.hasShadowSignal; }
    bool hasSun() const { return m_hasSun; }
    bool hasEnvironment() const { return m_stage.environment.has_value(); }
    bool isMoving() const { return isAnimated() && state.animationSpeed > 0.0f && !state.isPaused; }
    bool isAnimated() const { return !m_stage.scene.channels.empty(); }
    const Options& options() const { return m_options; }
    /// The command line that renders what side A shows, but for the number of frames.
    std::vector<std::string> arguments() const;
    double time() const { return m_time; } // seconds of animation, of the last frame

    /// Names of the permutations that the denoisers may run, and modules for them in place of the library's: the
    /// denoisers are made anew. Throws engine::Error when they cannot be, and then they are as they were.
    std::set<std::string> shaders();
    void setShaders(ShaderModules modules);
    const std::string& message() const { return m_message; }
    void setMessage(const std::string& message) { m_message = message; }
    /// The last advance() was refused something; else a message only says what was done instead.
    bool wasRefused() const { return m_wasRefused; }

    ViewerState state;

private:
    static constexpr size_t kSideA = 0, kNoisy = 1, kSideB = 2; // stages of the renderer
    void build();
    void followSamples(const Side& side);
    void followTracer();
    void followLights();
    void followSides();
    void followSide(size_t index, bool isNew);
    void startDenoisers();
    Options optionsOf(const Side& side) const;
    std::vector<Assignment> effectiveSettings(size_t index) const;
    void renderFrame(double seconds);
    void gatherReference();
    void keepTimes();

    const engine::Device& m_device;
    Stage m_stage;
    std::optional<Environment> m_untouchedEnvironment; // not turned
    Options m_options;
    uint32_t m_slotCount;
    bool m_isNoisyFirst;
    bool m_hasSun = false;
    ShaderModules m_shaders; // in place of the library's; outlives the stages
    std::unique_ptr<Renderer> m_renderer;
    std::optional<LiveReference> m_reference;
    std::optional<Display> m_display;
    engine::FrameRing m_ring; // of the reference
    ViewerState m_applied;
    std::array<std::vector<Assignment>, 2> m_appliedSettings;
    double m_time = 0.0;
    bool m_isCut = true;
    std::optional<Camera> m_restingCamera;
    uint32_t m_frameCount = 0;
    std::array<std::optional<double>, 2> m_errors;
    std::vector<float> m_frameTimes;
    std::string m_message;
    bool m_wasRefused = false;
};
} // namespace sample
