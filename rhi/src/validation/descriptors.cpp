#include "descriptors.h"
#include "../checks.h"
#include <algorithm>

namespace rhi::validation
{
SetFacts::SetFacts(const char* poolName, const PipelineFacts& pipeline, uint32_t set)
    : Resource("descriptor set", ""), bindings(pipeline.sets.at(set))
{
    name = "set " + std::to_string(set) + " of pipeline " + pipeline.name + ", from pool " + poolName;
    for (const Binding& binding : bindings) dynamicCount += binding.desc.type == BindingType::UniformBufferDynamic;
}

ValidSet::ValidSet(Validator& validator, const DeviceLimits& limits, DescriptorSet& inner,
                   std::shared_ptr<SetFacts> facts)
    : DescriptorSet(facts->name.c_str()), m_validator(validator), m_limits(limits), m_inner(inner),
      m_facts(std::move(facts))
{
    validator.add(this, m_facts);
}

bool ValidSet::fail(const Binding& binding, const std::string& text) const
{
    m_validator.report(m_facts->text() + ", write(): binding " + std::to_string(binding.desc.binding) + " " + text);
    return false;
}

bool ValidSet::checkView(const Binding& binding, const DescriptorWrite& write) const
{
    if (!write.view) return fail(binding, "needs a view");
    if (write.buffer) return fail(binding, "is a texture and was given a buffer as well");
    if (!m_validator.isUsable(write.view, "view", m_facts->text() + ", write()")) return false;
    const ViewFacts& view = *static_cast<const ValidView*>(write.view)->facts();
    if (!view.texture->isAlive) return fail(binding, "views " + view.texture->text() + ", which was destroyed");
    const bool isStorage = binding.desc.type == BindingType::StorageTexture;
    if ((view.desc.type == ViewType::Storage) != isStorage)
        return fail(binding, std::string("needs a ") + (isStorage ? "storage" : "sampled") + " view, and the view of " +
                                 view.texture->text() + " is of the other kind");
    const bool isReadable = write.layout == Layout::ShaderReadOnly || write.layout == Layout::General;
    if (!isStorage && !isReadable)
        return fail(binding, std::string("names layout ") + describe(write.layout) + " for " + view.texture->text() +
                                 ", expected ShaderReadOnly or General");
    return true;
}

bool ValidSet::checkBuffer(const Binding& binding, const DescriptorWrite& write) const
{
    if (!write.buffer) return fail(binding, "needs a buffer");
    if (write.view) return fail(binding, "is a buffer and was given a view as well");
    if (!m_validator.isUsable(write.buffer, "buffer", m_facts->text() + ", write()")) return false;
    const BufferFacts& buffer = *static_cast<const ValidBuffer*>(write.buffer)->facts();
    const bool isUniform = binding.desc.type == BindingType::UniformBufferDynamic;
    if (!hasAny(buffer.desc.usage, isUniform ? BufferUsage::Uniform : BufferUsage::Storage))
        return fail(binding, "needs " + std::string(isUniform ? "uniform" : "storage") + " usage, which " +
                                 buffer.text() + " lacks");
    const uint64_t alignment = isUniform ? m_limits.uniformOffsetAlignment : m_limits.storageOffsetAlignment;
    if (write.size == 0 || write.offset % std::max<uint64_t>(alignment, 1) != 0)
        return fail(binding, "has offset " + std::to_string(write.offset) + " and size " + std::to_string(write.size) +
                                 " in " + buffer.text() + ", expected a multiple of " + std::to_string(alignment) +
                                 " and a size > 0");
    if (write.offset > buffer.desc.size || write.size > buffer.desc.size - write.offset)
        return fail(binding, "reaches byte " + std::to_string(write.offset + write.size) + " of " + buffer.text() +
                                 ", which has " + std::to_string(buffer.desc.size));
    if (isUniform && write.size > m_limits.maxUniformSize)
        return fail(binding, "shows " + std::to_string(write.size) + " bytes of " + buffer.text() +
                                 ", the device allows " + std::to_string(m_limits.maxUniformSize));
    return true;
}

bool ValidSet::checkWrite(const Binding& binding, const DescriptorWrite& write) const
{
    switch (binding.desc.type)
    {
    case BindingType::Sampler:
        return fail(binding, "is an immutable sampler, which is never written");
    case BindingType::SampledTexture:
    case BindingType::StorageTexture:
        return checkView(binding, write);
    case BindingType::UniformBufferDynamic:
    case BindingType::StorageBuffer:
        return checkBuffer(binding, write);
    }
    return false;
}

void ValidSet::write(Span<const DescriptorWrite> writes)
{
    const std::string where = m_facts->text() + ", write()";
    if (!m_validator.isUsable(this, "descriptor set", where)) return;
    if (m_validator.isPending(*m_facts)) return m_validator.report(where + ": a submission that uses it is pending");
    if (m_facts->isWritten) return m_validator.report(where + ": it was written already since its allocation");
    std::vector<BoundResource> bound;
    std::vector<DescriptorWrite> inner;
    for (const DescriptorWrite& write : writes)
    {
        const auto found = std::find_if(m_facts->bindings.begin(), m_facts->bindings.end(),
                                        [&](const Binding& b) { return b.desc.binding == write.binding; });
        if (found == m_facts->bindings.end())
            return m_validator.report(where + ": it has no binding " + std::to_string(write.binding));
        const Binding& binding = *found;
        for (const BoundResource& other : bound)
            if (other.binding == &binding) return static_cast<void>(fail(binding, "is written twice"));
        if (!checkWrite(binding, write)) return;
        BoundResource& resource = bound.emplace_back(BoundResource{&binding, {}, Layout::General, {}, 0, 0});
        DescriptorWrite& passed = inner.emplace_back(write);
        resource.offset = write.offset;
        resource.size = write.size;
        if (write.view)
        {
            if (binding.desc.type == BindingType::SampledTexture) resource.layout = write.layout;
            resource.view = static_cast<const ValidView*>(write.view)->facts();
            passed.view = &static_cast<const ValidView*>(write.view)->inner();
            continue;
        }
        resource.buffer = static_cast<const ValidBuffer*>(write.buffer)->facts();
        passed.buffer = &static_cast<const ValidBuffer*>(write.buffer)->inner();
    }
    for (const Binding& binding : m_facts->bindings)
    {
        const auto isIt = [&](const BoundResource& b) { return b.binding == &binding; };
        if (binding.desc.type != BindingType::Sampler && std::none_of(bound.begin(), bound.end(), isIt))
            return static_cast<void>(fail(binding, "is missing"));
    }
    std::sort(bound.begin(), bound.end(),
              [](const BoundResource& a, const BoundResource& b) { return a.binding < b.binding; });
    m_facts->bound = std::move(bound);
    m_facts->isWritten = true;
    m_inner.write(inner);
}

DescriptorSet& ValidPool::allocate(const Pipeline& pipeline, uint32_t set)
{
    const std::string where = m_facts->text() + ", allocate()";
    if (!m_validator.isUsable(&pipeline, "pipeline", where)) throwInvalid(where + ": the pipeline cannot be used");
    const auto& valid = static_cast<const ValidPipeline&>(pipeline);
    if (set >= kMaxSets || valid.facts()->sets.at(set).empty())
    {
        const std::string text = where + ": " + valid.facts()->text() + " has no set " + std::to_string(set);
        m_validator.report(text);
        throwInvalid(text);
    }
    DescriptorSet& inner = m_inner->allocate(valid.inner(), set);
    auto facts = std::make_shared<SetFacts>(name(), *valid.facts(), set);
    return *m_sets.emplace_back(std::make_unique<ValidSet>(m_validator, m_limits, inner, std::move(facts)));
}

void ValidPool::reset()
{
    for (const auto& set : m_sets)
        if (m_validator.isPending(*set->facts()))
            return m_validator.report(m_facts->text() + ", reset(): a submission that uses " + set->facts()->text() +
                                      " is pending");
    for (const auto& set : m_sets) m_validator.retire(set.get());
    m_retired = std::move(m_sets);
    m_sets.clear();
    m_inner->reset();
}
} // namespace rhi::validation
