#include "image_copies.h"
#include "convert.h"
#include "nrd_integration_shaders.h"
#include "pools.h"
#include "refusal.h"
#include "state_tracker.h"
#include <utility>

namespace nrd
{
namespace
{
constexpr uint32_t kGroupSize = 8;   // of read_texels.comp.glsl
constexpr uint32_t kTexelSize = 16;  // bytes of its vec4
constexpr uint32_t kMostImages = 64; // of a frame, those of plans that failed included
constexpr rhi::BufferState kHostRead = {rhi::Access::HostRead, rhi::Stage::Host};
constexpr rhi::BufferState kShaderWrite = {rhi::Access::StorageWrite, rhi::Stage::Compute};

bool isFirstOfItsImage(rhi::Span<const CopiedImage> images, size_t index)
{
    for (size_t i = 0; i < index; i++)
        if (images[i].image->image == images[index].image->image) return false;
    return true;
}
} // namespace

std::unique_ptr<rhi::Pipeline> createCopyPipeline(rhi::Device& device, const char* name)
{
    const integration::ShaderBlob blob = integration::shaderBlob(integration::Shader::ReadTexels);
    const std::string pipelineName = sentence("%s %s", name, blob.name);
    const rhi::BindingDesc bindings[] = {{0, 0, rhi::BindingType::SampledTexture},
                                         {0, 1, rhi::BindingType::StorageBuffer}};
    rhi::PipelineDesc desc;
    desc.spirv = {blob.words, blob.byteSize / sizeof(uint32_t)};
    desc.bindings = bindings;
    desc.name = pipelineName.c_str();
    return device.createPipeline(desc);
}

ImageCopies::ImageCopies(rhi::Device& device, const rhi::Pipeline& pipeline, const char* name)
    : m_device(device), m_pipeline(pipeline), m_name(name)
{
    const std::string poolName = sentence("%s copies", name);
    rhi::DescriptorPoolDesc pool;
    pool.sets = pool.sampledTextures = pool.storageBuffers = kMostImages;
    pool.name = poolName.c_str();
    m_descriptors = device.createDescriptorPool(pool);
}

void ImageCopies::reset()
{
    m_copies.clear();
    m_recorded = 0;
    m_descriptors->reset();
}

const rhi::Buffer& ImageCopies::bufferAt(size_t index, uint64_t size)
{
    if (m_buffers.size() <= index) m_buffers.resize(index + 1);
    std::unique_ptr<rhi::Buffer>& buffer = m_buffers[index];
    if (buffer && buffer->desc().size >= size) return *buffer;
    const std::string name = sentence("%s copies", m_name.c_str());
    const std::string tag = memoryTag(m_name.c_str(), "buffers");
    buffer = m_device.createBuffer(
        {size, rhi::BufferUsage::Storage, rhi::BufferMemory::Readback, name.c_str(), tag.c_str()});
    return *buffer;
}

void ImageCopies::plan(const CopyContext& context, rhi::Span<const CopiedImage> images)
{
    m_copies.resize(m_recorded);
    m_textureBarriers.clear();
    m_bufferBarriers.clear();
    for (size_t i = 0; i < images.size(); i++) planImage(context, images, i);
}

void ImageCopies::planImage(const CopyContext& context, rhi::Span<const CopiedImage> images, size_t index)
{
    const NrdUserImage& image = *images[index].image;
    const rhi::TextureState sampled = toRhi(ResourceState::SAMPLED, context.layoutPolicy);
    const rhi::TextureState before = toRhi(image.state);
    const uint64_t byteSize = uint64_t{image.width} * image.height * kTexelSize;
    CachedImage& cached = context.views.acquire(image, images[index].name, context.frame, context.retired);
    const rhi::Buffer& buffer = bufferAt(m_copies.size(), byteSize);
    const bool isMoved = needsBarrier(before, sampled);
    if (isMoved && isFirstOfItsImage(images, index)) m_textureBarriers.push_back({&cached.texture(), before, sampled});
    m_bufferBarriers.push_back({&buffer, kHostRead, kShaderWrite});
    rhi::DescriptorWrite writes[2];
    writes[0].view = &cached.view(m_device, rhi::ViewType::Sampled);
    writes[0].layout = isMoved ? sampled.layout : before.layout;
    writes[1].binding = 1;
    writes[1].buffer = &buffer;
    writes[1].size = byteSize;
    rhi::DescriptorSet& set = m_descriptors->allocate(m_pipeline, 0);
    set.write(writes);
    m_copies.push_back({&buffer, &set, image.width, image.height});
}

void ImageCopies::record(rhi::CommandBuffer& commands)
{
    if (m_recorded == m_copies.size()) return;
    commands.barriers(m_textureBarriers, m_bufferBarriers);
    commands.bindPipeline(m_pipeline);
    for (; m_recorded < m_copies.size(); m_recorded++)
    {
        const Copy& copy = m_copies[m_recorded];
        commands.bindSet(0, *copy.set, {});
        commands.dispatch((copy.width + kGroupSize - 1) / kGroupSize, (copy.height + kGroupSize - 1) / kGroupSize, 1);
    }
    for (rhi::BufferBarrier& barrier : m_bufferBarriers) std::swap(barrier.before, barrier.after);
    commands.barriers({}, m_bufferBarriers);
}

NrdImageState copiedState(const NrdImageState& before, LayoutPolicy layoutPolicy)
{
    const rhi::TextureState sampled = toRhi(ResourceState::SAMPLED, layoutPolicy);
    return needsBarrier(toRhi(before), sampled) ? toImageState(sampled) : before;
}
} // namespace nrd
