// The picture of the screen: what is viewed of both sides, tone-mapped or coloured, with the split.
#pragma once
#include "pixel_pass.h"

#include <array>
#include <vector>

namespace sample
{
/// As in display.comp.glsl.
struct DisplayConstants
{
    glm::uvec2 size = glm::uvec2(0); // pixels, set by Display
    glm::ivec2 picked = glm::ivec2(-1);
    uint32_t mode = 0; // VIEW_...
    uint32_t tone = 0; // TONE_...
    float exposure = 1.0f;
    float range = 1.0f;
    int32_t split = 1 << 20;
};

/// Left, right, and over them what the mode needs a second image for. Where null, black.
using DisplayImages = std::array<engine::Image*, 4>;

class Display
{
public:
    /// `slotCount` recordings may be pending.
    Display(const engine::Device& device, uint32_t width, uint32_t height, uint32_t slotCount);

    void record(VkCommandBuffer cmd, uint32_t slot, const DisplayImages& images, DisplayConstants constants);
    engine::Image& picture() { return m_picture; } // RGBA8, encoded for the screen

private:
    engine::Image m_picture;
    engine::Image m_black;
    engine::ComputePipeline m_pipeline;
    std::vector<VkDescriptorSet> m_sets;
};
} // namespace sample
