#include "recorded_life.h"
#include "common.h"
#include <algorithm>
#include <options.h>

namespace faults
{
namespace
{
using nrd::Result;

VkCommandBuffer anyCommandBuffer() { return reinterpret_cast<VkCommandBuffer>(uintptr_t(0xC0DE)); }
VkImage imageOf(uint32_t slot, uint64_t generation)
{
    return reinterpret_cast<VkImage>(uintptr_t(0x1000 * (generation + 1) + slot));
}

// One for all denoisers that share the slot.
VkFormat formatOf(nrd::ResourceType slot)
{
    if (slot == nrd::ResourceType::IN_NORMAL_ROUGHNESS) return VK_FORMAT_A2B10G10R10_UNORM_PACK32;
    return slot == nrd::ResourceType::IN_VIEWZ ? VK_FORMAT_R32_SFLOAT : VK_FORMAT_R16G16B16A16_SFLOAT;
}
} // namespace

RecordedLife::RecordedLife(uint32_t seed) : m_dice(seed) { create(anyChoice(), true); }

RecordedLife::Choice RecordedLife::anyChoice()
{
    Choice choice;
    const std::span<const nrd::Denoiser> all = options::allDenoisers();
    const uint32_t count = 1 + m_dice.below(4);
    for (uint32_t i = 0; i < count; i++)
        choice.denoisers.push_back({i + 1, all[m_dice.below(static_cast<uint32_t>(all.size()))]});
    choice.desc.resourceWidth = static_cast<uint16_t>(1 + m_dice.below(300));
    choice.desc.resourceHeight = static_cast<uint16_t>(1 + m_dice.below(300));
    choice.desc.framesInFlight = 1 + m_dice.below(4);
    choice.desc.layoutPolicy = m_dice.once(2) ? nrd::LayoutPolicy::GENERAL : nrd::LayoutPolicy::OPTIMAL;
    choice.desc.isGpuTimingEnabled = m_dice.once(2);
    choice.desc.isPassTracingEnabled = m_dice.once(2);
    choice.desc.createDefaultPipelines = m_dice.once(2);
    choice.desc.isTransientMemoryShared = m_dice.once(3);
    return choice;
}

void RecordedLife::create(const Choice& choice, bool isValidated)
{
    m_choice = choice;
    const auto keep = [this](const std::string& sentence) { m_misuses.push_back(sentence); };
    if (isValidated) m_validating = rhi::makeValidatingDevice(*m_device, keep);
    rhi::Device& device = isValidated ? *m_validating : *m_device;
    nrd::InstanceCreationDesc instanceDesc;
    instanceDesc.denoisers = m_choice.denoisers.data();
    instanceDesc.denoisersNum = static_cast<uint32_t>(m_choice.denoisers.size());
    test::require(nrd::IntegrationAccess::Create(m_integration, device, m_choice.desc, instanceDesc), m_integration);
    m_generation++;
}

void RecordedLife::destroy()
{
    m_integration.Destroy();
    m_validating.reset(); // says what still lives
    m_device->clearCalls();
}

void RecordedLife::resize(uint16_t width, uint16_t height)
{
    test::require(m_integration.Resize(width, height), m_integration);
    m_choice.desc.resourceWidth = width;
    m_choice.desc.resourceHeight = height;
    m_generation++;
}

nrd::CommonSettings RecordedLife::common()
{
    nrd::CommonSettings result =
        test::stillCamera(m_choice.desc.resourceWidth, m_choice.desc.resourceHeight, m_frameIndex++);
    for (uint16_t* size : {result.resourceSizePrev, result.rectSizePrev})
        if (m_lastSize[0] != 0) std::copy_n(m_lastSize, 2, size);
    std::copy_n(result.resourceSize, 2, m_lastSize);
    return result;
}

// Images for what all denoisers need under the settings of this frame.
void RecordedLife::fillPool()
{
    for (const nrd::DenoiserDesc& denoiser : m_choice.denoisers)
    {
        const nrd::ResourceRequirement* needs = nullptr;
        uint32_t count = 0;
        REQUIRE(nrd::GetRequiredResources(*m_integration.GetInstance(), denoiser.identifier, needs, count) ==
                Result::SUCCESS);
        for (uint32_t i = 0; i < count; i++)
        {
            nrd::NrdUserImage& image = m_pool[needs[i].type];
            if (image.generation == m_generation) continue;
            image = {};
            image.image = imageOf(static_cast<uint32_t>(needs[i].type), m_generation);
            image.format = formatOf(needs[i].type);
            image.width = m_choice.desc.resourceWidth;
            image.height = m_choice.desc.resourceHeight;
            image.generation = m_generation;
        }
    }
}

void RecordedLife::plainFrame(const nrd::CommonSettings& settings, const std::vector<nrd::Identifier>& identifiers,
                              const nrd::DenoiseOptions& options)
{
    m_device->clearCalls();
    test::require(m_integration.NewFrame(), m_integration);
    test::require(m_integration.SetCommonSettings(settings), m_integration);
    fillPool();
    test::require(m_integration.Denoise(anyCommandBuffer(), identifiers.data(),
                                        static_cast<uint32_t>(identifiers.size()), m_pool, options),
                  m_integration);
}

void RecordedLife::frame()
{
    if (m_dice.once(100))
    {
        destroy();
        create(anyChoice(), true);
    }
    if (m_dice.once(20))
        resize(static_cast<uint16_t>(1 + m_dice.below(300)), static_cast<uint16_t>(1 + m_dice.below(300)));
    if (m_dice.once(30)) m_generation++; // the application makes its images anew

    nrd::CommonSettings settings = common();
    if (m_dice.once(15)) settings.accumulationMode = nrd::AccumulationMode::RESTART;
    if (m_dice.once(15)) settings.accumulationMode = nrd::AccumulationMode::CLEAR_AND_RESTART;
    settings.splitScreen = m_dice.once(10) ? m_dice.share() : 0.0f;
    settings.enableValidation = m_dice.once(10);
    settings.isHistoryConfidenceAvailable = m_dice.once(3);
    settings.isDisocclusionThresholdMixAvailable = m_dice.once(3);
    settings.isSpecularMotionAvailable = m_dice.once(3);
    std::vector<nrd::Identifier> identifiers;
    for (const nrd::DenoiserDesc& denoiser : m_choice.denoisers)
    {
        if (m_dice.once(10))
            test::require(changeSettings(m_dice, m_integration, denoiser.identifier, denoiser.denoiser), m_integration);
        if (!m_dice.once(8)) identifiers.push_back(denoiser.identifier);
    }
    nrd::DenoiseOptions options;
    options.restoreInitialStates = m_dice.once(3);
    if (m_dice.once(2)) options.transientBefore.stages = options.transientAfter.stages = 0;
    plainFrame(settings, identifiers, options);
}

void RecordedLife::settle()
{
    destroy();
    Choice choice;
    choice.denoisers = {{1, nrd::Denoiser::REBLUR_DIFFUSE_SPECULAR}, {2, nrd::Denoiser::RELAX_DIFFUSE_SPECULAR}};
    choice.desc.resourceWidth = 64;
    choice.desc.resourceHeight = 48;
    choice.desc.framesInFlight = 2;
    create(choice, false);
    for (int frame = 0; frame < 20; frame++) plainFrame(common(), {1, 2}, {});
}

RecordedLife::Holdings RecordedLife::holdings() const
{
    Holdings result = {m_device->objectCount(), 0};
    for (const rhi::MemoryReportLine& line : m_device->memoryReport()) result.bytes += line.byteSize;
    return result;
}
} // namespace faults
