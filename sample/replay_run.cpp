#include "replay_run.h"
#include "replay_output.h"

#include <algorithm>

namespace sample
{
namespace
{
constexpr size_t kFirstTimedFrame = 8; // warm-up before it
} // namespace

ReplayRun::ReplayRun(const ReplayRunDesc& desc)
    : m_desc(desc), m_capture(desc.gpu.capture), m_measurer(m_capture.info(), signalSetOf(desc.gpu.denoiser))
{
    m_report.capture = m_capture.info().name;
    m_report.denoiser = desc.gpu.denoiser.name;
    m_report.width = m_capture.info().width;
    m_report.height = m_capture.info().height;
    if (desc.gpu.denoiser.family == Family::None)
    {
        if (!desc.gpu.settings.empty()) throw SettingError("--set needs a denoiser, not NONE");
        return;
    }
    m_report.preset = desc.gpu.preset;
    m_report.settings = desc.gpu.settings;
    m_report.resolution = desc.gpu.resolution;
    m_gpu = std::make_unique<ReplayGpu>(desc.gpu);
    m_report.device = m_gpu->deviceName();
}

const ReplayReport& ReplayRun::run(void (*progress)(size_t, size_t))
{
    const size_t all = m_capture.info().frames.size();
    const size_t count = m_desc.frameCount ? std::min(m_desc.frameCount, all) : all;
    for (size_t i = 0; i < count; i++)
    {
        replayFrame(i);
        progress(i + 1, count);
    }
    fillReport();
    return m_report;
}

void ReplayRun::fillReport()
{
    m_report.frames = m_measurer.frames();
    m_report.noisy = m_measurer.meanNoisy();
    m_report.denoised = m_measurer.meanDenoised();
    m_report.extracted = m_measurer.meanExtracted();
    if (!m_gpu) return;
    m_gpu->reportTimes(m_report, kFirstTimedFrame);
    m_report.memory = m_gpu->memory();
}

void ReplayRun::checkValidation() const
{
    if (const uint32_t messageCount = m_gpu ? m_gpu->validationMessageCount() : 0)
        throw engine::Error("the validation layers had " + std::to_string(messageCount) + " messages");
}

void ReplayRun::replayFrame(size_t index)
{
    const bool hasReference = !m_capture.info().frames[index].reference.empty();
    const bool isWritten = !m_desc.out.empty();
    if (!m_gpu && !hasReference) return;
    const Planes frame = m_capture.readFrame(index);
    ReplayedFrame result;
    if (m_gpu) result = m_gpu->denoise(frame, hasReference || isWritten);
    Signals& denoised = result.signals;
    m_report.nonFiniteCount += countNonFinite(denoised);
    if (hasReference)
    {
        const bool isExtracted = result.extracted.has(Signal::Diffuse) || result.extracted.has(Signal::Specular);
        m_measurer.add(index, frame, m_capture.readReference(index), m_gpu ? &denoised : nullptr,
                       isExtracted ? &result.extracted : nullptr);
        denoised[Signal::Composed] = m_measurer.pictures().denoised;
    }
    else
        compose(denoised, frame, {});
    if (isWritten) write(index, result, hasReference);
}

void ReplayRun::write(size_t index, const ReplayedFrame& result, bool hasReference) const
{
    const std::filesystem::path folder = m_desc.out;
    const Picture& composed = result.signals[Signal::Composed];
    writeDenoisedExr(folder, index, result.signals);
    writeComposedPng(folder, "denoised", index, composed);
    if (hasReference)
    {
        writeComposedPng(folder, "noisy", index, m_measurer.pictures().noisy);
        writeComposedPng(folder, "reference", index, m_measurer.pictures().reference);
    }
    if (result.overlay.exists()) writeOverlayPng(folder, index, result.overlay, composed);
}
} // namespace sample
