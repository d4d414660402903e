// Radiance times factors, light times shadow: from signals to a picture. Of denoised frames and of references.
#pragma once
#include "path_tracer.h"
#include "pixel_pass.h"

namespace sample
{
/// As in compose.comp.glsl.
struct ComposeConstants
{
    glm::uvec2 size = glm::uvec2(0);              // pixels
    glm::vec2 occlusionWeights = glm::vec2(0.0f); // of the lobes in a picture of occlusion; both 0: one of light
    uint32_t hasShadow = 0;
    float signalScale = 1.0f; // what the signals are multiplied by; of sums 1 / count
};

/// The signals; factors, direct light and sun are the frame's.
struct ComposeSignals
{
    engine::Image* diffuse = nullptr;
    engine::Image* specular = nullptr;
    engine::Image* shadow = nullptr;
};

class ComposePass
{
public:
    explicit ComposePass(const engine::Device& device);

    /// Leaves all inputs in sampled and `target` in storage state. They must be the same images in every call.
    void record(VkCommandBuffer cmd, FrameImages& frame, const ComposeSignals& signals, engine::Image& target,
                const ComposeConstants& constants);

private:
    engine::ComputePipeline m_pipeline;
    VkDescriptorSet m_set = VK_NULL_HANDLE;
};
} // namespace sample
