// What history confidence is made of: one sample per tile of the last frame, and the same path through the scene as it
// is now.
#pragma once
#include "path_tracer.h"

namespace sample
{
class Retrace
{
public:
    static constexpr uint32_t kTileSize = 5; // pixels a side: one path in 25

    Retrace(const engine::Device& device, uint32_t width, uint32_t height);

    /// Between posing the scene and tracing a frame: `tracer` still has the images of the frame before, seen by
    /// `lastView`. Leaves its own images in storage state.
    void record(VkCommandBuffer cmd, PathTracer& tracer, const View& lastView);

    engine::Image& storedSample() { return m_stored; }
    engine::Image& storedNormalRoughness() { return m_normalRoughness; }
    engine::Image& retracedSample() { return m_retraced; }

private:
    void store(VkCommandBuffer cmd, FrameImages& frame, uint32_t stride);

    glm::uvec2 m_size, m_tiles;
    engine::Image m_stored, m_normalRoughness, m_retraced;
    engine::ComputePipeline m_store;
    VkDescriptorSet m_storeSet = VK_NULL_HANDLE;
};
} // namespace sample
