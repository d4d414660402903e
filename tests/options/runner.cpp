#include "runner.h"
#include "catch.h"
#include "readable_pool.h"
#include "validated_device.h"
#include <integration_access.h>
#include <rhi/vulkan.h>

namespace options
{
namespace
{
using Slot = nrd::ResourceType;

// Added to the identifier, which is the divisor.
constexpr nrd::Identifier kWithoutHistory = 2, kFullSize = 10; // times nrd::FullSize
constexpr float kOutputPoison = 123.0f; // a float's; normalised formats store the nearest they have

void require(nrd::Result result, const nrd::NrdIntegration& integration)
{
    INFO(integration.GetLastMessage());
    REQUIRE(result == nrd::Result::SUCCESS);
}

nrd::IntegrationCreationDesc makeCreationDesc()
{
    nrd::IntegrationCreationDesc desc;
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
    void prepare(rhi::CommandBuffer& commands, Slot slot, const Frame& frame, nrd::NrdUserPool& pool);
    void record(rhi::CommandBuffer& commands, const Frame& frame);
    Result read(const Frame& frame);
    nrd::Identifier identifier() const
    {
        return setup.resolutionDivisor + (setup.hasHistory ? 0 : kWithoutHistory) +
               kFullSize * static_cast<nrd::Identifier>(setup.fullSize);
    }
    nrd::Result setSettings();

    ReadableDevice device;
    nrd::NrdIntegration integration;
    glm::ivec2 size{1};
    Setup setup;
    size_t light = 0;    // of one frame
    bool isFresh = true; // nothing of earlier frames counts
    std::map<std::pair<size_t, Slot>, std::unique_ptr<test::Image>> images;
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
    return integration.SetDenoiserSettings(identifier(), setup.referenceSettings);
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
    const bool isShared = setup.isInPlace && slot == Slot::OUT_SIGNAL;
    std::unique_ptr<test::Image>& image = images[{light, isShared ? Slot::IN_SIGNAL : slot}];
    const rhi::Format format = frame.formats.at(slot);
    const glm::ivec2 pixels = frame.sizeOf(slot);
    if (image && image->format() == format && image->width() == pixels.x && image->height() == pixels.y) return *image;
    if (image) require(integration.Forget(rhi::vulkanImage(image->texture())), integration);
    image = std::make_unique<test::Image>(format, pixels.x, pixels.y);
    return *image;
}

void Runner::Impl::prepare(rhi::CommandBuffer& commands, Slot slot, const Frame& frame, nrd::NrdUserPool& pool)
{
    test::Image& image = imageOf(slot, frame);
    const bool isWritten = isOutput(slot);
    const bool isInPlace = setup.isInPlace && (slot == Slot::IN_SIGNAL || slot == Slot::OUT_SIGNAL);
    if (!isWritten)
        image.fill(picked(frame, slot));
    else if (!isInPlace)
        image.fill(storedPoison(frame.formats.at(slot)));
    image.upload(commands);
    const bool isGeneral = isWritten || isInPlace;
    image.transition(commands, isGeneral ? rhi::states::kStorageWrite : rhi::states::kSampled);
    nrd::NrdUserImage& entry = pool[slot];
    entry.image = rhi::vulkanImage(image.texture());
    entry.format = rhi::toVulkan(frame.formats.at(slot));
    entry.width = static_cast<uint32_t>(frame.sizeOf(slot).x);
    entry.height = static_cast<uint32_t>(frame.sizeOf(slot).y);
    entry.state.layout = isGeneral ? VK_IMAGE_LAYOUT_GENERAL : VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    entry.state.access = isGeneral ? VK_ACCESS_SHADER_WRITE_BIT : VK_ACCESS_SHADER_READ_BIT;
    entry.state.stages = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT;
}

void Runner::Impl::record(rhi::CommandBuffer& commands, const Frame& frame)
{
    nrd::NrdUserPool pool;
    for (const auto& [slot, format] : frame.formats) prepare(commands, slot, frame, pool);
    const nrd::Identifier chosen = identifier();
    nrd::DenoiseOptions options;
    options.restoreInitialStates = true;
    require(integration.Denoise(rhi::vulkanCommandBuffer(commands), &chosen, 1, pool, options), integration);
    for (const auto& [slot, format] : frame.formats)
        if (isOutput(slot)) imageOf(slot, frame).download(commands);
}

Result Runner::Impl::read(const Frame& frame)
{
    Result result = {frame, {}, {}};
    for (const auto& [slot, format] : frame.formats)
    {
        if (!isOutput(slot)) continue;
        result.outputs[slot] = imageOf(slot, frame).read();
        result.poison[slot] = storedPoison(format);
    }
    return result;
}

Runner::Runner(nrd::Denoiser denoiser, nrd::NormalEncoding normals, nrd::RoughnessEncoding roughness)
    : m_impl(std::make_unique<Impl>())
{
    std::vector<nrd::DenoiserDesc> denoisers = {{1, denoiser, 1}, {2, denoiser, 2}};
    const auto add = [&](nrd::FullSize fullSize)
    {
        const nrd::Identifier identifier = 2 + kFullSize * static_cast<nrd::Identifier>(fullSize);
        denoisers.push_back({identifier, denoiser, 2, true, fullSize});
    };
    const Family family = familyOf(denoiser);
    if (family != Family::Reference) add(nrd::FullSize::GUIDES_AND_OUTPUTS);
    if (family == Family::Reblur || family == Family::Relax) add(nrd::FullSize::EVERYTHING);
    if (family == Family::Sigma)
    {
        denoisers.push_back({1 + kWithoutHistory, denoiser, 1, false});
        denoisers.push_back({2 + kWithoutHistory, denoiser, 2, false});
    }
    nrd::InstanceCreationDesc desc;
    desc.denoisers = denoisers.data();
    desc.denoisersNum = static_cast<uint32_t>(denoisers.size());
    desc.normalEncoding = normals;
    desc.roughnessEncoding = roughness;
    require(nrd::IntegrationAccess::Create(m_impl->integration, m_impl->device, makeCreationDesc(), desc),
            m_impl->integration);
}

Runner::~Runner() { test::failOnMessages(); }

void Runner::start(const Setup& setup)
{
    if (m_impl->size != setup.size) m_impl->resize(setup.size);
    m_impl->isFresh = true; // the pipelines stay
    change(setup);
}

void Runner::change(const Setup& setup)
{
    m_impl->setup = setup;
    require(m_impl->setSettings(), m_impl->integration);
}

Result Runner::denoise(int frameIndex)
{
    const Setup setup = m_impl->setup;
    return denoiseLights(frameIndex, {&setup, 1})[0];
}

std::vector<Result> Runner::denoiseLights(int frameIndex, std::span<const Setup> lights)
{
    nrd::NrdIntegration& integration = m_impl->integration;
    require(integration.NewFrame(), integration);
    nrd::CommonSettings common = makeCommon(lights[0], frameIndex, frameIndex == 0);
    if (m_impl->isFresh) common.accumulationMode = nrd::AccumulationMode::CLEAR_AND_RESTART;
    m_impl->isFresh = false;
    require(integration.SetCommonSettings(common), integration);
    const auto commands = test::validatedDevice().createCommandBuffer("denoise");
    commands->begin();
    std::vector<Frame> frames;
    for (m_impl->light = 0; m_impl->light < lights.size(); m_impl->light++)
    {
        if (lights.size() > 1) change(lights[m_impl->light]);
        frames.push_back(makeFrame(m_impl->setup, m_impl->requirements(), frameIndex));
        m_impl->record(*commands, frames.back());
    }
    commands->end();
    test::submitAndWait(*commands);
    std::vector<Result> results;
    for (m_impl->light = 0; m_impl->light < lights.size(); m_impl->light++)
        results.push_back(m_impl->read(frames[m_impl->light]));
    m_impl->light = 0;
    test::failOnMessages();
    return results;
}

std::vector<Runner::History> Runner::histories()
{
    std::vector<History> histories;
    for (auto& [name, texels] : readPool(nrd::IntegrationAccess::GetPools(m_impl->integration)))
        histories.push_back({name, std::move(texels)});
    return histories;
}

uint32_t Runner::pipelineCount() const { return m_impl->integration.GetStatistics().pipelines; }

Result runFrames(Runner& runner, const Setup& setup, int frameCount)
{
    runner.start(setup);
    for (int frame = 0; frame + 1 < frameCount; frame++) (void)runner.denoise(frame);
    return runner.denoise(frameCount - 1);
}
} // namespace options
