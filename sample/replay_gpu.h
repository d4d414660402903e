// A denoiser run over a capture on a Vulkan device, through NrdIntegration on the sample's own native objects.
#pragma once
#include "replay_report.h"
#include "replay_settings.h"
#include "replay_slots.h"

#include "engine/compute.h"

#include <nrd/integration.h>

#include <map>
#include <memory>
#include <span>

namespace sample
{
struct ReplayGpuDesc
{
    const Capture& capture;
    const ReplayDenoiser& denoiser;   // not NONE
    std::vector<Assignment> settings; // on top of what the capture says
    std::string device;               // as engine::DeviceDesc::device
    bool validation = false;
};

// Frames go in one after the other, from 0 on. Throws engine::Error, SettingError and FileError.
class ReplayGpu
{
public:
    // Creates device, denoiser and images. Throws when the library does not offer the denoiser, and when the capture
    // lacks a layer it needs.
    explicit ReplayGpu(const ReplayGpuDesc& desc);
    ~ReplayGpu(); // waits for the device

    // Denoises the next frame. The signals the denoiser produces are returned when `isWanted`, else nothing is read
    // back. Sky pixels, which a denoiser does not write, are 0; their hit distance is that of a miss.
    Signals denoise(const Planes& frame, bool isWanted);

    // Shows the next frame to the doctor instead of denoising it; what it has found so far, valid until the next call.
    std::vector<nrd::Finding> diagnose(const Planes& frame);

    // Medians over the frames from `firstFrame` on; call after the last frame.
    void reportTimes(ReplayReport& report, size_t firstFrame);
    ReplayReport::Memory memory() const;
    std::string deviceName() const;
    uint32_t validationMessageCount() const { return m_device->validationMessageCount(); }

private:
    struct Slot
    {
        SlotRow row;
        engine::Image image;
        engine::Image values; // outputs: unpacked
        VkDescriptorSet set = VK_NULL_HANDLE;
    };
    void createIntegration(const ReplayGpuDesc& desc);
    void createSlots(const ReplayGpuDesc& desc);
    void createPipelines();
    engine::Image& layerImage(Layer layer);
    ReplaySettings settingsOfFrame() const;
    void uploadLayers(const Planes& frame);
    void record(VkCommandBuffer cmd, const ReplaySettings& settings, bool isWanted);
    void recordPack(VkCommandBuffer cmd, Slot& slot, const nrd::HitDistanceParameters& parameters);
    void recordUnpack(VkCommandBuffer cmd, Slot& slot);
    void recordDenoise(VkCommandBuffer cmd);
    void recordDiagnosis(VkCommandBuffer cmd, const ReplaySettings& settings, nrd::NrdDiagnosisImages& extra);
    static nrd::NrdUserImage userImage(const engine::Image& image);
    static void setState(engine::Image& image, const nrd::NrdUserImage& user);
    Signals readSignals(const Planes& frame);
    void collectTimes();
    void check(nrd::Result result, const char* action) const;

    const CaptureInfo& m_info;
    const ReplayDenoiser& m_denoiser;
    std::vector<Assignment> m_assignments;
    size_t m_frameIndex = 0;
    std::unique_ptr<engine::Device> m_device;
    engine::ComputePipeline m_pack;
    engine::ComputePipeline m_unpack;
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
