// The part of Core that writes an application's inputs to a folder.
#include "convert.h"
#include "core.h"
#include <algorithm>

namespace nrd
{
namespace
{
constexpr uint32_t kMostFrames = 10000; // file names have four digits
} // namespace

void Core::dumpInputs(const char* folder, uint32_t frameCount)
{
    if (!folder || !*folder) throw Refusal(Result::INVALID_ARGUMENT, "DumpInputs(): folder is empty");
    if (frameCount == 0 || frameCount > kMostFrames)
        throw Refusal(Result::INVALID_ARGUMENT,
                      sentence("DumpInputs(): frames is %u, must be in [1; %u]", frameCount, kMostFrames));
    if (m_dump)
        throw Refusal(Result::INVALID_ARGUMENT, "DumpInputs(): the frames of an earlier call are not written yet");
    m_dump = std::make_unique<dump::InputDump>(m_device, m_desc.name, folder, frameCount);
}

bool Core::isDumped(rhi::Span<const Identifier> identifiers)
{
    if (!m_dump || !m_dump->wants(m_frame)) return false;
    const auto isConfidence = [](Identifier identifier) { return identifier == kConfidenceIdentifier; };
    if (std::all_of(identifiers.begin(), identifiers.end(), isConfidence)) return false; // left out of captures
    const auto isPacked = [](const auto& settings)
    {
        if constexpr (requires { settings.checkerboardMode; })
            return settings.checkerboardMode != CheckerboardMode::OFF;
        return false;
    };
    if (!m_dump->hasSize(m_common.rectSize)) m_dump->stop("rectSize changed, but a capture has one size");
    for (const Identifier identifier : identifiers)
        if (std::visit(isPacked, find(identifier).settings))
            m_dump->stop("checkerboardMode was on, whose signals a dump cannot unpack");
    return m_dump->wants(m_frame);
}

std::vector<dump::DumpedImage> Core::dumpedImages(rhi::Span<const Identifier> identifiers, NrdUserPool& userPool)
{
    std::vector<dump::DumpedImage> images;
    for (const Identifier identifier : identifiers)
    {
        const DenoiserState& denoiser = find(identifier);
        const ResourceRequirement* needs = nullptr;
        uint32_t needCount = 0;
        check(GetRequiredResources(*m_instance, identifier, needs, needCount));
        dump::SlotContext context;
        context.denoiser = denoiser.desc.denoiser;
        if (const ReblurSettings* settings = std::get_if<ReblurSettings>(&denoiser.settings))
            context.hitDistanceParameters = settings->hitDistanceParameters;
        for (uint32_t i = 0; i < needCount; i++)
        {
            NrdUserImage& image = userPool[needs[i].type];
            const bool hasContents = image.image != VK_NULL_HANDLE && image.state.layout != VK_IMAGE_LAYOUT_UNDEFINED;
            if (!hasContents || !dump::isRecorded(needs[i].type)) continue;
            context.type = needs[i].type;
            context.width = image.width;
            context.height = image.height;
            images.push_back({{toString(context.type), &image}, context});
        }
    }
    return images;
}

void Core::planDump(rhi::Span<const Identifier> identifiers, NrdUserPool& userPool)
{
    dump::FrameContext frame;
    frame.common = m_common;
    frame.normalEncoding = description().normalEncoding;
    frame.roughnessEncoding = m_instanceDesc.roughnessEncoding;
    for (const Identifier identifier : identifiers)
    {
        const DenoiserState& denoiser = find(identifier);
        if (const ReblurSettings* settings = std::get_if<ReblurSettings>(&denoiser.settings))
            frame.hitDistanceParameters = settings->hitDistanceParameters;
        const Denoiser kind = denoiser.desc.denoiser;
        frame.hasLight |= kind == Denoiser::SIGMA_SHADOW || kind == Denoiser::SIGMA_SHADOW_TRANSLUCENCY;
        if (const SigmaSettings* settings = std::get_if<SigmaSettings>(&denoiser.settings)) frame.light = *settings;
    }
    m_dump->plan(copyContext(), frame, dumpedImages(identifiers, userPool));
    for (uint32_t i = 0; i < NrdUserPool::kSlotsNum; i++) // the same image may be in slots that are not copied
        for (const CopiedImage& copied : m_dump->planned())
        {
            NrdUserImage& image = userPool[static_cast<ResourceType>(i)];
            if (image.image == copied.image->image) image.state = copiedState(image.state, m_desc.layoutPolicy);
        }
}

void Core::writeDump(bool isGpuIdle)
{
    if (!m_dump) return;
    // Out of the way first: a dump that cannot be written ends here.
    std::unique_ptr<dump::InputDump> dump = std::move(m_dump);
    m_retired.reserve(1);
    try
    {
        const uint64_t inFlight = isGpuIdle ? 0 : m_desc.framesInFlight;
        if (m_frame >= inFlight) dump->write(m_frame - inFlight);
    }
    catch (...)
    {
        m_retired.retire(m_frame, std::move(dump));
        throw;
    }
    if (dump->isFinished())
        m_retired.retire(m_frame, std::move(dump));
    else
        m_dump = std::move(dump);
}
} // namespace nrd
