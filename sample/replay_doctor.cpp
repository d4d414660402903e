#include "replay_doctor.h"
#include "replay_gpu.h"

#include "engine/commands.h"
#include "engine/transfer.h"

#include <ostream>

namespace sample
{
namespace
{
// Recorded layers that only the doctor looks at.
struct ExtraRow
{
    Channel first;
    const char* layer;
    nrd::NrdUserImage nrd::NrdDiagnosisImages::*image;
    const char* rule; // that rests without it
};
constexpr ExtraRow kExtras[] = {
    {Channel::DiffuseFactorR, "diffuseFactor", &nrd::NrdDiagnosisImages::diffuseFactor,
     "whether diffuse radiance still carries albedo"},
    {Channel::SpecularFactorR, "specularFactor", &nrd::NrdDiagnosisImages::specularFactor,
     "whether specular radiance still carries its factor"},
    {Channel::SpecularDX, "specular.DX to .DZ", &nrd::NrdDiagnosisImages::specularDirection,
     "the encoding of roughness"},
};

std::vector<float> interleave(const Planes& frame, Channel first)
{
    std::vector<float> texels(frame.pixelCount() * 4, 0.0f);
    for (size_t c = 0; c < 3; c++)
    {
        const std::vector<float>& plane = frame[next(first, static_cast<int>(c))];
        for (size_t i = 0; i < plane.size(); i++) texels[i * 4 + c] = plane[i];
    }
    return texels;
}

std::string denoiserFor(const Capture& capture)
{
    const bool hasDiffuse = capture.has(Channel::DiffuseR), hasSpecular = capture.has(Channel::SpecularR);
    if (hasDiffuse && hasSpecular) return "REBLUR_DIFFUSE_SPECULAR";
    return hasSpecular ? "REBLUR_SPECULAR" : "REBLUR_DIFFUSE";
}

const ReplayDenoiser& findReblur(const std::string& name)
{
    const ReplayDenoiser* denoiser = findDenoiser(name);
    if (!denoiser || denoiser->family != Family::Reblur)
        throw SettingError("--doctor with --denoiser " + name + ": expected a REBLUR denoiser, whose inputs it knows");
    return *denoiser;
}

void printFinding(std::ostream& out, const nrd::Finding& finding)
{
    const bool isFault = finding.severity == nrd::FindingSeverity::FAULT;
    out << (isFault ? "FAULT   " : "WARNING ") << toString(finding.rule) << ": " << finding.text << '\n';
}
} // namespace

std::vector<nrd::Finding> ReplayGpu::diagnose(const Planes& frame)
{
    const ReplaySettings settings = settingsOfFrame();
    nrd::NrdDiagnosisImages extra;
    for (const ExtraRow& row : kExtras)
    {
        if (!frame.has(row.first)) continue;
        engine::Image& image = m_extras[row.layer];
        if (image.handle() == VK_NULL_HANDLE)
            image = engine::Image(
                *m_device, {row.layer, static_cast<uint32_t>(m_info.width), static_cast<uint32_t>(m_info.height)});
        const std::vector<float> texels = interleave(frame, row.first);
        engine::upload(*m_device, image, std::as_bytes(std::span(texels)));
        extra.*row.image = userImage(image);
    }
    check(m_integration.NewFrame(), "begin a frame");
    check(m_integration.SetCommonSettings(settings.common), "set the common settings");
    if (m_denoiser.family == Family::Reblur)
        check(m_integration.SetDenoiserSettings(0, settings.reblur), "set the denoiser's settings");
    if (m_slots.empty()) createSlots();
    uploadLayers(frame);
    engine::submitAndWait(*m_device, [&](VkCommandBuffer cmd) { recordDiagnosis(cmd, settings, extra); });
    for (const ExtraRow& row : kExtras)
        if (frame.has(row.first)) setState(m_extras[row.layer], extra.*row.image);
    m_frameIndex++;
    const nrd::Finding* findings = nullptr;
    uint32_t count = 0;
    check(m_integration.Diagnose(findings, count, true), "diagnose");
    return {findings, findings + count};
}

void ReplayGpu::recordDiagnosis(VkCommandBuffer cmd, const ReplaySettings& settings, nrd::NrdDiagnosisImages& extra)
{
    for (Slot& slot : m_slots)
    {
        if (slot.row.isOutput) continue;
        recordPack(cmd, slot, settings);
        m_pool[slot.row.type] = userImage(slot.image);
    }
    check(m_integration.RecordDiagnosis(cmd, m_pool, &extra), "record the diagnosis");
    for (Slot& slot : m_slots)
        if (!slot.row.isOutput) setState(slot.image, m_pool[slot.row.type]);
}

int runDoctor(const DoctorRun& run, std::ostream& out)
{
    if (run.capture.empty()) throw SettingError("no capture is given; expected the folder of one");
    const Capture capture = Capture::open(run.capture);
    const ReplayDenoiser& denoiser = findReblur(run.denoiser.empty() ? denoiserFor(capture) : run.denoiser);
    std::vector<Assignment> assignments;
    for (const std::string& setting : run.settings) assignments.push_back(parseAssignment(setting));
    ReplayGpu gpu({capture, denoiser, assignments, run.device, run.validation});

    const size_t all = capture.info().frames.size();
    const size_t count = run.frameCount ? std::min(run.frameCount, all) : all;
    std::vector<nrd::Finding> findings;
    for (size_t i = 0; i < count; i++) findings = gpu.diagnose(capture.readFrame(i));
    for (const nrd::Finding& finding : findings) printFinding(out, finding);
    for (const ExtraRow& row : kExtras)
        if (!capture.has(row.first)) out << "NOT SEEN " << row.rule << ": the capture has no " << row.layer << '\n';
    const std::string number = findings.empty() ? "no" : std::to_string(findings.size());
    out << number << (findings.size() > 1 ? " findings" : " finding") << " in " << count << " frames of "
        << capture.info().name << '\n';
    if (const uint32_t messageCount = gpu.validationMessageCount())
        throw engine::Error("the validation layers had " + std::to_string(messageCount) + " messages");
    return findings.empty() ? kHealthy : kFindings;
}
} // namespace sample
