#include "history_transfer.h"
#include "convert.h"
#include "nrd_integration_shaders.h"
#include "refusal.h"
#include <algorithm>

namespace nrd
{
namespace
{
constexpr uint32_t kGroupSize = 8; // of move_history.comp.glsl

uint32_t groupCount(uint32_t texels) { return (texels + kGroupSize - 1) / kGroupSize; }
} // namespace

const rhi::Pipeline& TransferPipelines::get(rhi::FormatClass formatClass)
{
    const bool isUint = formatClass == rhi::FormatClass::Uint;
    std::unique_ptr<rhi::Pipeline>& pipeline = isUint ? m_ofUints : m_ofFloats;
    if (pipeline) return *pipeline;
    const integration::ShaderBlob blob =
        integration::shaderBlob(isUint ? integration::Shader::MoveHistoryUint : integration::Shader::MoveHistoryFloat);
    const std::string name = sentence("%s %s", m_name, blob.name);
    const rhi::BindingDesc bindings[] = {{0, 0, rhi::BindingType::SampledTexture},
                                         {0, 1, rhi::BindingType::StorageTexture}};
    rhi::PipelineDesc desc;
    desc.spirv = {blob.words, blob.byteSize / sizeof(uint32_t)};
    desc.bindings = bindings;
    desc.name = name.c_str();
    pipeline = m_device.createPipeline(desc);
    return *pipeline;
}

HistoryTransfer::HistoryTransfer(std::unique_ptr<Pools> source, uint64_t lastFrame)
    : m_source(std::move(source)), m_size{m_source->width(), m_source->height()}, m_lastFrame(lastFrame)
{
}

bool HistoryTransfer::isContinuedBy(const CommonSettings& settings) const
{
    return settings.resourceSizePrev[0] == m_size[0] && settings.resourceSizePrev[1] == m_size[1];
}

CommonSettings HistoryTransfer::adapt(const CommonSettings& settings) const
{
    CommonSettings result = settings;
    for (size_t i = 0; i < 2; i++)
    {
        const uint32_t size = settings.resourceSize[i], rect = settings.rectSizePrev[i];
        if (rect == 0 || rect > m_size[i]) return settings; // refused, with the application's numbers
        result.resourceSizePrev[i] = settings.resourceSize[i];
        const uint32_t shrunk = std::max(rect * size / m_size[i], 1u); // as move_history.comp.glsl shrinks
        result.rectSizePrev[i] = static_cast<uint16_t>(size < m_size[i] ? shrunk : rect);
    }
    return result;
}

void HistoryTransfer::plan(rhi::Device& device, TransferPipelines& pipelines, LayoutPolicy layoutPolicy, Pools& target)
{
    m_moves.clear();
    m_barriers.clear();
    const TexturePool& textures = target.permanent();
    const std::string name = sentence("history at %u x %u", target.width(), target.height());
    rhi::DescriptorPoolDesc room;
    room.sets = room.sampledTextures = room.storageTextures = textures.size();
    room.name = name.c_str();
    m_sets = std::make_unique<Sets>();
    m_sets->pool = device.createDescriptorPool(room);
    const rhi::TextureState sampled = toRhi(ResourceState::SAMPLED, layoutPolicy);
    for (uint32_t i = 0; i < textures.size(); i++)
    {
        if (m_source->states.state(i) == rhi::states::kUndefined) continue; // its denoiser has never run
        planMove(pipelines.get(rhi::formatInfo(textures.texture(i).desc().format).formatClass), sampled, target, i);
    }
    for (const Move& move : m_moves) target.states.setState(move.texture, rhi::states::kStorageWrite);
}

void HistoryTransfer::planMove(const rhi::Pipeline& pipeline, const rhi::TextureState& sampled, const Pools& target,
                               uint32_t texture)
{
    const rhi::Texture& to = target.permanent().texture(texture);
    const rhi::TextureState& before = m_source->states.state(texture);
    if (needsBarrier(before, sampled)) m_barriers.push_back({&m_source->permanent().texture(texture), before, sampled});
    m_barriers.push_back({&to, rhi::states::kUndefined, rhi::states::kStorageWrite});

    rhi::DescriptorWrite writes[2];
    writes[0].view = &m_source->permanent().view(texture, rhi::ViewType::Sampled);
    writes[0].layout = sampled.layout;
    writes[1].binding = 1;
    writes[1].view = &target.permanent().view(texture, rhi::ViewType::Storage);
    writes[1].layout = rhi::states::kStorageWrite.layout;
    rhi::DescriptorSet& set = m_sets->pool->allocate(pipeline, 0);
    set.write(writes);
    m_moves.push_back({&pipeline, &set, texture, {groupCount(to.desc().width), groupCount(to.desc().height)}});
}

void HistoryTransfer::cancel(Pools& target) const
{
    for (const Move& move : m_moves) target.states.setState(move.texture, rhi::states::kUndefined);
}

void HistoryTransfer::record(rhi::CommandBuffer& commands) const
{
    commands.beginLabel("history to another size");
    commands.barriers(m_barriers, {});
    for (const Move& move : m_moves)
    {
        commands.bindPipeline(*move.pipeline);
        commands.bindSet(0, *move.set, {});
        commands.dispatch(move.groups[0], move.groups[1], 1);
    }
    commands.endLabel();
}

void HistoryTransfer::finish(uint64_t frame, RetireQueue& queue)
{
    queue.retire(frame, std::move(m_source));
    if (m_sets) queue.retire(frame, std::move(m_sets));
}
} // namespace nrd
