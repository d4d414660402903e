// One created integration, over any RHI device. Refusals are thrown; NrdIntegration turns them into results.
#pragma once
#include "diagnosis.h"
#include "dispatch.h"
#include "dump/input_dump.h"
#include "history_transfer.h"
#include "recordings.h"
#include "refusal.h"
#include "unique_instance.h"
#include <nrd/integration.h>
#include <optional>
#include <string>
#include <variant>

namespace nrd
{
/// Throws a Refusal that names the field.
void checkResourceSize(uint32_t width, uint32_t height);

class Core
{
public:
    /// `device` must outlive it; `desc.native` is not read.
    Core(rhi::Device& device, const IntegrationCreationDesc& desc, const InstanceCreationDesc& instanceDesc);

    static PoolMemoryRequirements memoryRequirements(rhi::Device& device, const IntegrationCreationDesc& desc,
                                                     const InstanceCreationDesc& instanceDesc);

    void resize(uint32_t width, uint32_t height, const NrdMemory& transientMemory);
    void newFrame();
    void setCommonSettings(const CommonSettings& settings);
    template <class Settings> void setDenoiserSettings(Identifier identifier, const Settings& settings)
    {
        DenoiserState& denoiser = find(identifier);
        check(setSettings(identifier, settings));
        denoiser.settings = settings;
    }
    void denoise(VkCommandBuffer commandBuffer, rhi::Span<const Identifier> identifiers, NrdUserPool& userPool,
                 const DenoiseOptions& options);
    /// Whether what was recorded under options.recording does for this frame.
    bool repeat(rhi::Span<const Identifier> identifiers, NrdUserPool& userPool, const DenoiseOptions& options);
    void recordDiagnosis(VkCommandBuffer commandBuffer, NrdUserPool& userPool, NrdDiagnosisImages* extra);
    rhi::Span<const Finding> diagnose(bool isGpuIdle);
    void endDiagnosis();
    void dumpInputs(const char* folder, uint32_t frameCount);
    /// Writes what the GPU has certainly finished, or everything. Throws a Refusal, and then the dump has ended.
    void writeDump(bool isGpuIdle);
    bool isDumping() const { return m_dump != nullptr; }
    void forget(VkImage image) { m_views.forget(image, m_retired); }

    Timings timings() const { return m_timer->timings(); }
    LastPass lastPass() const { return m_trace->last(); }
    bool isTraced() const { return m_desc.isPassTracingEnabled; }
    MemoryStatistics memoryStatistics() const;
    NrdMemory transientMemory() const;
    IntegrationStatistics statistics() const;
    const Instance& instance() const { return *m_instance; }
    Pools& pools() { return *m_pools; }

private:
    /// What an identifier stands for; what makes confidence comes last.
    struct DenoiserState
    {
        DenoiserDesc desc;
        // As set last, for dumps and diagnoses.
        std::variant<std::monostate, ReblurSettings, RelaxSettings, SigmaSettings, ReferenceSettings,
                     ConfidenceSettings>
            settings;
        uint64_t lastFrame = 0;       // that it was denoised in
        bool isHistoryBroken = false; // its last request was planned, but not recorded

        bool isConfidence() const { return desc.identifier == kConfidenceIdentifier; }
        const char* name() const { return isConfidence() ? "ComputeConfidence()" : toString(desc.denoiser); }
    };
    // Of a failed creation there is no instance to ask; an instance keeps its sink for life.
    struct CreationMessage
    {
        char text[512] = "the descriptor library could not create its instance";
        static void report(void* userArg, Result result, const char* text);
    };
    struct WrappedCommands
    {
        VkCommandBuffer handle = VK_NULL_HANDLE;
        std::unique_ptr<rhi::CommandBuffer> commands;
    };

    const InstanceDesc& description() const { return GetInstanceDesc(*m_instance); }
    static InstanceCreationDesc forDevice(InstanceCreationDesc desc, const rhi::Device& device);
    static UniqueInstance createInstance(InstanceCreationDesc desc, CreationMessage& message);
    static std::vector<DenoiserState> denoisersOf(const InstanceCreationDesc& desc);
    UniqueInstance createScratchInstance(); // like the one there is
    void createFrameResources();
    void createDefaultPipelines();
    bool isTransientShared() const { return m_desc.isTransientMemoryShared || m_desc.transientMemory.memory; }
    /// Histories begin anew, each with the next request of its denoiser.
    void dropHistory();
    void planTransfer();
    void recordTransfer(rhi::CommandBuffer& commands);
    bool isTransferPending() const { return m_transfer && m_transfer->isPending(); }
    DenoiserState& find(Identifier identifier);
    template <class Settings> Result setSettings(Identifier identifier, const Settings& s)
    {
        if constexpr (std::is_same_v<Settings, ConfidenceSettings>)
            return SetConfidenceSettings(*m_instance, s);
        else
            return SetDenoiserSettings(*m_instance, identifier, s);
    }
    void check(Result result) const; // of the descriptor library
    void checkRequest(rhi::Span<const Identifier> identifiers, const NrdUserPool& userPool);
    void checkUserPool(const DenoiserState& denoiser, const NrdUserPool& userPool) const;
    /// A call that failed after the library had planned it left histories half-way: they begin anew. False if none did.
    bool repairHistory(rhi::Span<const Identifier> identifiers);
    std::vector<DiagnosedImage> diagnosedImages(NrdUserPool& userPool, NrdDiagnosisImages* extra);
    void lookAtDiagnosis(bool isGpuIdle);
    CopyContext copyContext() { return {m_views, m_retired, m_desc.layoutPolicy, m_frame}; }
    /// Ends the dump where a capture cannot hold what this call has.
    bool isDumped(rhi::Span<const Identifier> identifiers);
    std::vector<dump::DumpedImage> dumpedImages(rhi::Span<const Identifier> identifiers, NrdUserPool& userPool);
    /// Plans the copies and enters the states in which they leave their images.
    void planDump(rhi::Span<const Identifier> identifiers, NrdUserPool& userPool);
    PlanContext planContext(NrdUserPool& userPool, const NrdUserPool& arrival);
    FrameSets& frameSets() { return m_frameSets[static_cast<size_t>(m_frame % m_desc.framesInFlight)]; }
    /// Recording also tells the host of each pass, so that it cannot be skipped.
    bool isObserved() const { return m_desc.isGpuTimingEnabled || m_desc.isPassTracingEnabled; }
    /// The dispatches of this frame, asked for at most once: they advance the history.
    rhi::Span<const DispatchDesc> request(rhi::Span<const Identifier> identifiers);
    void finishCall(rhi::Span<const Identifier> identifiers, size_t dispatchCount);
    rhi::CommandBuffer& wrap(VkCommandBuffer commandBuffer);

    rhi::Device& m_device;
    std::string m_name;
    IntegrationCreationDesc m_desc;
    InstanceCreationDesc m_instanceDesc;
    std::vector<DenoiserState> m_denoisers;
    CreationMessage m_creationMessage;
    UniqueInstance m_instance;

    MemorySource m_memory; // before the pools, the retired ones too
    Pipelines m_pipelines;
    ViewCache m_views;
    RetireQueue m_retired;
    std::unique_ptr<Pools> m_pools;
    TransferPipelines m_transferPipelines;
    std::optional<HistoryTransfer> m_transfer; // since a Resize(), to the end of the frame that moves the history
    std::optional<ConstantRing> m_constants;
    std::optional<FrameTimer> m_timer;
    std::optional<PassTrace> m_trace;
    std::optional<Planner> m_planner;
    std::vector<FrameSets> m_frameSets;             // one per frame in flight
    std::vector<WrappedCommands> m_wrappedCommands; // the latest, round robin
    size_t m_nextWrapped = 0;

    std::unique_ptr<Diagnosis> m_diagnosis; // null: not asked for

    std::unique_ptr<dump::InputDump> m_dump; // null: not asked for, or all is written

    Recordings m_recordings;
    // Asked for by repeat(), for the denoise() that records them; valid while the library is asked for no others.
    std::vector<Identifier> m_requested;
    rhi::Span<const DispatchDesc> m_requestedDispatches;

    uint64_t m_frame = 0;         // NewFrame() calls
    uint64_t m_settingsFrame = 0; // of the last common settings, 0 = none since creation or resize
    bool m_hasFrameIndex = false;
    uint64_t m_frameIndexFrame = 0; // that the index below was given in
    CommonSettings m_common;
    uint32_t m_dispatchesLeft = 0; // in this frame
};
} // namespace nrd
