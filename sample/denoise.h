// From the traced signals to the composed picture: packing, NrdIntegration on the sample's own images, composition.
#pragma once
#include "compose.h"
#include "denoiser_set.h"
#include "resolution.h"
#include "retrace.h"
#include "shadow_signal.h"
#include "temporal_aa.h"

#include <functional>
#include <map>
#include <nrd/integration.h>
#include <set>

namespace sample
{
/// SPIR-V in place of the library's, by the permutation's name.
using ShaderModules = std::map<std::string, std::vector<uint32_t>>;

struct DenoiseDesc
{
    DenoiserSet set;
    uint32_t width = 0; // pixels, as the tracer's
    uint32_t height = 0;
    uint32_t framesInFlight = 2;
    ReplaySettings settings;             // of the set's families; those of a frame are made anew for each
    std::vector<Assignment> assignments; // --set, for the settings of a frame
    Resolution resolution;               // of the denoisers that know one below the full size
    bool isSceneMoving = false;          // what reflections show may move on its own
    bool hasShadowSignal = false;        // as the tracer; a set without a denoiser of it shows it noisy
    bool isTimed = false;                // fills timings()
    bool hasOverlay = false;             // overlay() exists, if the denoiser has one
    bool hasTemporalAa = false;          // shown() is anti-aliased, which takes jitter
    bool hasConfidence = false; // REBLUR and RELAX are told where light has changed; needs DenoiseFrame::retrace
    const ShaderModules* shaders = nullptr; // must outlive the stage; null: the library's
};

/// What changes from frame to frame.
struct DenoiseFrame
{
    View view;
    float denoisingRange = 1000.0f;          // world units
    float deltaTimeMs = 16.667f;             // milliseconds since the frame before
    bool isCut = false;                      // no history
    const SceneLight* shadowLight = nullptr; // of the shadow signal; null without
    Retrace* retrace = nullptr;              // of the last frame; null without confidence
};

class DenoiseStage
{
public:
    /// Throws engine::Error with the library's own sentence when the denoiser cannot be created.
    DenoiseStage(const engine::Device& device, const DenoiseDesc& desc);

    /// Records everything from packing to composition; reads the frame's images, which end in sampled state and must
    /// be the same ones in every call. Frames come in order.
    void record(VkCommandBuffer cmd, FrameImages& images, const DenoiseFrame& frame);

    /// From the next frame on. The checkerboard mode must stay. Throws engine::Error with the library's own sentence
    /// when a value is refused; then the old settings stay.
    void setSettings(const ReplaySettings& settings, const std::vector<Assignment>& assignments);

    engine::Image& composed() { return m_composed; } // RGBA32F, linear
    /// What is for the eye: composed(), anti-aliased if asked for. Another image by turns.
    engine::Image& shown() { return m_temporalAa ? m_temporalAa->result() : m_composed; }
    /// RGBA32F: linear radiance, normalised hit distance. Null when the denoiser does not take the lobe.
    engine::Image* denoised(Lobe lobe);
    /// RGBA32F: what comes through, visible share of the light. Null when the shadow isn't denoised.
    engine::Image* denoisedShadow() { return m_shadow ? &m_shadow->values() : nullptr; }
    const DenoiserSet& set() const { return m_desc.set; }

    /// RGBA8, of the denoiser's own size: the validation overlay, written while enableValidation asks for it. Null
    /// without one.
    engine::Image* overlay() { return m_overlay ? &*m_overlay : nullptr; }

    /// R8, a texel per tile: how far the history of the lobe was trusted. Null without confidence.
    engine::Image* confidence(Lobe lobe);

    /// Names of the permutations its denoisers may run.
    std::set<std::string> shaders() const;

    /// All 0 without denoiser.
    nrd::MemoryStatistics memory() const;
    double memoryMiB() const { return double(memory().total) / (1024.0 * 1024.0); }
    /// GPU time by pass of a frame some frames ago; valid until the next record().
    nrd::Timings timings() const;

private:
    uint32_t strideOf(const SampleDenoiser& denoiser) const;
    void createImages();
    void createIntegration();
    void applyFamilySettings();
    nrd::CommonSettings settingsOf(const DenoiseFrame& frame) const;
    std::vector<SlotImage> slots(FrameImages& images);
    void makeConfidence(VkCommandBuffer cmd, Retrace& retrace);
    void use(const std::vector<SlotImage>& images, const std::function<nrd::Result(nrd::NrdUserPool&)>& record);
    void beginFrame(const DenoiseFrame& frame);
    void packGuides(VkCommandBuffer cmd, FrameImages& images);
    void denoiseSignals(VkCommandBuffer cmd, FrameImages& images, const DenoiseFrame& frame);
    void denoise(VkCommandBuffer cmd, const std::vector<nrd::Identifier>& identifiers,
                 const std::vector<SlotImage>& images);
    void compose(VkCommandBuffer cmd, FrameImages& images);
    void check(nrd::Result result, const char* action) const;

    const engine::Device& m_device;
    DenoiseDesc m_desc;
    engine::Image m_normalRoughness, m_composed;
    engine::Image m_signal; // REFERENCE: the composed noisy picture
    std::array<std::optional<LobeSignal>, 2> m_lobes;
    std::optional<ShadowSignal> m_shadow;
    std::optional<engine::Image> m_overlay;
    std::array<std::optional<engine::Image>, 2> m_confidences; // by lobe
    engine::ComputePipeline m_packGuides;
    VkDescriptorSet m_packGuidesSet = VK_NULL_HANDLE;
    ComposePass m_compose;
    std::optional<TemporalAa> m_temporalAa;
    nrd::NrdIntegration m_integration;
    std::optional<View> m_previous;
};

/// A in world units, B, C: what tracing and packing divide hit distances by.
glm::vec3 hitDistanceParametersOf(const ReplaySettings& settings);

/// Core features the denoiser library needs of the device; an engine asks before it creates its device.
engine::DeviceDesc denoiserDeviceDesc();
} // namespace sample
