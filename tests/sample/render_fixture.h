// Runs of the whole sample, tracer and denoiser, on a device of their own with validation on; pictures to measure.
#pragma once
#include "measures.h"
#include "renderer.h"

namespace test
{
/// A run at a small size, with jitter off.
sample::Options renderOptions(const char* denoiser, bool hasPsr);

/// A renderer with what it refers to.
class Run
{
public:
    Run(sample::Scene scene, std::optional<sample::Environment> sky, const sample::Options& options);
    ~Run(); // checks that the device had nothing to say

    sample::Renderer& renderer() { return m_renderer; }
    void renderFrames(uint32_t count);
    /// The next frame, at that time of the animation; seconds.
    void renderAt(double time);
    /// Of the last frame: denoised and composed; by many samples.
    sample::Picture shown();
    sample::Picture reference(uint32_t samples);
    /// Where the primary surface of the last frame has that material.
    sample::Mask maskOf(int material);

private:
    sample::Options m_options;
    sample::Stage m_stage;
    sample::Renderer m_renderer;
};

/// FLIP of two linear pictures.
double flipOf(const sample::Picture& result, const sample::Picture& reference, const sample::Mask& mask);
} // namespace test
