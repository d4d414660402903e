// The two shaders between recorded layers and a denoiser's slots, and their constants.
#pragma once
#include "capture.h"
#include "engine/compute.h"

namespace sample
{
// Push constants of replay_pack.comp.glsl.
struct PackConstants
{
    float hitDistanceParameters[4]; // .xyz A, B, C
    uint32_t mode;                  // REPLAY_PACK_...
    uint32_t isDiffuse;
    uint32_t size[2];              // pixels
    float constant;                // of REPLAY_PACK_CONSTANT
    uint32_t checkerboardMode = 0; // nrd::CheckerboardMode, 0 for what is no lobe
    uint32_t frameIndex = 0;
    uint32_t lightKind = 0; // REPLAY_LIGHT_...
    float light[4] = {};    // .xyz view space, of local lights; .w radius, or tangent of the angular radius
    float frustum[4] = {};
    uint32_t stride = 1; // pixels of the layer from one of the slot to the next
};

// The light of a frame and the frame's frustum into the constants; nothing without a light.
void setLight(PackConstants& constants, const CaptureInfo& info, size_t frameIndex);

// Push constants of replay_unpack.comp.glsl.
struct UnpackConstants
{
    float worldToView[16];
    float frustum[4];
    uint32_t size[2]; // pixels
    float jitter[2];  // pixels
    uint32_t mode;    // REPLAY_UNPACK_...
    uint32_t isDiffuse;
};

// Camera, jitter and size of a frame; the rest at 0.
UnpackConstants unpackConstantsOf(const CaptureInfo& info, size_t frameIndex);

class ReplayPacking
{
public:
    ReplayPacking() = default;
    explicit ReplayPacking(const engine::Device& device);

    struct PackImages
    {
        const engine::Image &layer, &direction, &guides, &depth; // four floats each
        const engine::Image& slot;
    };
    VkDescriptorSet createSet(const PackImages& images) const;

    struct UnpackImages
    {
        const engine::Image &slot, &sh1, &guides, &depth;
        const engine::Image& values; // four floats
    };
    VkDescriptorSet createSet(const UnpackImages& images) const;

    // The images that are read are in the sampled state, the written one is in the storage state.
    void pack(VkCommandBuffer cmd, VkDescriptorSet set, const PackConstants& constants) const;
    void unpack(VkCommandBuffer cmd, VkDescriptorSet set, const UnpackConstants& constants) const;

private:
    engine::ComputePipeline m_pack;
    engine::ComputePipeline m_unpack;
};
} // namespace sample
