// One run of the sample: frame after frame is posed, traced and denoised; what is asked for is read back.
#pragma once
#include "capture.h"
#include "denoise.h"
#include "engine/commands.h"
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
    std::vector<std::string> notes; // one line for each default that was taken
};

/// Reads scene and environment; throws SceneError or FileError.
Stage loadStage(const Options& options);

class Renderer
{
public:
    /// Throws engine::Error and SceneError.
    Renderer(const engine::Device& device, const Stage& stage, const Options& options);

    /// Renders the next frame, starting with 0, and waits for it.
    void renderFrame();
    uint32_t frameIndex() const { return m_frame.view.frameIndex; } // of the frame rendered last

    /// The signals of the last frame as the capture format names them.
    Planes readFrame();
    /// Traces the reference of the last frame; `progress` gets the share that is done.
    Planes traceReference(const Planes& frame, uint32_t samples, const std::function<void(double)>& progress);
    /// What a set of Options::sets made of its signals in the last frame, linear.
    Signals readDenoised(size_t set);
    /// The composed picture of the last frame, of the set that is shown.
    Image readComposed();
    /// The set whose picture is the last frame's. All of them run in every frame, so that each is warm when its turn
    /// comes.
    size_t shownSet() const;

    /// How the last frame was seen, and the head of a capture of this run.
    CaptureFrame captureFrame() const;
    CaptureInfo captureInfo() const;
    /// True when the scene has no camera of its own.
    bool isFraming() const { return m_framing.has_value(); }
    double denoiserMiB(size_t set) const { return m_stages[set]->memoryMiB(); }

private:
    Camera currentCamera() const;
    Planes readSums(uint32_t samples, const Planes& frame);

    const engine::Device& m_device;
    const Stage& m_stage;
    const Options& m_options;
    ScenePose m_pose;
    std::optional<Camera> m_framing;          // of a scene without camera
    std::optional<CaptureLight> m_firstLight; // of the shadow signal, before the first frame
    PathTracer m_tracer;
    std::vector<std::unique_ptr<DenoiseStage>> m_stages; // by set
    engine::FrameRing m_ring;
    DenoiseFrame m_frame;
    uint32_t m_nextFrame = 0;
};

/// direct + sun * shadow + diffuse * diffuseFactor + specular * specularFactor of a frame's own signals.
Image composeNoisy(const Planes& frame);
/// The composed channels of a reference as a picture.
Image composedOf(const Planes& reference);
} // namespace sample
