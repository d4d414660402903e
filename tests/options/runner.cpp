#include "runner.h"
#include "catch.h"
#include "validated_device.h"
#include <nrd/integration.h>
#include <rhi/vulkan.h>

namespace options
{
namespace
{
using Slot = nrd::ResourceType;

constexpr nrd::Identifier kWithoutHistory = 2; // added to the identifier, which is the divisor
constexpr float kOutputPoison = 123.0f;        // a float's; normalised formats store the nearest they have

void require(nrd::Result result, const nrd::NrdIntegration& integration)
{
    INFO(integration.GetLastMessage());
    REQUIRE(result == nrd::Result::SUCCESS);
}

nrd::IntegrationCreationDesc makeCreationDesc()
{
    const rhi::VulkanHandles handles = rhi::vulkanHandles(test::validatedDevice());
    nrd::IntegrationCreationDesc desc;
    desc.native.instance = handles.instance;
    desc.native.physicalDevice = handles.physicalDevice;
    desc.native.device = handles.device;
    desc.native.queueFamilyIndex = handles.queueFamilyIndex;
    desc.native.getInstanceProcAddr = handles.getInstanceProcAddr;
    desc.native.getDeviceProcAddr = handles.getDeviceProcAddr;
    desc.resourceWidth = desc.resourceHeight = 1;
    desc.framesInFlight = 1;
    return desc;
}

glm::vec4 storedPoison(rhi::Format format)
{
    const bool isFloat = poisonOf(format).x != poisonOf(format).x;
    uint8_t texel[16] = {};
    test::encodeTexel(format, glm::vec4(isFloat ? kOutputPoison : 77.0f / 255.0f), texel);
    return test::decodeTexel(format, texel);
}
} // namespace

struct Runner::Impl
{
    void create(const nrd::InstanceCreationDesc& desc);
    void resize(glm::ivec2 to);
    std::vector<nrd::ResourceRequirement> requirements() const;
    test::Image& imageOf(Slot slot, const Frame& frame);
    void record(rhi::CommandBuffer& commands, Frame& frame);
    nrd::Identifier identifier() const { return setup.resolutionDivisor + (setup.hasHistory ? 0 : kWithoutHistory); }
    nrd::Result setSettings();

    nrd::NrdIntegration integration;
    glm::ivec2 size{1};
    Setup setup;
    std::map<Slot, std::unique_ptr<test::Image>> images;
};

void Runner::Impl::resize(glm::ivec2 to)
{
    require(integration.Resize(static_cast<uint16_t>(to.x), static_cast<uint16_t>(to.y)), integration);
    size = to;
}

nrd::Result Runner::Impl::setSettings()
{
    switch (familyOf(setup.denoiser))
    {
    case Family::Reblur:
        return integration.SetDenoiserSettings(identifier(), setup.settings);
    case Family::Relax:
        return integration.SetDenoiserSettings(identifier(), setup.relaxSettings);
    case Family::Sigma:
        return integration.SetDenoiserSettings(identifier(), setup.sigmaSettings);
    case Family::Reference:
        break;
    }
    return integration.SetDenoiserSettings(identifier(), nrd::ReferenceSettings());
}

std::vector<nrd::ResourceRequirement> Runner::Impl::requirements() const
{
    const nrd::ResourceRequirement* needs = nullptr;
    uint32_t count = 0;
    REQUIRE(nrd::GetRequiredResources(*integration.GetInstance(), identifier(), needs, count) == nrd::Result::SUCCESS);
    return {needs, needs + count};
}

test::Image& Runner::Impl::imageOf(Slot slot, const Frame& frame)
{
    std::unique_ptr<test::Image>& image = images[slot];
    const rhi::Format format = frame.formats.at(slot);
    const bool isFit =
        image && image->format() == format && image->width() == frame.size.x && image->height() == frame.size.y;
    if (isFit) return *image;
    if (image) require(integration.Forget(rhi::vulkanImage(image->texture())), integration);
    image = std::make_unique<test::Image>(format, frame.size.x, frame.size.y);
    return *image;
}

void Runner::Impl::record(rhi::CommandBuffer& commands, Frame& frame)
{
    nrd::NrdUserPool pool;
    for (const auto& [slot, format] : frame.formats)
    {
        test::Image& image = imageOf(slot, frame);
        const bool isWritten = isOutput(slot);
        if (isWritten)
            image.fill(storedPoison(format));
        else
            image.fill(frame.inputs.at(slot));
        image.upload(commands);
        image.transition(commands, isWritten ? rhi::states::kStorageWrite : rhi::states::kSampled);
        nrd::NrdUserImage& entry = pool[slot];
        entry.image = rhi::vulkanImage(image.texture());
        entry.format = rhi::toVulkan(format);
        entry.width = static_cast<uint32_t>(frame.size.x);
        entry.height = static_cast<uint32_t>(frame.size.y);
        entry.state.layout = isWritten ? VK_IMAGE_LAYOUT_GENERAL : VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
        entry.state.access = isWritten ? VK_ACCESS_SHADER_WRITE_BIT : VK_ACCESS_SHADER_READ_BIT;
        entry.state.stages = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT;
    }
    const nrd::Identifier chosen = identifier();
    nrd::DenoiseOptions options;
    options.restoreInitialStates = true;
    require(integration.Denoise(rhi::vulkanCommandBuffer(commands), &chosen, 1, pool, options), integration);
    for (const auto& [slot, format] : frame.formats)
        if (isOutput(slot)) imageOf(slot, frame).download(commands);
}

Runner::Runner(nrd::Denoiser denoiser, nrd::NormalEncoding normals, nrd::RoughnessEncoding roughness)
    : m_impl(std::make_unique<Impl>())
{
    const nrd::DenoiserDesc denoisers[] = {{1, denoiser, 1},
                                           {2, denoiser, 2},
                                           {1 + kWithoutHistory, denoiser, 1, false},
                                           {2 + kWithoutHistory, denoiser, 2, false}};
    nrd::InstanceCreationDesc desc;
    desc.denoisers = denoisers;
    desc.denoisersNum = familyOf(denoiser) == Family::Sigma ? 4 : 2;
    desc.normalEncoding = normals;
    desc.roughnessEncoding = roughness;
    require(m_impl->integration.Create(makeCreationDesc(), desc), m_impl->integration);
}

Runner::~Runner() { test::failOnMessages(); }

void Runner::start(const Setup& setup)
{
    // A size it does not have: the instance is made anew, the pipelines stay.
    if (m_impl->size == setup.size) m_impl->resize(setup.size + 1);
    m_impl->resize(setup.size);
    change(setup);
}

void Runner::change(const Setup& setup)
{
    m_impl->setup = setup;
    require(m_impl->setSettings(), m_impl->integration);
}

Result Runner::denoise(int frameIndex)
{
    nrd::NrdIntegration& integration = m_impl->integration;
    require(integration.NewFrame(), integration);
    require(integration.SetCommonSettings(makeCommon(m_impl->setup, frameIndex, frameIndex == 0)), integration);
    Result result;
    result.frame = makeFrame(m_impl->setup, m_impl->requirements(), frameIndex);
    const auto commands = test::validatedDevice().createCommandBuffer("denoise");
    commands->begin();
    m_impl->record(*commands, result.frame);
    commands->end();
    test::submitAndWait(*commands);
    for (const auto& [slot, format] : result.frame.formats)
    {
        if (!isOutput(slot)) continue;
        result.outputs[slot] = m_impl->imageOf(slot, result.frame).read();
        result.poison[slot] = storedPoison(format);
    }
    test::failOnMessages();
    return result;
}

uint32_t Runner::pipelineCount() const { return m_impl->integration.GetStatistics().pipelines; }

Result runFrames(Runner& runner, const Setup& setup, int frameCount)
{
    runner.start(setup);
    for (int frame = 0; frame + 1 < frameCount; frame++) (void)runner.denoise(frame);
    return runner.denoise(frameCount - 1);
}
} // namespace options
