#include "harness.h"
#include "catch.h"
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

// An image of the application with buffers to fill and read it.
struct Image
{
    Image(rhi::Format format, int width, int height)
    {
        rhi::TextureDesc desc;
        desc.format = format;
        desc.width = static_cast<uint32_t>(width);
        desc.height = static_cast<uint32_t>(height);
        desc.usage = rhi::TextureUsage::Sampled | rhi::TextureUsage::Storage | rhi::TextureUsage::TransferSrc |
                     rhi::TextureUsage::TransferDst;
        texture = device().createTexture(desc);
        upload = makeBuffer(rhi::BufferMemory::Upload);
        readback = makeBuffer(rhi::BufferMemory::Readback);
    }

    std::unique_ptr<rhi::Buffer> makeBuffer(rhi::BufferMemory memory) const
    {
        rhi::BufferDesc desc;
        desc.size = texture->mipByteSize(0);
        desc.usage = rhi::BufferUsage::TransferSrc | rhi::BufferUsage::TransferDst;
        desc.memory = memory;
        return device().createBuffer(desc);
    }

    template <class T> void fill(const std::vector<T>& texels)
    {
        std::memcpy(upload->mapped(), texels.data(), texels.size() * sizeof(T));
    }

    std::unique_ptr<rhi::Texture> texture;
    std::unique_ptr<rhi::Buffer> upload, readback;
    rhi::TextureState state = rhi::states::kUndefined;
};

uint64_t packHalf4(glm::vec4 v) { return glm::packHalf4x16(v); }

// Octahedral 10-10-10-2, as NRD_FrontEnd_PackNormalAndRoughness writes it.
uint32_t packGuide(glm::vec3 n, float roughness)
{
    n /= std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
    const float signedRoughness = std::max(roughness, 1.5f / 512.0f) * (n.z < 0.0f ? -1.0f : 1.0f);
    const glm::vec3 e = 0.5f * glm::vec3(n.x + n.y, n.y - n.x, signedRoughness) + 0.5f;
    const glm::uvec3 q = glm::uvec3(glm::clamp(e, 0.0f, 1.0f) * 1023.0f + 0.5f);
    return q.x | (q.y << 10) | (q.z << 20);
}

std::vector<uint64_t> packSignal(const Signal& signal)
{
    std::vector<uint64_t> texels;
    for (const glm::vec4& v : signal) texels.push_back(packHalf4(v));
    return texels;
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
    void prepareOutputs();
    void upload(const Frame& frame);
    void setCommon(const Frame& frame, const std::function<void(nrd::CommonSettings&)>& change);
    void record(rhi::CommandBuffer& commands);
    void transition(rhi::CommandBuffer& commands, Image& image, const rhi::TextureState& after);
    void download(rhi::CommandBuffer& commands, Image& image);
    Signal read(const Image& image) const;

    int width, height;
    Image motion{rhi::Format::RGBA16_SFLOAT, width, height};
    Image guide{rhi::Format::A2B10G10R10_UNORM_PACK32, width, height};
    Image specularMotion{rhi::Format::RGBA16_SFLOAT, width, height};
    Image viewZ{rhi::Format::R32_SFLOAT, width, height};
    Image inDiffuse{rhi::Format::RGBA16_SFLOAT, width, height}, inSpecular{rhi::Format::RGBA16_SFLOAT, width, height};
    Image outDiffuse{rhi::Format::RGBA16_SFLOAT, width, height}, outSpecular{rhi::Format::RGBA16_SFLOAT, width, height};
    Image outDiffuseSh1{rhi::Format::RGBA16_SFLOAT, width, height};
    Image outSpecularSh1{rhi::Format::RGBA16_SFLOAT, width, height};
    Image outOverlay{rhi::Format::RGBA8_UNORM, width, height};
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

void Harness::Impl::prepareOutputs()
{
    const std::vector<uint64_t> zeros(static_cast<size_t>(width) * static_cast<size_t>(height), 0);
    for (Image* image : {&outDiffuse, &outSpecular, &outDiffuseSh1, &outSpecularSh1}) image->fill(zeros);
    outOverlay.fill(Overlay(zeros.size(), glm::u8vec4(0)));
}

void Harness::Impl::upload(const Frame& frame)
{
    const size_t count = static_cast<size_t>(width) * static_cast<size_t>(height);
    std::vector<uint32_t> guides(count);
    for (size_t i = 0; i < count; i++) guides[i] = packGuide(frame.guides.normals[i], frame.guides.roughness[i]);
    guide.fill(guides);
    viewZ.fill(frame.guides.viewZ);
    std::vector<uint64_t> motions(count, 0);
    for (size_t i = 0; i < frame.motion.size(); i++) motions[i] = packHalf4(glm::vec4(frame.motion[i], 0.0f));
    motion.fill(motions);
    isSpecularMotionOn = !frame.specularMotion.empty();
    if (isSpecularMotionOn) specularMotion.fill(packSignal(frame.specularMotion));
    inDiffuse.fill(packSignal(frame.diffuse));
    inSpecular.fill(packSignal(frame.specular));
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

void Harness::Impl::transition(rhi::CommandBuffer& commands, Image& image, const rhi::TextureState& after)
{
    commands.barrier(rhi::TextureBarrier{image.texture.get(), image.state, after});
    image.state = after;
}

void Harness::Impl::record(rhi::CommandBuffer& commands)
{
    struct Row
    {
        nrd::ResourceType slot;
        Image* image;
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
        transition(commands, *row.image, rhi::states::kTransferDst);
        commands.copyBufferToTexture({row.image->texture.get(), 0, row.image->upload.get(), 0});
        transition(commands, *row.image, row.isOutput ? rhi::states::kStorageWrite : rhi::states::kSampled);
        nrd::NrdUserImage& entry = pool[row.slot];
        entry.image = rhi::detail::fromHandle<VkImage>(row.image->texture->nativeHandle());
        entry.format = rhi::toVulkan(row.image->texture->desc().format);
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
    const auto native = rhi::detail::fromHandle<VkCommandBuffer>(commands.nativeHandle());
    require(integration.Denoise(native, &identifier, 1, pool, options), integration);
    download(commands, outDiffuse);
    download(commands, outSpecular);
    if (isOverlayOn) download(commands, outOverlay);
}

void Harness::Impl::download(rhi::CommandBuffer& commands, Image& image)
{
    transition(commands, image, rhi::states::kTransferSrc);
    commands.copyTextureToBuffer({image.texture.get(), 0, image.readback.get(), 0});
    commands.barrier(rhi::BufferBarrier{image.readback.get(),
                                        {rhi::Access::TransferWrite, rhi::Stage::Transfer},
                                        {rhi::Access::HostRead, rhi::Stage::Host}});
}

Signal Harness::Impl::read(const Image& image) const
{
    const size_t count = static_cast<size_t>(width) * static_cast<size_t>(height);
    std::vector<uint64_t> texels(count);
    std::memcpy(texels.data(), image.readback->mapped(), count * sizeof(uint64_t));
    Signal signal;
    for (uint64_t texel : texels) signal.push_back(glm::unpackHalf4x16(texel));
    return signal;
}

Harness::Harness(int width, int height, const Settings& settings, nrd::Denoiser denoiser)
    : m_impl(std::make_unique<Impl>(width, height))
{
    m_impl->create(settings, denoiser);
    m_impl->prepareOutputs();
}

Harness::Harness(int width, int height, nrd::Denoiser denoiser) : m_impl(std::make_unique<Impl>(width, height))
{
    if (denoiser < nrd::Denoiser::RELAX_DIFFUSE)
        m_impl->create(nrd::ReblurSettings(), denoiser);
    else
        m_impl->create(nrd::RelaxSettings(), denoiser);
    m_impl->prepareOutputs();
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
    m_impl->diffuse = m_impl->read(m_impl->outDiffuse);
    m_impl->specular = m_impl->read(m_impl->outSpecular);
    m_impl->overlay.resize(m_impl->diffuse.size());
    const size_t byteSize = m_impl->overlay.size() * sizeof(glm::u8vec4);
    if (m_impl->isOverlayOn) std::memcpy(m_impl->overlay.data(), m_impl->outOverlay.readback->mapped(), byteSize);
    test::failOnMessages();
}

const Signal& Harness::diffuse() const { return m_impl->diffuse; }
const Signal& Harness::specular() const { return m_impl->specular; }
const Overlay& Harness::overlay() const { return m_impl->overlay; }
int Harness::width() const { return m_impl->width; }
int Harness::height() const { return m_impl->height; }

void Harness::poisonOutputs(float value)
{
    const Signal poison(static_cast<size_t>(width()) * static_cast<size_t>(height()), glm::vec4(value));
    m_impl->outDiffuse.fill(packSignal(poison));
    m_impl->outSpecular.fill(packSignal(poison));
}

void Harness::poisonOverlay(glm::u8vec4 value)
{
    m_impl->outOverlay.fill(Overlay(static_cast<size_t>(width()) * static_cast<size_t>(height()), value));
}
} // namespace quality
