// A denoiser run over a capture on a Vulkan device, through NrdIntegration on the sample's own native objects.
#pragma once
#include "replay_packing.h"
#include "replay_report.h"
#include "replay_settings.h"
#include "replay_slots.h"
#include "resolution.h"

#include "engine/compute.h"

#include <nrd/integration.h>

#include <map>
#include <memory>
#include <span>

namespace sample
{
// What the colour of an SH signal is.
enum class ShResolve : uint8_t
{
    SphericalGaussians,
    SphericalHarmonics,
    Restore, // NRD_SG_RestoreDiffuse and ...Specular
    None     // extracted without a resolve
};

struct ReplayGpuDesc
{
    const Capture& capture;
    const ReplayDenoiser& denoiser;   // not NONE
    std::vector<Assignment> settings; // on top of the preset and what the capture says
    std::string device;               // as engine::DeviceDesc::device
    bool validation = false;
    nrd::Quality preset = nrd::Quality::BALANCED;
    ShResolve resolve = ShResolve::Restore;
    float confidence = 1.0f;      // [0; 1], of every pixel where the settings ask for it
    float disocclusionMix = 0.0f; // [0; 1], likewise
    Resolution resolution = {};
    bool isOverlayWanted = false;                         // of enableValidation
    std::shared_ptr<engine::Device> openDevice = nullptr; // of createReplayDevice(), in place of the two above
};

// A device that can run every denoiser; a driver opens only so many of them one after another. Throws engine::Error.
std::shared_ptr<engine::Device> createReplayDevice(const std::string& device, bool validation);

// What comes out of a frame.
struct ReplayedFrame
{
    Signals signals;
    Signals extracted; // SH that are resolved: the same with the colours before the resolve; else nothing
    Picture overlay;   // RGBA in [0; 1] for the screen; empty when not wanted or not drawn
};

// Frames go in one after the other, from 0 on. Throws engine::Error, SettingError and FileError.
class ReplayGpu
{
public:
    // Creates device, denoiser and images. Throws when the library does not offer the denoiser. Throws with the first
    // frame when the capture lacks a layer that the denoiser needs.
    explicit ReplayGpu(const ReplayGpuDesc& desc);
    ~ReplayGpu(); // waits for the device

    // Denoises the next frame. What the denoiser produces is returned when `isWanted`, else nothing is read back.
    // Sky pixels, which a denoiser does not write, are 0; their hit distance is that of a miss.
    ReplayedFrame denoise(const Planes& frame, bool isWanted);

    // Shows the next frame to the doctor instead of denoising it; what it has found so far, valid until the next call.
    std::vector<nrd::Finding> diagnose(const Planes& frame);

    // Medians over the frames from `firstFrame` on; call after the last frame.
    void reportTimes(ReplayReport& report, size_t firstFrame);
    ReplayReport::Memory memory() const;
    std::string deviceName() const;
    uint32_t validationMessageCount() const { return m_device->validationMessageCount(); }

private:
    // One way to read an output.
    struct Reading
    {
        engine::Image values;
        VkDescriptorSet set = VK_NULL_HANDLE;
        uint32_t mode = 0; // REPLAY_UNPACK_...
        bool isExtracted = false;
    };
    struct Slot
    {
        SlotRow row;
        engine::Image image;
        uint32_t divisor = 1;                 // of the capture's size
        VkDescriptorSet set = VK_NULL_HANDLE; // inputs
        std::vector<Reading> readings;        // outputs
    };
    void createIntegration();
    void applyDenoiserSettings(const ReplaySettings& settings);
    void createSlots();
    void createImage(const nrd::ResourceRequirement& requirement);
    void createPackSet(Slot& slot);
    void createReadings(Slot& slot);
    void createReading(Slot& slot, uint32_t mode, bool isExtracted);
    engine::Image& slotImage(nrd::ResourceType type);
    engine::Image& layerImage(Layer layer);
    ReplaySettings settingsOfFrame() const;
    void uploadLayers(const Planes& frame);
    void record(VkCommandBuffer cmd, const ReplaySettings& settings, bool isWanted);
    void recordPack(VkCommandBuffer cmd, Slot& slot, const ReplaySettings& settings);
    void recordUnpack(VkCommandBuffer cmd, Slot& slot);
    void recordDenoise(VkCommandBuffer cmd);
    ReplayedFrame read(const Planes& frame, bool isHistoryLength);
    void recordDiagnosis(VkCommandBuffer cmd, const ReplaySettings& settings, nrd::NrdDiagnosisImages& extra);
    static nrd::NrdUserImage userImage(const engine::Image& image);
    static void setState(engine::Image& image, const nrd::NrdUserImage& user);
    void collectTimes();
    void check(nrd::Result result, const char* action) const;

    ReplayGpuDesc m_desc;
    const CaptureInfo& m_info;
    const ReplayDenoiser& m_denoiser;
    size_t m_frameIndex = 0;
    std::shared_ptr<engine::Device> m_device;
    ReplayPacking m_packing;
    std::map<Layer, engine::Image> m_layers;
    std::map<std::string, engine::Image> m_extras; // that only the doctor looks at
    std::vector<Slot> m_slots;
    nrd::NrdUserPool m_pool;
    nrd::NrdIntegration m_integration; // after what it borrows, so that it goes first

    struct FrameTimes
    {
        double total = 0.0;
        std::vector<PassReport> passes; // of equal name added up
    };
    std::vector<FrameTimes> m_times; // element i: frame i
};
} // namespace sample
