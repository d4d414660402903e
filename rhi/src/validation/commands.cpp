// Recording, pipelines, sets, dispatches and queries. Barriers and copies are in transfers.cpp.
#include "commands.h"
#include "../checks.h"

namespace rhi::validation
{
ValidCommandBuffer::ValidCommandBuffer(Validator& validator, const DeviceLimits& limits,
                                       std::unique_ptr<CommandBuffer> inner, bool isWrapped)
    : Decorator(validator, nullptr, std::make_shared<CommandFacts>(inner->name(), isWrapped), inner->name()),
      m_limits(limits)
{
    m_inner = std::move(inner);
    if (isWrapped) m_facts->recording = validator.newRecording();
}

std::string ValidCommandBuffer::where() const { return m_facts->text() + ", " + m_call + "()"; }

bool ValidCommandBuffer::fail(const std::string& text) const
{
    m_validator.report(where() + ": " + text);
    return false;
}

bool ValidCommandBuffer::isReady(const char* call)
{
    m_call = call;
    m_textureUses.clear();
    m_bufferUses.clear();
    return m_facts->phase == Phase::Recording || fail("it is not between begin() and end()");
}

void ValidCommandBuffer::begin()
{
    m_call = "begin";
    if (m_facts->isWrapped) return static_cast<void>(fail("it is wrapped, and the engine begins and ends it"));
    if (m_facts->phase == Phase::Recording) return static_cast<void>(fail("it is being recorded already"));
    if (m_validator.isPending(*m_facts)) return static_cast<void>(fail("a submission of it is pending"));
    if (m_facts->recording && m_facts->recording->submission == 0) m_facts->recording->isDropped = true;
    m_facts->recording = m_validator.newRecording();
    m_facts->used.clear();
    m_facts->phase = Phase::Recording;
    m_pipeline = nullptr;
    m_pipelineFacts = nullptr;
    m_sets = {};
    m_labelCount = 0;
    m_inner->begin();
}

void ValidCommandBuffer::end()
{
    if (m_facts->isWrapped)
    {
        m_call = "end";
        return static_cast<void>(fail("it is wrapped, and the engine begins and ends it"));
    }
    if (!isReady("end")) return;
    if (m_labelCount > 0) return static_cast<void>(fail(std::to_string(m_labelCount) + " labels are still open"));
    m_facts->phase = Phase::Executable;
    m_inner->end();
}

std::shared_ptr<TextureFacts> ValidCommandBuffer::find(const Texture* texture) const
{
    if (!m_validator.isUsable(texture, "texture", where())) return nullptr;
    return static_cast<const ValidTexture*>(texture)->facts();
}

std::shared_ptr<BufferFacts> ValidCommandBuffer::find(const Buffer* buffer) const
{
    if (!m_validator.isUsable(buffer, "buffer", where())) return nullptr;
    return static_cast<const ValidBuffer*>(buffer)->facts();
}

bool ValidCommandBuffer::useTexture(const std::shared_ptr<TextureFacts>& texture, MipRange mips, const Use& use,
                                    const std::string& user)
{
    for (uint32_t mip = mips.first; mip < mips.first + mips.count; mip++)
    {
        const std::string error = texture->mips.at(mip).findError(use, now());
        if (!error.empty()) return fail(texture->text() + " mip " + std::to_string(mip) + " " + error + user);
        m_textureUses.push_back({texture, mip, use});
    }
    return true;
}

bool ValidCommandBuffer::useBuffer(const std::shared_ptr<BufferFacts>& buffer, ByteRange range, const Use& use,
                                   const std::string& user)
{
    const std::string error = buffer->tracker.findError(use, range, now());
    if (!error.empty()) return fail(buffer->text() + " " + error + user);
    m_bufferUses.push_back({buffer, range, use});
    return true;
}

void ValidCommandBuffer::touch(const std::shared_ptr<Resource>& resource)
{
    if (resource->lastRecording == m_facts->recording->id) return;
    resource->lastRecording = m_facts->recording->id;
    if (!m_facts->isWrapped) m_facts->used.push_back(resource); // nobody says when the engine submits
}

void ValidCommandBuffer::commitUses()
{
    for (const TextureUse& use : m_textureUses)
    {
        use.texture->mips.at(use.mip).apply(use.use, now());
        touch(use.texture);
    }
    for (const BufferUse& use : m_bufferUses)
    {
        use.buffer->tracker.apply(use.use, use.range, now());
        touch(use.buffer);
    }
}

void ValidCommandBuffer::bindPipeline(const Pipeline& pipeline)
{
    if (!isReady("bindPipeline") || !m_validator.isUsable(&pipeline, "pipeline", where())) return;
    m_pipeline = static_cast<const ValidPipeline*>(&pipeline);
    m_pipelineFacts = m_pipeline->facts();
    touch(m_pipelineFacts);
    m_inner->bindPipeline(m_pipeline->inner());
}

bool ValidCommandBuffer::checkOffsets(const SetFacts& facts, Span<const uint32_t> dynamicOffsets) const
{
    if (dynamicOffsets.size() != facts.dynamicCount)
        return fail(facts.text() + " takes " + std::to_string(facts.dynamicCount) + " dynamic offsets, got " +
                    std::to_string(dynamicOffsets.size()));
    size_t next = 0;
    for (const BoundResource& bound : facts.bound)
    {
        if (bound.binding->desc.type != BindingType::UniformBufferDynamic) continue;
        const uint32_t offset = dynamicOffsets[next++];
        if (offset % m_limits.uniformOffsetAlignment != 0)
            return fail(sentence("dynamic offset %u into %s is not a multiple of %u", offset,
                                 bound.buffer->text().c_str(), m_limits.uniformOffsetAlignment));
        if (bound.offset + offset + bound.size > bound.buffer->desc.size)
            return fail(
                sentence("dynamic offset %u reaches beyond the end of %s", offset, bound.buffer->text().c_str()));
    }
    return true;
}

void ValidCommandBuffer::bindSet(uint32_t set, const DescriptorSet& descriptorSet, Span<const uint32_t> dynamicOffsets)
{
    if (!isReady("bindSet") || !m_validator.isUsable(&descriptorSet, "descriptor set", where())) return;
    const auto& valid = static_cast<const ValidSet&>(descriptorSet);
    const SetFacts& facts = *valid.facts();
    if (!m_pipelineFacts) return static_cast<void>(fail("no pipeline is bound"));
    if (set >= kMaxSets) return static_cast<void>(fail("set " + std::to_string(set) + " does not exist"));
    if (!areCompatible(facts.bindings, m_pipelineFacts->sets.at(set)))
        return static_cast<void>(
            fail(facts.text() + " does not fit set " + std::to_string(set) + " of " + m_pipelineFacts->text()));
    const bool needsWrite = facts.bindings.size() > 0 && !facts.isWritten;
    bool isSamplersOnly = true;
    for (const Binding& binding : facts.bindings) isSamplersOnly &= binding.desc.type == BindingType::Sampler;
    if (needsWrite && !isSamplersOnly) return static_cast<void>(fail(facts.text() + " was not written"));
    if (!checkOffsets(facts, dynamicOffsets)) return;
    BoundSet& bound = m_sets.at(set);
    bound.set = &valid;
    bound.facts = valid.facts();
    for (size_t i = 0; i < dynamicOffsets.size(); i++) bound.offsets.at(i) = dynamicOffsets[i];
    touch(bound.facts);
    m_inner->bindSet(set, valid.inner(), dynamicOffsets);
}

bool ValidCommandBuffer::useView(const BoundResource& resource, const Binding& binding, const std::string& user)
{
    if (!resource.view->isAlive || !resource.view->texture->isAlive)
        return fail(resource.view->text() + " was destroyed" + user);
    touch(resource.view);
    if (!binding.isUsed) return true;
    const std::shared_ptr<TextureFacts>& texture = resource.view->texture;
    const MipRange mips = resource.view->desc.mips;
    if (binding.desc.type == BindingType::SampledTexture)
        return useTexture(texture, mips, {Access::SampledRead, Stage::Compute, resource.layout, false}, user);
    const Access allowed = texture->mips.at(mips.first).allowed();
    const bool isRead = binding.isReadOnly || allowed == Access::StorageRead;
    const Access access = isRead ? Access::StorageRead : Access::StorageWrite;
    return useTexture(texture, mips, {access, Stage::Compute, Layout::General, !isRead}, user);
}

bool ValidCommandBuffer::useBoundBuffer(const BoundResource& resource, const Binding& binding, uint32_t dynamicOffset,
                                        const std::string& user)
{
    if (!resource.buffer->isAlive) return fail(resource.buffer->text() + " was destroyed" + user);
    if (!binding.isUsed) return true;
    const uint64_t begin = resource.offset + dynamicOffset;
    const ByteRange range = {begin, begin + resource.size};
    if (binding.desc.type == BindingType::UniformBufferDynamic)
        return useBuffer(resource.buffer, range, {Access::UniformRead, Stage::Compute, Layout::General, false}, user);
    const Access allowed = resource.buffer->tracker.allowed();
    const bool isRead = binding.isReadOnly || allowed == Access::StorageRead;
    const Access access = isRead ? Access::StorageRead : Access::StorageWrite;
    return useBuffer(resource.buffer, range, {access, Stage::Compute, Layout::General, !isRead}, user);
}

bool ValidCommandBuffer::checkBound(uint32_t set, const BoundSet& bound)
{
    const std::string setText = "set " + std::to_string(set) + " of " + m_pipelineFacts->text();
    if (!bound.facts) return fail(setText + " is not bound");
    if (!bound.facts->isAlive) return fail(bound.facts->text() + " was given back to its pool");
    if (!areCompatible(bound.facts->bindings, m_pipelineFacts->sets.at(set)))
        return fail(bound.facts->text() + " does not fit " + setText);
    size_t nextOffset = 0;
    for (const BoundResource& resource : bound.facts->bound)
    {
        // The set may have been made for another pipeline: what this one declares counts.
        const Binding& binding =
            m_pipelineFacts->sets.at(set).at(static_cast<size_t>(resource.binding - bound.facts->bindings.data()));
        const std::string user = sentence(", for binding %u of %s", binding.desc.binding, setText.c_str());
        const bool isDynamic = binding.desc.type == BindingType::UniformBufferDynamic;
        const uint32_t offset = isDynamic ? bound.offsets.at(nextOffset++) : 0;
        if (resource.view ? !useView(resource, binding, user) : !useBoundBuffer(resource, binding, offset, user))
            return false;
    }
    return true;
}

bool ValidCommandBuffer::checkSets()
{
    if (!m_pipelineFacts) return fail("no pipeline is bound");
    if (!m_pipelineFacts->isAlive) return fail(m_pipelineFacts->text() + " was destroyed");
    for (uint32_t set = 0; set < kMaxSets; set++)
        if (!m_pipelineFacts->sets.at(set).empty() && !checkBound(set, m_sets.at(set))) return false;
    return true;
}

void ValidCommandBuffer::dispatch(uint32_t x, uint32_t y, uint32_t z)
{
    if (!isReady("dispatch")) return;
    const std::array<uint32_t, 3> groups = {x, y, z};
    for (size_t i = 0; i < groups.size(); i++)
        if (groups[i] > m_limits.maxGroupCount[i])
            return static_cast<void>(
                fail(sentence("%u x %u x %u workgroups, the device allows %u x %u x %u", x, y, z,
                              m_limits.maxGroupCount[0], m_limits.maxGroupCount[1], m_limits.maxGroupCount[2])));
    if (!checkSets()) return;
    if (x > 0 && y > 0 && z > 0) commitUses();
    m_inner->dispatch(x, y, z);
}

void ValidCommandBuffer::dispatchIndirect(const Buffer& arguments, uint64_t offset)
{
    if (!isReady("dispatchIndirect")) return;
    const std::shared_ptr<BufferFacts> buffer = find(&arguments);
    if (!buffer || !checkRange(*buffer, offset, sizeof(DispatchArguments), BufferUsage::Indirect)) return;
    if (offset % 4 != 0)
        return static_cast<void>(fail(sentence("offset %llu into %s is not a multiple of 4",
                                               static_cast<unsigned long long>(offset), buffer->text().c_str())));
    const Use use = {Access::IndirectRead, Stage::Indirect, Layout::General, false};
    if (!useBuffer(buffer, {offset, offset + sizeof(DispatchArguments)}, use, ", for its arguments")) return;
    if (!checkSets()) return;
    commitUses();
    m_inner->dispatchIndirect(static_cast<const ValidBuffer&>(arguments).inner(), offset);
}

bool ValidCommandBuffer::checkQueries(const QueryPool& pool, uint32_t first, uint32_t count) const
{
    if (!m_validator.isUsable(&pool, "query pool", where())) return false;
    if (count > 0 && first < pool.count() && count <= pool.count() - first) return true;
    return fail(sentence("queries [%u; %u + %u) of query pool '%s' do not exist, it has %u", first, first, count,
                         pool.name(), pool.count()));
}

void ValidCommandBuffer::resetQueries(const QueryPool& pool, uint32_t first, uint32_t count)
{
    if (!isReady("resetQueries") || !checkQueries(pool, first, count)) return;
    const auto& valid = static_cast<const ValidQueryPool&>(pool);
    for (uint32_t i = first; i < first + count; i++) valid.facts()->isReset.at(i) = true;
    touch(valid.facts());
    m_inner->resetQueries(valid.inner(), first, count);
}

void ValidCommandBuffer::writeTimestamp(const QueryPool& pool, uint32_t query, Stage stage)
{
    if (!isReady("writeTimestamp") || !checkQueries(pool, query, 1)) return;
    const auto& valid = static_cast<const ValidQueryPool&>(pool);
    const bool isStage = stage == Stage::Compute || stage == Stage::Transfer || stage == Stage::AllCommands;
    if (!isStage)
        return static_cast<void>(fail("stage " + describe(stage) + ", expected Compute, Transfer or AllCommands"));
    if (!valid.facts()->isReset.at(query))
        return static_cast<void>(fail(sentence("query %u of query pool '%s' was not reset", query, pool.name())));
    valid.facts()->isReset.at(query) = false;
    touch(valid.facts());
    m_inner->writeTimestamp(valid.inner(), query, stage);
}

void ValidCommandBuffer::beginLabel(const char* text)
{
    if (!isReady("beginLabel")) return;
    if (!text) return static_cast<void>(fail("the text is null"));
    m_labelCount++;
    m_inner->beginLabel(text);
}

void ValidCommandBuffer::endLabel()
{
    if (!isReady("endLabel")) return;
    if (m_labelCount == 0) return static_cast<void>(fail("no label is open"));
    m_labelCount--;
    m_inner->endLabel();
}
} // namespace rhi::validation
