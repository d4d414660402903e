#include "diagnosis.h"
#include "convert.h"
#include "nrd_integration_shaders.h"
#include "pools.h"
#include "refusal.h"
#include "state_tracker.h"
#include <algorithm>

namespace nrd
{
namespace
{
constexpr uint32_t kGroupSize = 8;   // of read_texels.comp.glsl
constexpr uint32_t kTexelSize = 16;  // bytes of its vec4
constexpr uint32_t kMostImages = 16; // in a recording
constexpr rhi::BufferState kHostRead = {rhi::Access::HostRead, rhi::Stage::Host};
constexpr rhi::BufferState kShaderWrite = {rhi::Access::StorageWrite, rhi::Stage::Compute};

std::unique_ptr<rhi::Pipeline> createPipeline(rhi::Device& device, const char* name)
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

bool isFirstOfItsImage(rhi::Span<const DiagnosedImage> images, size_t index)
{
    for (size_t i = 0; i < index; i++)
        if (images[i].image->image == images[index].image->image) return false;
    return true;
}
} // namespace

Diagnosis::Diagnosis(rhi::Device& device, const char* name)
    : m_device(device), m_name(name), m_pipeline(createPipeline(device, name))
{
}

Diagnosis::Recording& Diagnosis::freeRecording()
{
    for (const std::unique_ptr<Recording>& recording : m_recordings)
        if (recording->frame == 0) return *recording;
    auto recording = std::make_unique<Recording>();
    rhi::DescriptorPoolDesc pool;
    pool.sets = pool.sampledTextures = pool.storageBuffers = kMostImages;
    const std::string name = sentence("%s diagnosis", m_name.c_str());
    pool.name = name.c_str();
    recording->descriptors = m_device.createDescriptorPool(pool);
    m_recordings.push_back(std::move(recording));
    return *m_recordings.back();
}

const rhi::Buffer& Diagnosis::bufferOf(Recording& recording, size_t index, uint64_t size)
{
    if (recording.buffers.size() <= index) recording.buffers.resize(index + 1);
    std::unique_ptr<rhi::Buffer>& buffer = recording.buffers[index];
    if (buffer && buffer->desc().size >= size) return *buffer;
    const std::string name = sentence("%s diagnosis", m_name.c_str());
    const std::string tag = memoryTag(m_name.c_str(), "buffers");
    buffer = m_device.createBuffer(
        {size, rhi::BufferUsage::Storage, rhi::BufferMemory::Readback, name.c_str(), tag.c_str()});
    return *buffer;
}

void Diagnosis::plan(Recording& recording, const DiagnosisContext& context, rhi::Span<const DiagnosedImage> images)
{
    const rhi::TextureState sampled = toRhi(ResourceState::SAMPLED, context.layoutPolicy);
    recording.descriptors->reset();
    recording.copies.clear();
    m_textureBarriers.clear();
    m_bufferBarriers.clear();
    for (size_t i = 0; i < images.size(); i++)
    {
        const NrdUserImage& image = *images[i].image;
        CachedImage& cached = context.views.acquire(image, images[i].name, context.frame, context.retired);
        const rhi::Buffer& buffer = bufferOf(recording, i, uint64_t{image.width} * image.height * kTexelSize);
        const rhi::TextureState before = toRhi(image.state);
        const bool isMoved = needsBarrier(before, sampled);
        if (isMoved && isFirstOfItsImage(images, i)) m_textureBarriers.push_back({&cached.texture(), before, sampled});
        m_bufferBarriers.push_back({&buffer, kHostRead, kShaderWrite});
        rhi::DescriptorWrite writes[2];
        writes[0].view = &cached.view(m_device, rhi::ViewType::Sampled);
        writes[0].layout = isMoved ? sampled.layout : before.layout;
        writes[1].binding = 1;
        writes[1].buffer = &buffer;
        writes[1].size = uint64_t{image.width} * image.height * kTexelSize;
        rhi::DescriptorSet& set = recording.descriptors->allocate(*m_pipeline, 0);
        set.write(writes);
        recording.copies.push_back({images[i].texels, &buffer, &set, image.width, image.height});
    }
}

void Diagnosis::record(rhi::CommandBuffer& commands, const DiagnosisContext& context, const DoctorFrame& input,
                       rhi::Span<const DiagnosedImage> images)
{
    Recording& recording = freeRecording();
    plan(recording, context, images);
    // From here on nothing fails.
    recording.input = input;
    recording.frame = m_lastFrame = context.frame;
    commands.beginLabel("diagnosis");
    commands.barriers(m_textureBarriers, m_bufferBarriers);
    commands.bindPipeline(*m_pipeline);
    for (const Copy& copy : recording.copies)
    {
        commands.bindSet(0, *copy.set, {});
        commands.dispatch((copy.width + kGroupSize - 1) / kGroupSize, (copy.height + kGroupSize - 1) / kGroupSize, 1);
    }
    for (rhi::BufferBarrier& barrier : m_bufferBarriers) std::swap(barrier.before, barrier.after);
    commands.barriers({}, m_bufferBarriers);
    commands.endLabel();
    const rhi::TextureState sampled = toRhi(ResourceState::SAMPLED, context.layoutPolicy);
    for (const DiagnosedImage& diagnosed : images)
        if (needsBarrier(toRhi(diagnosed.image->state), sampled)) diagnosed.image->state = toImageState(sampled);
}

void Diagnosis::look(uint64_t lastFrame)
{
    while (true)
    {
        Recording* oldest = nullptr;
        for (const std::unique_ptr<Recording>& recording : m_recordings)
            if (recording->frame != 0 && recording->frame <= lastFrame && (!oldest || recording->frame < oldest->frame))
                oldest = recording.get();
        if (!oldest) return;
        oldest->frame = 0; // also if the doctor refuses it
        for (const Copy& copy : oldest->copies)
            oldest->input.*copy.texels = static_cast<const float*>(copy.buffer->mapped());
        const Result result = m_doctor.AddFrame(oldest->input);
        if (result == Result::FAILURE)
            throw Refusal(result, "the doctor could not look at a frame: out of host memory");
        if (result != Result::SUCCESS) throw Refusal(result, m_doctor.GetLastMessage());
    }
}
} // namespace nrd
