#include "passes.h"
#include "catch.h"
#include "valid_settings.h"
#include "validated_device.h"
#include <rhi/vulkan.h>

namespace confidence
{
namespace
{
void require(nrd::Result result, const nrd::NrdIntegration& integration)
{
    INFO(integration.GetLastMessage());
    REQUIRE(result == nrd::Result::SUCCESS);
}

std::vector<float> firstChannel(const test::Plane& texels)
{
    std::vector<float> values;
    for (const glm::vec4& texel : texels) values.push_back(texel.x);
    return values;
}
} // namespace

Passes::Passes(const nrd::ConfidenceSettings& settings) : m_common(test::makeCommon())
{
    const rhi::VulkanHandles handles = rhi::vulkanHandles(test::validatedDevice());
    nrd::IntegrationCreationDesc desc;
    desc.native.instance = handles.instance;
    desc.native.physicalDevice = handles.physicalDevice;
    desc.native.device = handles.device;
    desc.native.queueFamilyIndex = handles.queueFamilyIndex;
    desc.native.getInstanceProcAddr = handles.getInstanceProcAddr;
    desc.native.getDeviceProcAddr = handles.getDeviceProcAddr;
    desc.resourceWidth = kWidth * kTileSize;
    desc.resourceHeight = kHeight * kTileSize;
    desc.framesInFlight = 1;
    nrd::InstanceCreationDesc instance;
    instance.confidenceTileSize = kTileSize;
    require(m_integration.Create(desc, instance), m_integration);
    require(m_integration.SetConfidenceSettings(settings), m_integration);
    for (auto size : {&m_common.resourceSize, &m_common.resourceSizePrev, &m_common.rectSize, &m_common.rectSizePrev})
    {
        (*size)[0] = desc.resourceWidth;
        (*size)[1] = desc.resourceHeight;
    }
    m_common.denoisingRange = 1000.0f;
}

Passes::~Passes() { test::failOnMessages(); }

Outputs Passes::run(const Inputs& inputs)
{
    m_stored.fill(inputs.stored);
    m_retraced.fill(inputs.retraced);
    m_normalRoughness.fill(inputs.normalRoughness);
    for (test::Image* image : {&m_diffuse, &m_specular}) image->fill(glm::vec4(0.5f)); // so that a hole is seen
    beginFrame();
    const auto commands = test::validatedDevice().createCommandBuffer("confidence");
    commands->begin();
    record(*commands);
    commands->end();
    test::submitAndWait(*commands);
    test::failOnMessages();
    return {firstChannel(m_diffuse.read()), firstChannel(m_specular.read())};
}

void Passes::beginFrame()
{
    m_common.frameIndex++;
    require(m_integration.NewFrame(), m_integration);
    require(m_integration.SetCommonSettings(m_common), m_integration);
}

nrd::NrdUserPool Passes::makePool()
{
    const std::pair<nrd::ResourceType, test::Image*> rows[] = {
        {nrd::ResourceType::IN_STORED_SAMPLE, &m_stored},
        {nrd::ResourceType::IN_RETRACED_SAMPLE, &m_retraced},
        {nrd::ResourceType::IN_STORED_NORMAL_ROUGHNESS, &m_normalRoughness},
        {nrd::ResourceType::IN_DIFF_CONFIDENCE, &m_diffuse},
        {nrd::ResourceType::IN_SPEC_CONFIDENCE, &m_specular}};
    nrd::NrdUserPool pool;
    for (const auto& [slot, image] : rows)
    {
        nrd::NrdUserImage& entry = pool[slot];
        entry.image = rhi::vulkanImage(image->texture());
        entry.format = rhi::toVulkan(image->format());
        entry.width = kWidth;
        entry.height = kHeight;
        entry.state = {VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_ACCESS_SHADER_READ_BIT,
                       VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT};
    }
    return pool;
}

std::string Passes::refusalOf(uint32_t width)
{
    beginFrame();
    nrd::NrdUserPool pool = makePool();
    pool[nrd::ResourceType::IN_DIFF_CONFIDENCE].width = width;
    const auto commands = test::validatedDevice().createCommandBuffer("refused");
    commands->begin();
    const nrd::Result result = m_integration.ComputeConfidence(rhi::vulkanCommandBuffer(*commands), pool);
    commands->end();
    CHECK(result == nrd::Result::INVALID_ARGUMENT);
    return m_integration.GetLastMessage();
}

void Passes::record(rhi::CommandBuffer& commands)
{
    for (test::Image* image : {&m_stored, &m_retraced, &m_normalRoughness, &m_diffuse, &m_specular})
    {
        image->upload(commands);
        image->transition(commands, rhi::states::kSampled);
    }
    nrd::NrdUserPool pool = makePool();
    nrd::DenoiseOptions options;
    options.restoreInitialStates = true;
    require(m_integration.ComputeConfidence(rhi::vulkanCommandBuffer(commands), pool, options), m_integration);
    m_diffuse.download(commands);
    m_specular.download(commands);
}
} // namespace confidence
