#include "retrace.h"

#include "nrd_sample_shaders.h"

namespace sample
{
namespace
{
// As in the shader.
struct StoreConstants
{
    glm::uvec2 size;
    glm::uvec2 tiles;
    int32_t tileSize;
    int32_t stride;
};
} // namespace

Retrace::Retrace(const engine::Device& device, uint32_t width, uint32_t height)
    : m_size(width, height), m_tiles(engine::groupCount(width, kTileSize), engine::groupCount(height, kTileSize))
{
    const auto create = [&](const char* name, VkFormat format) {
        return engine::Image(device, {name, m_tiles.x, m_tiles.y, format});
    };
    m_stored = create("stored samples", VK_FORMAT_R16G16B16A16_SFLOAT);
    m_normalRoughness = create("stored normal and roughness", VK_FORMAT_A2B10G10R10_UNORM_PACK32);
    m_retraced = create("retraced samples", VK_FORMAT_R16G16B16A16_SFLOAT);
    const ShaderBlob blob = shaderBlob(Shader::StoreSamples);
    engine::ComputeDesc desc;
    desc.name = blob.name;
    desc.words = blob.words;
    desc.byteSize = blob.byteSize;
    desc.bindings.assign(4, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE);
    desc.bindings.resize(6, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE);
    desc.pushConstantByteSize = sizeof(StoreConstants);
    m_store = engine::ComputePipeline(device, desc);
}

void Retrace::record(VkCommandBuffer cmd, PathTracer& tracer, const View& lastView)
{
    store(cmd, tracer.images(), tracer.strideOfImages());
    tracer.recordRetrace(cmd, lastView, m_retraced, kTileSize);
}

void Retrace::store(VkCommandBuffer cmd, FrameImages& frame, uint32_t stride)
{
    engine::Image* const sources[] = {&frame.viewZ, &frame.normalRoughness, &frame.diffuse, &frame.specular};
    std::vector<engine::Binding> bindings;
    for (engine::Image* source : sources)
    {
        transition(cmd, *source, engine::kSampled);
        bindings.emplace_back(*source);
    }
    for (engine::Image* target : {&m_stored, &m_normalRoughness})
    {
        transition(cmd, *target, engine::kStorage);
        bindings.emplace_back(*target);
    }
    if (!m_storeSet) m_storeSet = m_store.createSet(bindings);
    const StoreConstants constants = {m_size, m_tiles, int32_t(kTileSize), int32_t(stride)};
    m_store.dispatch(cmd, m_storeSet, std::as_bytes(std::span(&constants, 1)),
                     {engine::groupCount(m_tiles.x, 8), engine::groupCount(m_tiles.y, 8), 1});
}
} // namespace sample
