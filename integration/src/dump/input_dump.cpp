#include "input_dump.h"
#include "../refusal.h"
#include "capture_json.h"
#include <algorithm>

namespace nrd::dump
{
InputDump::InputDump(rhi::Device& device, const char* name, const char* folder, uint32_t frameCount)
    : m_device(device), m_name(name), m_folder(folder), m_pipeline(createCopyPipeline(device, name)),
      m_framesLeft(frameCount)
{
    std::error_code error;
    std::filesystem::create_directories(m_folder, error);
    if (!std::filesystem::is_directory(m_folder, error))
        throw Refusal(Result::FAILURE, sentence("DumpInputs(): the folder %s cannot be created", folder));
}

bool InputDump::hasSize(const uint16_t (&rectSize)[2]) const
{
    return m_lastFrame == 0 || std::equal(m_size, m_size + 2, rectSize);
}

void InputDump::stop(const char* reason)
{
    if (m_isStopped) return;
    m_isStopped = true;
    m_framesLeft = 0;
    m_notes.push_back(reason);
}

bool InputDump::has(uint64_t frame, ResourceType type) const
{
    const Recording* const recording = findRecording(m_recordings, frame);
    return recording && std::any_of(recording->slots.begin(), recording->slots.end(),
                                    [&](const SlotContext& slot) { return slot.type == type; });
}

InputDump::Recording& InputDump::recordingOf(uint64_t frame)
{
    if (Recording* begun = findRecording(m_recordings, frame)) return *begun;
    if (Recording* free = findRecording(m_recordings, 0)) return *free;
    m_recordings.push_back(std::make_unique<Recording>(Recording{0, {}, {m_device, *m_pipeline, m_name.c_str()}, {}}));
    return *m_recordings.back();
}

void InputDump::plan(const CopyContext& context, const FrameContext& frame, std::vector<DumpedImage> images)
{
    std::erase_if(images, [&](const DumpedImage& image) { return has(context.frame, image.context.type); });
    m_plannedSources.clear();
    m_plannedSlots.clear();
    for (const DumpedImage& image : images)
    {
        m_plannedSources.push_back(image.source);
        m_plannedSlots.push_back(image.context);
    }
    m_planned = &recordingOf(context.frame);
    if (m_planned->frame == 0) m_planned->copies.reset();
    m_planned->copies.plan(context, m_plannedSources);
    m_planned->slots.reserve(m_planned->slots.size() + m_plannedSlots.size());
    m_plannedContext = frame;
}

void InputDump::record(rhi::CommandBuffer& commands, const CopyContext& context)
{
    if (m_planned->frame == 0)
    {
        m_planned->frame = m_lastFrame = context.frame;
        m_planned->slots.clear();
        m_planned->context = m_plannedContext;
        std::copy_n(m_plannedContext.common.rectSize, 2, m_size);
        m_framesLeft--;
        m_pending++;
    }
    if (m_plannedContext.hasLight) // of any of the frame's calls
    {
        m_planned->context.hasLight = true;
        m_planned->context.light = m_plannedContext.light;
    }
    m_planned->slots.insert(m_planned->slots.end(), m_plannedSlots.begin(), m_plannedSlots.end());
    commands.beginLabel("dump of the inputs");
    m_planned->copies.record(commands);
    commands.endLabel();
}

void InputDump::write(uint64_t lastFrame)
{
    while (Recording* oldest = oldestRecording(m_recordings, lastFrame))
    {
        writeFrame(*oldest);
        oldest->frame = 0;
        m_pending--;
    }
}

void InputDump::writeFrame(Recording& recording)
{
    std::vector<SlotTexels> slots;
    for (size_t i = 0; i < recording.slots.size(); i++)
        slots.push_back({recording.slots[i], recording.copies.texels(i)});
    std::vector<std::string> notes;
    const Channels channels = unpackFrame(recording.context, slots, notes);
    for (const std::string& note : notes) m_notes.push_back(sentence("frame %zu: %s", m_written.size(), note.c_str()));
    const uint16_t* const size = recording.context.common.rectSize;
    writeExr(m_folder / frameFileName(m_written.size()), size[0], size[1], channels);
    m_written.push_back(recording.context);
    writeCaptureJson(m_folder, m_written, m_notes); // after each frame: what is there can be read after a crash
}
} // namespace nrd::dump
