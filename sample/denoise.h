// From the traced signals to the composed picture: packing, NrdIntegration on the sample's own images, composition.
#pragma once
#include "path_tracer.h"

#include <nrd/integration.h>

namespace sample
{
enum class DenoiserChoice : uint8_t
{
    None, // composes the noisy signals
    ReblurDiffuseSpecular,
    Reference // accumulates the composed noisy picture
};

struct DenoiseDesc
{
    DenoiserChoice denoiser = DenoiserChoice::ReblurDiffuseSpecular;
    uint32_t width = 0; // pixels, as the tracer's
    uint32_t height = 0;
    uint32_t framesInFlight = 2;
    glm::vec3 hitDistanceParameters = glm::vec3(3.0f, 0.1f, 20.0f); // as the tracer's
};

/// What changes from frame to frame.
struct DenoiseFrame
{
    View view;
    float denoisingRange = 1000.0f; // world units
    float deltaTimeMs = 16.667f;    // milliseconds since the frame before
    bool isCut = false;             // no history
};

class DenoiseStage
{
public:
    /// Throws engine::Error with the library's own sentence when the denoiser cannot be created.
    DenoiseStage(const engine::Device& device, const DenoiseDesc& desc);

    /// Records everything from packing to composition; reads the frame's images, which end in sampled state.
    /// Frames come in order, and the device has finished the one `framesInFlight` frames ago.
    void record(VkCommandBuffer cmd, FrameImages& images, const DenoiseFrame& frame);

    engine::Image& composed() { return m_composed; } // RGBA32F, linear
    engine::Image& diffuse() { return m_diffuse; }   // RGBA32F: linear radiance, normalised hit distance
    engine::Image& specular() { return m_specular; }

    /// MiB of the denoiser's pools; 0 without denoiser.
    double memoryMiB() const;

private:
    void createImages();
    void createIntegration();
    void pack(VkCommandBuffer cmd, FrameImages& images);
    void denoise(VkCommandBuffer cmd, FrameImages& images, const DenoiseFrame& frame);
    void compose(VkCommandBuffer cmd, FrameImages& images, float denoisingRange);
    void check(nrd::Result result, const char* action) const;

    const engine::Device& m_device;
    DenoiseDesc m_desc;
    engine::Image m_normalRoughness, m_noisyDiffuse, m_noisySpecular; // inputs
    engine::Image m_denoisedDiffuse, m_denoisedSpecular;              // outputs
    engine::Image m_composed, m_diffuse, m_specular, m_signal;
    engine::ComputePipeline m_pack, m_compose;
    std::vector<VkDescriptorSet> m_packSets, m_composeSets; // one per frame in flight
    nrd::NrdIntegration m_integration;
    std::optional<View> m_previous;
    uint32_t m_slot = 0;
};

/// Core features the denoiser library needs of the device; an engine asks before it creates its device.
engine::DeviceDesc denoiserDeviceDesc();
} // namespace sample
