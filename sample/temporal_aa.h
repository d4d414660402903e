// Temporal anti-aliasing after composition: jittered pictures add up to one with smooth edges.
#pragma once
#include "path_tracer.h"

namespace sample
{
class TemporalAa
{
public:
    TemporalAa(const engine::Device& device, uint32_t width, uint32_t height);

    /// Blends `composed`, which is always the same image, into the history; `before`: the view of the frame before,
    /// null after a cut. Leaves viewZ and motion of the frame and `composed` in sampled state.
    void record(VkCommandBuffer cmd, FrameImages& frame, engine::Image& composed, const View& now, const View* before);

    /// RGBA32F, linear; of the last frame.
    engine::Image& result() { return m_history[m_current]; }

private:
    std::array<engine::Image, 2> m_history; // by turns
    size_t m_current = 0;
    engine::ComputePipeline m_pipeline;
    std::array<VkDescriptorSet, 2> m_sets = {};
};
} // namespace sample
