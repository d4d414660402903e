// One run of the sample: frame after frame is posed, traced and denoised; what is asked for is read back.
#pragma once
#include "capture.h"
#include "engine/commands.h"
#include "options.h"
#include "signals.h"

#include <functional>

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
    /// What the denoiser made of the lobes in the last frame, linear.
    Signals readDenoised();
    /// The composed picture of the last frame.
    Image readComposed();

    /// How the last frame was seen, and the head of a capture of this run.
    CaptureFrame captureFrame() const;
    CaptureInfo captureInfo() const;
    /// True when the scene has no camera of its own.
    bool isFraming() const { return m_framing.has_value(); }
    double denoiserMiB() const { return m_denoise.memoryMiB(); }

private:
    Camera currentCamera() const;
    Planes readSums(uint32_t samples, const Planes& frame);

    const engine::Device& m_device;
    const Stage& m_stage;
    const Options& m_options;
    ScenePose m_pose;
    std::optional<Camera> m_framing; // of a scene without camera
    PathTracer m_tracer;
    DenoiseStage m_denoise;
    engine::FrameRing m_ring;
    DenoiseFrame m_frame;
    uint32_t m_nextFrame = 0;
};

/// direct + diffuse * diffuseFactor + specular * specularFactor of a frame's own signals.
Image composeNoisy(const Planes& frame);
/// The composed channels of a reference as a picture.
Image composedOf(const Planes& reference);
} // namespace sample
