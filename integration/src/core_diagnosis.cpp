// The part of Core that shows an application's inputs to the doctor.
#include "convert.h"
#include "core.h"
#include "user_pool.h"
#include <rhi/vulkan.h>

namespace nrd
{
namespace
{
struct DiagnosedSlot
{
    ResourceType type;
    const float* DoctorFrame::*texels;
    bool isReblur; // packed as only that family does
};
constexpr DiagnosedSlot kSlots[] = {
    {ResourceType::IN_VIEWZ, &DoctorFrame::viewZ, false},
    {ResourceType::IN_MV, &DoctorFrame::motion, false},
    {ResourceType::IN_NORMAL_ROUGHNESS, &DoctorFrame::normalRoughness, false},
    {ResourceType::IN_DIFF_RADIANCE_HITDIST, &DoctorFrame::diffuse, true},
    {ResourceType::IN_SPEC_RADIANCE_HITDIST, &DoctorFrame::specular, true},
};

struct ExtraImage
{
    const char* name;
    NrdUserImage NrdDiagnosisImages::*image;
    const float* DoctorFrame::*texels;
};
constexpr ExtraImage kExtraImages[] = {
    {"diffuseFactor", &NrdDiagnosisImages::diffuseFactor, &DoctorFrame::diffuseFactor},
    {"specularFactor", &NrdDiagnosisImages::specularFactor, &DoctorFrame::specularFactor},
    {"specularDirection", &NrdDiagnosisImages::specularDirection, &DoctorFrame::specularDirection},
};

bool isReblur(Denoiser denoiser) { return denoiser <= Denoiser::REBLUR_DIFFUSE_DIRECTIONAL_OCCLUSION; }

// Empty, or what is wrong with an image that no denoiser asks for.
std::string findExtraError(const NrdUserImage& image, const char* name, uint32_t width, uint32_t height)
{
    const rhi::FormatInfo& format = rhi::formatInfo(rhi::fromVulkan(image.format));
    if (format.texelSize == 0 || format.formatClass != rhi::FormatClass::Float)
        return sentence("%s: VkFormat %d is not one that can be read as floats", name, int(image.format));
    if (image.usage != 0 && (image.usage & VK_IMAGE_USAGE_SAMPLED_BIT) == 0)
        return sentence("%s: the image was created without VK_IMAGE_USAGE_SAMPLED_BIT", name);
    if (image.width == width && image.height == height) return {};
    return sentence("%s: the image is %u x %u, but the resource size is %u x %u", name, image.width, image.height,
                    width, height);
}

void checkStates(const std::vector<DiagnosedImage>& images)
{
    for (const DiagnosedImage& a : images)
        for (const DiagnosedImage& b : images)
            if (a.source.image->image == b.source.image->image && a.source.image->state != b.source.image->state)
                throw Refusal(Result::INVALID_ARGUMENT,
                              sentence("%s and %s: one image in two states (layout, access or stages differ)",
                                       a.source.name, b.source.name));
}
} // namespace

std::vector<DiagnosedImage> Core::diagnosedImages(NrdUserPool& userPool, NrdDiagnosisImages* extra)
{
    std::vector<DiagnosedImage> images;
    const SlotRules rules = {m_desc.resourceWidth, m_desc.resourceHeight, description().normalEncoding};
    const std::string stateError = findStateConflict(userPool);
    if (!stateError.empty()) throw Refusal(Result::INVALID_ARGUMENT, stateError);
    for (const DiagnosedSlot& slot : kSlots)
        for (const DenoiserState& denoiser : m_denoisers)
        {
            const ResourceRequirement* needs = nullptr;
            uint32_t needCount = 0;
            check(GetRequiredResources(*m_instance, denoiser.desc.identifier, needs, needCount));
            const auto need = std::find_if(needs, needs + needCount,
                                           [&](const ResourceRequirement& r) { return r.type == slot.type; });
            if (need == needs + needCount || (slot.isReblur && !isReblur(denoiser.desc.denoiser))) continue;
            if (userPool[slot.type].image == VK_NULL_HANDLE) break; // its rules rest
            const std::string error = findError(userPool[slot.type], *need, rules, denoiser.name());
            if (!error.empty()) throw Refusal(Result::INVALID_ARGUMENT, error);
            images.push_back({{toString(slot.type), &userPool[slot.type]}, slot.texels});
            break;
        }
    if (images.empty() || images[0].texels != &DoctorFrame::viewZ)
        throw Refusal(Result::INVALID_ARGUMENT,
                      "IN_VIEWZ: the slot is empty or no denoiser of the instance reads it, but the doctor needs it");
    for (const ExtraImage& row : kExtraImages)
    {
        if (!extra || (extra->*row.image).image == VK_NULL_HANDLE) continue;
        const std::string error = findExtraError(extra->*row.image, row.name, rules.width, rules.height);
        if (!error.empty()) throw Refusal(Result::INVALID_ARGUMENT, error);
        images.push_back({{row.name, &(extra->*row.image)}, row.texels});
    }
    checkStates(images);
    return images;
}

void Core::recordDiagnosis(VkCommandBuffer commandBuffer, NrdUserPool& userPool, NrdDiagnosisImages* extra)
{
    if (commandBuffer == VK_NULL_HANDLE) throw Refusal(Result::INVALID_ARGUMENT, "commandBuffer is null");
    if (m_frame == 0) throw Refusal(Result::INVALID_ARGUMENT, "NewFrame() must be called before RecordDiagnosis()");
    if (m_settingsFrame != m_frame)
        throw Refusal(Result::INVALID_ARGUMENT,
                      "SetCommonSettings() must be called between NewFrame() or Resize() and RecordDiagnosis()");
    if (m_diagnosis && m_diagnosis->lastFrame() == m_frame)
        throw Refusal(Result::INVALID_ARGUMENT, "RecordDiagnosis() is called twice in one frame");
    const std::vector<DiagnosedImage> images = diagnosedImages(userPool, extra);
    if (!m_diagnosis) m_diagnosis = std::make_unique<Diagnosis>(m_device, m_desc.name);
    lookAtDiagnosis(false); // frees what the GPU is done with

    DoctorFrame input;
    input.common = m_common;
    input.normalEncoding = description().normalEncoding;
    input.roughnessEncoding = m_instanceDesc.roughnessEncoding;
    for (const DenoiserState& denoiser : m_denoisers)
        if (const ReblurSettings* settings = std::get_if<ReblurSettings>(&denoiser.settings))
            input.hitDistanceParameters = settings->hitDistanceParameters;
    m_diagnosis->record(wrap(commandBuffer), copyContext(), input, images);
    for (uint32_t i = 0; i < NrdUserPool::kSlotsNum; i++) // the same image may be in slots that were not looked at
        for (const DiagnosedImage& diagnosed : images)
        {
            NrdUserImage& image = userPool[static_cast<ResourceType>(i)];
            if (image.image == diagnosed.source.image->image) image.state = diagnosed.source.image->state;
        }
}

void Core::lookAtDiagnosis(bool isGpuIdle)
{
    if (isGpuIdle)
        m_diagnosis->look(m_frame);
    else if (m_frame >= m_desc.framesInFlight)
        m_diagnosis->look(m_frame - m_desc.framesInFlight);
}

rhi::Span<const Finding> Core::diagnose(bool isGpuIdle)
{
    if (!m_diagnosis) throw Refusal(Result::INVALID_ARGUMENT, "RecordDiagnosis() must be called before Diagnose()");
    lookAtDiagnosis(isGpuIdle);
    const Finding* findings = nullptr;
    uint32_t count = 0;
    const Result result = m_diagnosis->doctor().GetFindings(findings, count);
    if (result != Result::SUCCESS) throw Refusal(result, "the findings could not be put together: out of host memory");
    return {findings, count};
}

void Core::endDiagnosis()
{
    if (!m_diagnosis) return;
    m_retired.reserve(1);
    m_retired.retire(m_frame, std::move(m_diagnosis));
}
} // namespace nrd
