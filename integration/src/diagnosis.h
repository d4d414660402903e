// Copies of the inputs for the host, one set per frame that the GPU may still work on, and the doctor that looks at
// them.
#pragma once
#include "frame_recordings.h"
#include "image_copies.h"
#include <nrd/doctor.h>

namespace nrd
{
/// One image to look at, and where its copy goes.
struct DiagnosedImage
{
    CopiedImage source;
    const float* DoctorFrame::*texels = nullptr;
};

class Diagnosis final : public Retirable
{
public:
    /// `name` as in IntegrationCreationDesc. Throws rhi::Error.
    Diagnosis(rhi::Device& device, const char* name);

    uint64_t lastFrame() const { return m_lastFrame; } // that was recorded, 0 = none
    InputDoctor& doctor() { return m_doctor; }

    /// Records the copies and takes the images into a state for sampled reads, which their entries then hold. Throws
    /// a Refusal or rhi::Error before anything is recorded. `input` has everything but the images.
    void record(rhi::CommandBuffer& commands, const CopyContext& context, const DoctorFrame& input,
                rhi::Span<const DiagnosedImage> images);
    /// Shows the doctor what was recorded up to this frame, which the GPU is done with. Throws a Refusal.
    void look(uint64_t lastFrame);

private:
    struct Recording
    {
        uint64_t frame = 0; // 0: free
        DoctorFrame input;
        ImageCopies copies;
        std::vector<const float * DoctorFrame::*> texels; // of the copies
    };
    Recording& freeRecording();

    rhi::Device& m_device;
    std::string m_name;
    std::unique_ptr<rhi::Pipeline> m_pipeline;
    FrameRecordings<Recording> m_recordings;
    uint64_t m_lastFrame = 0;
    InputDoctor m_doctor;
};
} // namespace nrd
