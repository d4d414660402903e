#include "diagnosis.h"
#include "refusal.h"

namespace nrd
{
Diagnosis::Diagnosis(rhi::Device& device, const char* name)
    : m_device(device), m_name(name), m_pipeline(createCopyPipeline(device, name))
{
}

Diagnosis::Recording& Diagnosis::freeRecording()
{
    if (Recording* free = findRecording(m_recordings, 0)) return *free;
    m_recordings.push_back(std::make_unique<Recording>(Recording{0, {}, {m_device, *m_pipeline, m_name.c_str()}, {}}));
    return *m_recordings.back();
}

void Diagnosis::record(rhi::CommandBuffer& commands, const CopyContext& context, const DoctorFrame& input,
                       rhi::Span<const DiagnosedImage> images)
{
    Recording& recording = freeRecording();
    std::vector<CopiedImage> sources;
    recording.texels.clear();
    for (const DiagnosedImage& image : images)
    {
        sources.push_back(image.source);
        recording.texels.push_back(image.texels);
    }
    recording.copies.reset();
    recording.copies.plan(context, sources);
    // From here on nothing fails.
    recording.input = input;
    recording.frame = m_lastFrame = context.frame;
    commands.beginLabel("diagnosis");
    recording.copies.record(commands);
    commands.endLabel();
    for (const CopiedImage& source : sources)
        source.image->state = copiedState(source.image->state, context.layoutPolicy);
}

void Diagnosis::look(uint64_t lastFrame)
{
    while (Recording* oldest = oldestRecording(m_recordings, lastFrame))
    {
        oldest->frame = 0; // also if the doctor refuses it
        for (size_t i = 0; i < oldest->texels.size(); i++) oldest->input.*oldest->texels[i] = oldest->copies.texels(i);
        const Result result = m_doctor.AddFrame(oldest->input);
        if (result == Result::FAILURE)
            throw Refusal(result, "the doctor could not look at a frame: out of host memory");
        if (result != Result::SUCCESS) throw Refusal(result, m_doctor.GetLastMessage());
    }
}
} // namespace nrd
