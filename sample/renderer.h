// One run of the sample: frame after frame is posed, traced and denoised; what is asked for is read back.
#pragma once
#include "capture.h"
#include "denoise.h"
#include "engine/commands.h"
#include "engine/timestamps.h"
#include "options.h"
#include "signals.h"

#include <functional>
#include <memory>

namespace sample
{
/// A scene with everything that goes with it, after the defaults have been filled in.
struct Stage
{
    Scene scene;
    std::optional<Environment> environment;
    bool isDefaultSky = false;      // the environment
    std::vector<std::string> notes; // one line for each default that was taken
};

/// The device that the options name; a window adds what it requires.
engine::DeviceDesc deviceDescOf(const Options& options);

/// Throws engine::Error if the validation layer has reported anything.
void checkValidation(const engine::Device& device);

/// Reads scene and environment; throws SceneError or FileError.
Stage loadStage(const Options& options);

/// When and from where a frame is seen, if not as the headless run goes on.
struct FrameInput
{
    std::optional<Camera> camera; // nullopt: the scene's own, or one that frames the scene
    double time = 0.0;            // seconds of animation
    float deltaTimeMs = 1000.0f / 60.0f;
    bool isCut = false;
};

class Renderer
{
public:
    /// Throws engine::Error and SceneError.
    Renderer(const engine::Device& device, const Stage& stage, const Options& options);

    /// Renders the next frame, starting with 0, and waits for it.
    void renderFrame();
    void renderFrame(const FrameInput& input);
    /// Submits the next frame without waiting for it.
    void startFrame(const FrameInput& input);
    /// Replaces what denoises the picture `index`; null leaves the place empty. Waits for the device.
    void setStage(size_t index, std::unique_ptr<DenoiseStage> stage);
    /// Takes the scene and the environment of the stage as they are now, in which nodes may have moved.
    void refreshScene();
    uint32_t frameIndex() const { return m_frame.view.frameIndex; } // of the frame rendered last

    /// The signals of the last frame as the capture format names them.
    Planes readFrame();
    /// Traces the reference of the last frame; `progress` gets the share that is done.
    Planes traceReference(const Planes& frame, uint32_t samples, const std::function<void(double)>& progress);
    /// What a set of Options::sets made of its signals in the last frame, linear.
    Signals readDenoised(size_t set);
    /// The picture of the last frame, of the set that is shown; composed and, if asked for, anti-aliased.
    Image readShown();
    /// The set whose picture is the last frame's. All of them run in every frame, so that each is warm when its turn
    /// comes.
    size_t shownSet() const;

    /// How the last frame was seen, and the head of a capture of this run.
    CaptureFrame captureFrame() const;
    CaptureInfo captureInfo() const;
    /// True when the scene has no camera of its own.
    bool isFraming() const { return m_framing.has_value(); }
    double denoiserMiB(size_t set) const { return m_stages[set]->memoryMiB(); }

    /// GPU time of what is traced, of a frame some frames ago.
    const std::vector<nrd::PassTime>& tracingTimes() const { return m_tracingTimes; }

    PathTracer& tracer() { return m_tracer; }
    DenoiseStage& stage(size_t set) { return *m_stages[set]; }
    const DenoiseFrame& frame() const { return m_frame; }
    Camera currentCamera(float aspect) const;
    glm::vec3 sceneCenter() const { return m_pose->bounds().center(); }

private:
    void pose(const FrameInput& input);
    void trace(VkCommandBuffer cmd, const View& lastView);
    Planes readSums(uint32_t samples, const Planes& frame);

    const engine::Device& m_device;
    const Stage& m_stage;
    const Options& m_options;
    std::optional<ScenePose> m_pose;
    std::optional<double> m_time;             // of the pose
    bool m_isStill = false;                   // the pose was the same in the frame before
    std::optional<Camera> m_framing;          // of a scene without camera
    std::optional<CaptureLight> m_firstLight; // of the shadow signal, before the first frame
    PathTracer m_tracer;
    std::optional<Retrace> m_retrace;
    std::vector<std::unique_ptr<DenoiseStage>> m_stages; // by set
    engine::FrameRing m_ring;
    std::vector<engine::Timestamps> m_timestamps; // by slot of the ring
    std::vector<nrd::PassTime> m_tracingTimes;
    DenoiseFrame m_frame;
    uint32_t m_nextFrame = 0;
};

/// How `options` has a set denoised.
DenoiseDesc denoiseDesc(const Options& options, const Scene& scene, const DenoiserSet& set);

/// direct + sun * shadow + diffuse * diffuseFactor + specular * specularFactor of a frame's own signals.
Image composeNoisy(const Planes& frame);
/// The composed channels of a reference as a picture.
Image composedOf(const Planes& reference);
} // namespace sample
