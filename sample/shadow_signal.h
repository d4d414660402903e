// The shadow on its way through the denoiser: packed into input slots, and unpacked from the output slot.
#pragma once
#include "lobe_signal.h"

namespace sample
{
struct ShadowSignalDesc
{
    bool isTranslucent = false; // SIGMA_SHADOW_TRANSLUCENCY
    uint32_t width = 0;         // pixels, as the tracer's
    uint32_t height = 0;
    uint32_t stride = 1; // the denoiser takes every such pixel of every such row
};

class ShadowSignal
{
public:
    ShadowSignal(const engine::Device& device, const ShadowSignalDesc& desc);

    /// Fills the input slots; the frame's images end in sampled state. They must be the same ones in every call.
    void recordPack(VkCommandBuffer cmd, FrameImages& frame, const SceneLight& light);
    /// Fills values() from the output slot, which the denoiser has written.
    void recordUnpack(VkCommandBuffer cmd, FrameImages& frame, float denoisingRange);

    /// IN_PENUMBRA (R16F); translucent: IN_TRANSLUCENCY (RGBA8); OUT_SHADOW_TRANSLUCENCY (R8, translucent: RGBA8).
    std::vector<SlotImage> slots();
    /// RGBA32F: .rgb what comes through, .w the visible share of the light; sky: 1.
    engine::Image& values() { return m_values; }

private:
    struct Input
    {
        nrd::ResourceType type;
        uint32_t mode; // SHADOW_...
        engine::Image image;
        VkDescriptorSet set = VK_NULL_HANDLE;
    };
    ShadowSignalDesc m_desc;
    std::vector<Input> m_inputs;
    engine::Image m_output, m_values;
    engine::ComputePipeline m_pack, m_unpack;
    VkDescriptorSet m_unpackSet = VK_NULL_HANDLE;
};
} // namespace sample
