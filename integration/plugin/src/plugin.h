// What the C functions act on: the device, the initialised denoisers and the ring of frames. Refusals are thrown.
#pragma once
#include "frame.h"
#include "session.h"
#include <array>

namespace nrd::plugin
{
constexpr uint32_t kRingSize = 4; // frames

class Plugin
{
public:
    /// `create` is NrdIntegration::Create() but in tests.
    void setDevice(const NrdPluginDevice& device, Creator create);
    void initialize(uint32_t denoiser, Images images);
    void describeSetting(uint32_t denoiser, uint32_t index, NrdPluginSettingInfo& info);
    void setSetting(uint32_t denoiser, const char* name, double value);
    void setFrame(const NrdPluginFrame& frame);
    void execute(uint32_t eventId);
    void release(uint32_t denoiser);
    void releaseAll();

private:
    static constexpr uint32_t kDenoiserNum = static_cast<uint32_t>(Denoiser::MAX_NUM);
    // A denoiser that was initialised, else null.
    struct Initialized
    {
        std::shared_ptr<Session> session;
        std::shared_ptr<const SlottedImages> images;
    };
    using AllInitialized = std::array<Initialized, kDenoiserNum>;
    using AllSettings = std::array<DenoiserSettings, kDenoiserNum>;

    // What the main thread leaves for the events of a frame.
    struct RingSlot
    {
        std::optional<NrdPluginFrame> frame;
        AllInitialized denoisers;
        AllSettings settings;
    };
    struct Retired
    {
        std::shared_ptr<Session> session;
        uint64_t frameNum = 0; // frames set when it was released
    };
    // What one event needs.
    struct Event
    {
        NrdPluginFrame frame;
        Initialized denoiser;
        DenoiserSettings settings;
        NrdPluginCommandBufferProvider getCommandBuffer;
        void* userArg;
    };

    static AllSettings defaults();
    Event findEvent(uint32_t eventId);
    const Device& requireDevice() const;
    void retire(std::shared_ptr<Session> session);
    void collectRetired();

    std::mutex m_mutex; // of all below; never held while the engine is called or pipelines are made
    std::optional<Device> m_device;
    std::optional<FrameChecker> m_checker;
    AllInitialized m_denoisers;
    AllSettings m_settings = defaults();
    std::array<RingSlot, kRingSize> m_ring;
    std::vector<Retired> m_retired;
    uint64_t m_frameNum = 0;      // frames set
    uint64_t m_initializeNum = 0; // calls of initialize()
};

Denoiser toDenoiser(uint32_t index);                     // throws if there is none
int makeEventId(uint32_t denoiser, uint32_t frameIndex); // -1 if there is no such denoiser
} // namespace nrd::plugin
