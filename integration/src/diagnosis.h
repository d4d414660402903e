// Copies of the inputs for the host, one set per frame that the GPU may still work on, and the doctor that looks at
// them.
#pragma once
#include "retire_queue.h"
#include "view_cache.h"
#include <nrd/doctor.h>
#include <rhi/device.h>
#include <vector>

namespace nrd
{
/// One image to look at.
struct DiagnosedImage
{
    const char* name = "";
    NrdUserImage* image = nullptr;
    const float* DoctorFrame::*texels = nullptr; // where its copy goes
};

/// What recording reads and takes from; all borrowed for one call.
struct DiagnosisContext
{
    ViewCache& views;
    RetireQueue& retired;
    LayoutPolicy layoutPolicy;
    uint64_t frame;
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
    void record(rhi::CommandBuffer& commands, const DiagnosisContext& context, const DoctorFrame& input,
                rhi::Span<const DiagnosedImage> images);
    /// Shows the doctor what was recorded up to this frame, which the GPU is done with. Throws a Refusal.
    void look(uint64_t lastFrame);

private:
    struct Copy
    {
        const float* DoctorFrame::*texels;
        const rhi::Buffer* buffer;
        const rhi::DescriptorSet* set;
        uint32_t width, height;
    };
    struct Recording
    {
        uint64_t frame = 0; // 0: free
        DoctorFrame input;
        std::vector<std::unique_ptr<rhi::Buffer>> buffers; // by the image's place in the list
        std::unique_ptr<rhi::DescriptorPool> descriptors;
        std::vector<Copy> copies;
    };

    Recording& freeRecording();
    const rhi::Buffer& bufferOf(Recording& recording, size_t index, uint64_t size);
    void plan(Recording& recording, const DiagnosisContext& context, rhi::Span<const DiagnosedImage> images);

    rhi::Device& m_device;
    std::string m_name;
    std::unique_ptr<rhi::Pipeline> m_pipeline;
    std::vector<std::unique_ptr<Recording>> m_recordings;
    std::vector<rhi::TextureBarrier> m_textureBarriers; // of the call that is being recorded
    std::vector<rhi::BufferBarrier> m_bufferBarriers;
    uint64_t m_lastFrame = 0;
    InputDoctor m_doctor;
};
} // namespace nrd
