// A reference that gathers samples while the camera rests, and its picture.
#pragma once
#include "compose.h"
#include "denoise.h"

namespace sample
{
class LiveReference
{
public:
    LiveReference(const engine::Device& device, uint32_t width, uint32_t height);

    void restart() { m_count = 0; }
    /// Records `samples` more of them and the picture of all.
    void record(VkCommandBuffer cmd, PathTracer& tracer, const View& view, uint32_t samples);

    uint32_t sampleCount() const { return m_count; }
    engine::Image& composed() { return m_composed; } // RGBA32F, linear

private:
    engine::Image m_composed;
    ComposePass m_compose;
    uint32_t m_count = 0;
};

/// Decibels of the tone-mapped pictures. Waits for the device.
double measurePsnr(const engine::Device& device, engine::Image& result, engine::Image& reference);
} // namespace sample
