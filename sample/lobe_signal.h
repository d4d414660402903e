// One lobe on its way through the denoiser: packed into input slots, and unpacked from output slots.
#pragma once
#include "path_tracer.h"
#include "pixel_pass.h"
#include "sample_denoisers.h"

#include <nrd/types.h>

#include <optional>

namespace sample
{
/// A slot of the user pool with its image.
using SlotImage = std::pair<nrd::ResourceType, engine::Image*>;

struct LobeSignalDesc
{
    Lobe lobe = Lobe::Diffuse;
    LobeFormat format = LobeFormat::Radiance; // not None
    Family family = Family::Reblur;           // of the denoiser, which packs so; Reblur or Relax
    uint32_t width = 0;                       // pixels, as the tracer's
    uint32_t height = 0;
    uint32_t stride = 1; // the denoiser takes every such pixel of every such row, and the motion of reflections so
    glm::vec3 hitDistanceParameters = glm::vec3(3.0f, 0.1f, 20.0f); // as the tracer's and the denoiser's
    nrd::CheckerboardMode checkerboard = nrd::CheckerboardMode::OFF;
};

class LobeSignal
{
public:
    LobeSignal(const engine::Device& device, const LobeSignalDesc& desc);

    /// Fills the input slots; the frame's images end in sampled state. They must be the same ones in every call.
    void recordPack(VkCommandBuffer cmd, FrameImages& frame, uint32_t frameIndex);
    /// Fills values() from the output slots, which the denoiser has written.
    void recordUnpack(VkCommandBuffer cmd, FrameImages& frame, float denoisingRange);

    /// As the tracer's and the denoiser's, from the next frame on.
    void setHitDistanceParameters(const glm::vec3& parameters) { m_desc.hitDistanceParameters = parameters; }

    /// Input and output slots; with a stride IN_SPEC_MV, too.
    std::vector<SlotImage> slots();
    /// RGBA32F: linear radiance, normalised hit distance or history length; sky: 0, 0, 0, 1.
    engine::Image& values() { return m_values; }

private:
    struct Slot
    {
        nrd::ResourceType type;
        uint32_t mode; // LOBE_...
        engine::Image image;
        VkDescriptorSet set = VK_NULL_HANDLE; // of packing
    };
    LobeSignalDesc m_desc;
    std::vector<Slot> m_inputs, m_outputs; // one or, with SH, two; and motion
    engine::Image m_values;
    engine::ComputePipeline m_pack, m_unpack;
    VkDescriptorSet m_unpackSet = VK_NULL_HANDLE;
};
} // namespace sample
