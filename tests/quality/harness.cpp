#include "harness.h"
#include "catch.h"
#include "test_image.h"
#include "validated_device.h"
#include <cstring>
#include <glm/gtc/packing.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <rhi/vulkan.h>

namespace quality
{
namespace
{
rhi::Device& device() { return test::validatedDevice(); }

void require(nrd::Result result, const nrd::NrdIntegration& integration)
{
    INFO(integration.GetLastMessage());
    REQUIRE(result == nrd::Result::SUCCESS);
}

// Octahedral 10-10-10-2, as NRD_FrontEnd_PackNormalAndRoughness writes it.
glm::vec4 packGuide(glm::vec3 n, float roughness)
{
    n /= std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
    const float signedRoughness = std::max(roughness, 1.5f / 512.0f) * (n.z < 0.0f ? -1.0f : 1.0f);
    return {0.5f * glm::vec3(n.x + n.y, n.y - n.x, signedRoughness) + 0.5f, 0.0f};
}

// The same images under the names that the other variants give them; what a denoiser does not need it does not look at.
void fillVariantSlots(nrd::NrdUserPool& pool)
{
    using Type = nrd::ResourceType;
    for (const Type slot :
         {Type::IN_DIFF_HITDIST, Type::IN_DIFF_DIRECTION_HITDIST, Type::IN_DIFF_SH0, Type::IN_DIFF_SH1})
        pool[slot] = pool[Type::IN_DIFF_RADIANCE_HITDIST];
    for (const Type slot : {Type::IN_SPEC_HITDIST, Type::IN_SPEC_SH0, Type::IN_SPEC_SH1})
        pool[slot] = pool[Type::IN_SPEC_RADIANCE_HITDIST];
    for (const Type slot : {Type::OUT_DIFF_HITDIST, Type::OUT_DIFF_DIRECTION_HITDIST, Type::OUT_DIFF_SH0})
        pool[slot] = pool[Type::OUT_DIFF_RADIANCE_HITDIST];
    for (const Type slot : {Type::OUT_SPEC_HITDIST, Type::OUT_SPEC_SH0})
        pool[slot] = pool[Type::OUT_SPEC_RADIANCE_HITDIST];
}
} // namespace

float toHalf(float value) { return glm::unpackHalf1x16(glm::packHalf1x16(value)); }

struct Harness::Impl
{
    Impl(int w, int h) : width(w), height(h) {}

    void create(const Settings& settings, nrd::Denoiser kind);
    void upload(const Frame& frame);
    void setCommon(const Frame& frame, const std::function<void(nrd::CommonSettings&)>& change);
    void record(rhi::CommandBuffer& commands);
    Overlay readOverlay() const;

    int width, height;
    test::Image motion{rhi::Format::RGBA16_SFLOAT, width, height};
    test::Image guide{rhi::Format::A2B10G10R10_UNORM_PACK32, width, height};
    test::Image specularMotion{rhi::Format::RGBA16_SFLOAT, width, height};
    test::Image viewZ{rhi::Format::R32_SFLOAT, width, height};
    test::Image inDiffuse{rhi::Format::RGBA16_SFLOAT, width, height},
        inSpecular{rhi::Format::RGBA16_SFLOAT, width, height};
    test::Image outDiffuse{rhi::Format::RGBA16_SFLOAT, width, height},
        outSpecular{rhi::Format::RGBA16_SFLOAT, width, height};
    test::Image outDiffuseSh1{rhi::Format::RGBA16_SFLOAT, width, height};
    test::Image outSpecularSh1{rhi::Format::RGBA16_SFLOAT, width, height};
    test::Image outOverlay{rhi::Format::RGBA8_UNORM, width, height};
    bool isOverlayOn = false, isSpecularMotionOn = false;
    nrd::NrdIntegration integration;
    Camera previous;
    uint32_t frameIndex = 0;
    Signal diffuse, specular;
    Overlay overlay;
};

void Harness::Impl::create(const Settings& settings, nrd::Denoiser kind)
{
    const rhi::VulkanHandles handles = rhi::vulkanHandles(device());
    nrd::IntegrationCreationDesc desc;
    desc.native.instance = handles.instance;
    desc.native.physicalDevice = handles.physicalDevice;
    desc.native.device = handles.device;
    desc.native.queueFamilyIndex = handles.queueFamilyIndex;
    desc.native.getInstanceProcAddr = handles.getInstanceProcAddr;
    desc.native.getDeviceProcAddr = handles.getDeviceProcAddr;
    desc.resourceWidth = static_cast<uint16_t>(width);
    desc.resourceHeight = static_cast<uint16_t>(height);
    desc.framesInFlight = 1;
    const nrd::DenoiserDesc denoiser = {0, kind};
    nrd::InstanceCreationDesc instanceDesc;
    instanceDesc.denoisers = &denoiser;
    instanceDesc.denoisersNum = 1;
    require(integration.Create(desc, instanceDesc), integration);
    const auto set = [&](const auto& chosen) { return integration.SetDenoiserSettings(0, chosen); };
    require(std::visit(set, settings), integration);
}

void Harness::Impl::upload(const Frame& frame)
{
    test::Plane guides, depths, motions(frame.guides.viewZ.size(), glm::vec4(0.0f));
    for (size_t i = 0; i < frame.guides.viewZ.size(); i++)
    {
        guides.push_back(packGuide(frame.guides.normals[i], frame.guides.roughness[i]));
        depths.emplace_back(frame.guides.viewZ[i], 0.0f, 0.0f, 0.0f);
    }
    for (size_t i = 0; i < frame.motion.size(); i++) motions[i] = glm::vec4(frame.motion[i], 0.0f);
    guide.fill(guides);
    viewZ.fill(depths);
    motion.fill(motions);
    isSpecularMotionOn = !frame.specularMotion.empty();
    if (isSpecularMotionOn) specularMotion.fill(frame.specularMotion);
    inDiffuse.fill(frame.diffuse);
    inSpecular.fill(frame.specular);
}

void Harness::Impl::setCommon(const Frame& frame, const std::function<void(nrd::CommonSettings&)>& change)
{
    const Camera& camera = frame.guides.camera;
    if (frameIndex == 0) previous = camera;
    nrd::CommonSettings common;
    std::memcpy(common.viewToClipMatrix, glm::value_ptr(camera.viewToClip), 64);
    std::memcpy(common.viewToClipMatrixPrev, glm::value_ptr(previous.viewToClip), 64);
    std::memcpy(common.worldToViewMatrix, glm::value_ptr(camera.worldToView), 64);
    std::memcpy(common.worldToViewMatrixPrev, glm::value_ptr(previous.worldToView), 64);
    common.isMotionVectorInWorldSpace = true;
    common.motionVectorScale[2] = 1.0f;
    for (uint16_t* size : {common.resourceSize, common.resourceSizePrev, common.rectSize, common.rectSizePrev})
    {
        size[0] = static_cast<uint16_t>(width);
        size[1] = static_cast<uint16_t>(height);
    }
    common.denoisingRange = kDenoisingRange;
    common.timeDeltaBetweenFrames = 16.667f;
    common.frameIndex = frameIndex++;
    common.isSpecularMotionAvailable = isSpecularMotionOn;
    if (change) change(common);
    previous = camera;
    isOverlayOn = common.enableValidation;
    require(integration.NewFrame(), integration);
    require(integration.SetCommonSettings(common), integration);
}

void Harness::Impl::record(rhi::CommandBuffer& commands)
{
    struct Row
    {
        nrd::ResourceType slot;
        test::Image* image;
        bool isOutput;
    };
    std::vector<Row> rows = {{nrd::ResourceType::IN_MV, &motion, false},
                             {nrd::ResourceType::IN_NORMAL_ROUGHNESS, &guide, false},
                             {nrd::ResourceType::IN_VIEWZ, &viewZ, false},
                             {nrd::ResourceType::IN_DIFF_RADIANCE_HITDIST, &inDiffuse, false},
                             {nrd::ResourceType::IN_SPEC_RADIANCE_HITDIST, &inSpecular, false},
                             {nrd::ResourceType::OUT_DIFF_RADIANCE_HITDIST, &outDiffuse, true},
                             {nrd::ResourceType::OUT_SPEC_RADIANCE_HITDIST, &outSpecular, true},
                             {nrd::ResourceType::OUT_DIFF_SH1, &outDiffuseSh1, true},
                             {nrd::ResourceType::OUT_SPEC_SH1, &outSpecularSh1, true}};
    if (isOverlayOn) rows.push_back({nrd::ResourceType::OUT_VALIDATION, &outOverlay, true});
    if (isSpecularMotionOn) rows.push_back({nrd::ResourceType::IN_SPEC_MV, &specularMotion, false});
    nrd::NrdUserPool pool;
    for (const Row& row : rows)
    {
        row.image->upload(commands);
        row.image->transition(commands, row.isOutput ? rhi::states::kStorageWrite : rhi::states::kSampled);
        nrd::NrdUserImage& entry = pool[row.slot];
        entry.image = rhi::vulkanImage(row.image->texture());
        entry.format = rhi::toVulkan(row.image->format());
        entry.width = static_cast<uint32_t>(width);
        entry.height = static_cast<uint32_t>(height);
        entry.state.layout = row.isOutput ? VK_IMAGE_LAYOUT_GENERAL : VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
        entry.state.access = row.isOutput ? VK_ACCESS_SHADER_WRITE_BIT : VK_ACCESS_SHADER_READ_BIT;
        entry.state.stages = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT;
    }
    fillVariantSlots(pool);
    const nrd::Identifier identifier = 0;
    nrd::DenoiseOptions options;
    options.restoreInitialStates = true;
    require(integration.Denoise(rhi::vulkanCommandBuffer(commands), &identifier, 1, pool, options), integration);
    outDiffuse.download(commands);
    outSpecular.download(commands);
    if (isOverlayOn) outOverlay.download(commands);
}

Overlay Harness::Impl::readOverlay() const
{
    Overlay texels;
    for (const glm::vec4& v : outOverlay.read()) texels.emplace_back(255.0f * v + 0.5f);
    return texels;
}

Harness::Harness(int width, int height, const Settings& settings, nrd::Denoiser denoiser)
    : m_impl(std::make_unique<Impl>(width, height))
{
    m_impl->create(settings, denoiser);
}

Harness::Harness(int width, int height, nrd::Denoiser denoiser) : m_impl(std::make_unique<Impl>(width, height))
{
    if (denoiser < nrd::Denoiser::RELAX_DIFFUSE)
        m_impl->create(nrd::ReblurSettings(), denoiser);
    else
        m_impl->create(nrd::RelaxSettings(), denoiser);
}

Harness::~Harness() { test::failOnMessages(); }

void Harness::denoise(const Frame& frame, const std::function<void(nrd::CommonSettings&)>& change)
{
    m_impl->upload(frame);
    m_impl->setCommon(frame, change);
    const auto commands = device().createCommandBuffer("denoise");
    commands->begin();
    m_impl->record(*commands);
    commands->end();
    test::submitAndWait(*commands);
    m_impl->diffuse = m_impl->outDiffuse.read();
    m_impl->specular = m_impl->outSpecular.read();
    if (m_impl->isOverlayOn) m_impl->overlay = m_impl->readOverlay();
    test::failOnMessages();
}

const Signal& Harness::diffuse() const { return m_impl->diffuse; }
const Signal& Harness::specular() const { return m_impl->specular; }
const Overlay& Harness::overlay() const { return m_impl->overlay; }
int Harness::width() const { return m_impl->width; }
int Harness::height() const { return m_impl->height; }

void Harness::poisonOutputs(float value)
{
    m_impl->outDiffuse.fill(glm::vec4(value));
    m_impl->outSpecular.fill(glm::vec4(value));
}

void Harness::poisonOverlay(glm::u8vec4 value) { m_impl->outOverlay.fill(glm::vec4(value) / 255.0f); }
} // namespace quality
