// NrdIntegration::DumpInputs(): copies of the inputs of some frames, written as a capture when the GPU is done.
#pragma once
#include "../frame_recordings.h"
#include "../image_copies.h"
#include "dump_frame.h"

namespace nrd::dump
{
/// An input to copy, with what is needed to read it.
struct DumpedImage
{
    CopiedImage source;
    SlotContext context;
};

class InputDump final : public Retirable
{
public:
    /// Creates the folder. `name` as in IntegrationCreationDesc. Throws a Refusal or rhi::Error.
    InputDump(rhi::Device& device, const char* name, const char* folder, uint32_t frameCount);

    /// More images of this frame are wanted.
    bool wants(uint64_t frame) const { return m_framesLeft > 0 || (frame == m_lastFrame && !m_isStopped); }
    bool has(uint64_t frame, ResourceType type) const; // of this frame, already
    /// Throws a Refusal or rhi::Error, and then nothing has changed.
    void plan(const CopyContext& context, const FrameContext& frame, std::vector<DumpedImage> images);
    /// Records what was planned last.
    void record(rhi::CommandBuffer& commands, const CopyContext& context);
    rhi::Span<const CopiedImage> planned() const { return m_plannedSources; }

    bool hasSize(const uint16_t (&rectSize)[2]) const; // as the frames so far
    /// No frames but those recorded; `reason` for capture.json.
    void stop(const char* reason);
    /// Writes what was recorded up to this frame, which the GPU is done with. Throws a Refusal.
    void write(uint64_t lastFrame);
    bool isFinished() const { return m_framesLeft == 0 && m_pending == 0; }

private:
    struct Recording
    {
        uint64_t frame = 0; // 0: free
        FrameContext context;
        ImageCopies copies;
        std::vector<SlotContext> slots; // of the copies
    };
    Recording& recordingOf(uint64_t frame);
    void writeFrame(Recording& recording);

    rhi::Device& m_device;
    std::string m_name;
    std::filesystem::path m_folder;
    std::unique_ptr<rhi::Pipeline> m_pipeline;
    FrameRecordings<Recording> m_recordings;
    Recording* m_planned = nullptr;
    std::vector<CopiedImage> m_plannedSources;
    std::vector<SlotContext> m_plannedSlots;
    FrameContext m_plannedContext;
    uint32_t m_framesLeft;    // to begin
    uint32_t m_pending = 0;   // recordings that are not free
    uint64_t m_lastFrame = 0; // that was begun
    bool m_isStopped = false;
    uint16_t m_size[2] = {}; // pixels of the first frame
    std::vector<FrameContext> m_written;
    std::vector<std::string> m_notes;
};
} // namespace nrd::dump
