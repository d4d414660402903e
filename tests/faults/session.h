// An application in little: a few denoisers over the validated device, whose functions reach the library through hooks.
#pragma once
#include <functional>
#include <inputs.h>
#include <map>
#include <memory>
#include <nrd/integration.h>
#include <options.h>
#include <test_image.h>

namespace faults
{
struct SessionDesc
{
    std::vector<nrd::Denoiser> denoisers;
    glm::ivec2 size{40, 24};
    uint32_t framesInFlight = 1;
    bool isGpuTimingEnabled = false;
    bool isPassTracingEnabled = false;
    bool createDefaultPipelines = false;
    bool hasOldBarriers = false;      // those of Vulkan 1.0
    bool isDiagnosed = false;         // each frame of the first denoiser, by a doctor of its own
    const char* dumpFolder = nullptr; // where each frame's inputs go, by a call of its own; null: nowhere
};

/// What one frame's denoisers wrote, in their order.
using Outputs = std::vector<test::Plane>;
bool isSame(const Outputs& a, const Outputs& b); // bit by bit

class Session
{
public:
    explicit Session(const SessionDesc& desc);
    ~Session();

    /// Every call of the integration goes through it; by default it must succeed.
    using Call = std::function<nrd::Result()>;
    std::function<void(const char* name, const Call& call)> make;

    void create();
    void destroy();
    void resize(glm::ivec2 size);
    /// A frame of moving content; the index need not begin at 0, but grows. `restarts`: its history begins anew.
    void frame(int index, bool restarts = false);
    /// Waits for all frames; those that ended since the last call, in order.
    std::vector<Outputs> finish();

    /// After finish(): what the doctor found, and its end.
    void diagnose();

    nrd::NrdIntegration integration;
    std::function<void()> changeSettings; // within a frame, before it is denoised
    nrd::Identifier identifier(size_t denoiser) const { return static_cast<nrd::Identifier>(denoiser + 1); }
    nrd::Denoiser denoiser(size_t index) const { return m_setups[index].denoiser; }
    const char* message() const { return m_message; } // the last that the sink was given
    uint64_t generation = 0;                          // of the images: another number makes their views anew

private:
    struct Slot;
    void record(Slot& slot, size_t denoiser, const options::Frame& frame);
    void collect(Slot& slot);
    static void keepMessage(void* self, nrd::Result result, const char* text);

    SessionDesc m_desc;
    std::vector<options::Setup> m_setups;
    std::vector<std::unique_ptr<Slot>> m_slots; // one per frame in flight
    size_t m_next = 0;
    int m_lastIndex = -1;     // of the last frame
    glm::ivec2 m_lastSize{0}; // of its images
    std::vector<Outputs> m_done;
    char m_message[512] = ""; // no string: it comes while the heap is watched
};
} // namespace faults
