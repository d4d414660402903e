#include "objects.h"
#include "../checks.h"
#include "../spirv.h"
#include <algorithm>

namespace rhi::validation
{
TextureFacts::TextureFacts(const Texture& texture)
    : Resource("texture", texture.name()), desc(texture.desc()), mips(texture.desc().mipCount)
{
    desc.name = name.c_str();
    desc.memoryTag = "";
}

std::vector<TextureFacts*> TextureFacts::aliases() const
{
    std::vector<TextureFacts*> result;
    if (!memory) return result;
    for (TextureFacts* other : memory->textures)
        if (other != this && other->place.begin < place.end && place.begin < other->place.end) result.push_back(other);
    return result;
}

PipelineFacts::PipelineFacts(const PipelineDesc& desc) : Resource("pipeline", safeName(desc.name))
{
    const SpirvInfo spirv = inspectSpirv(desc.spirv);
    for (const BindingDesc& b : desc.bindings)
    {
        Binding binding = {{0, b.binding, b.type, b.sampler}, false, false};
        for (const SpirvBinding& declared : spirv.bindings)
        {
            if (declared.set != b.set || declared.binding != b.binding) continue;
            binding.isUsed = true;
            binding.isReadOnly = declared.isReadOnly;
        }
        sets.at(b.set).push_back(binding);
    }
    for (std::vector<Binding>& set : sets)
        std::sort(set.begin(), set.end(),
                  [](const Binding& a, const Binding& b) { return a.desc.binding < b.desc.binding; });
}

bool areCompatible(const std::vector<Binding>& a, const std::vector<Binding>& b)
{
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const Binding& x, const Binding& y)
                      {
                          const bool isSampler = x.desc.type == BindingType::Sampler;
                          return x.desc.binding == y.desc.binding && x.desc.type == y.desc.type &&
                                 (!isSampler || x.desc.sampler == y.desc.sampler);
                      });
}

std::string misuseOfDestruction(const TextureFacts& facts)
{
    if (facts.viewCount == 0) return "";
    return facts.text() + " is destroyed while " + std::to_string(facts.viewCount) + " of its views live";
}

std::string misuseOfDestruction(const MemoryFacts& facts)
{
    if (facts.textures.empty()) return "";
    return facts.text() + " is destroyed while " + facts.textures.front()->text() + " is placed in it";
}

void onDestruction(const TextureFacts& facts)
{
    if (facts.memory) std::erase(facts.memory->textures, &facts);
}

void onDestruction(const ViewFacts& facts) { facts.texture->viewCount--; }

bool ValidQueryPool::read(uint32_t first, Span<uint64_t> ticks) const
{
    if (first <= count() && ticks.size() <= count() - first) return m_inner->read(first, ticks);
    m_validator.report(sentence("query pool '%s', read(): queries [%u; %u + %zu) do not exist, it has %u", name(),
                                first, first, ticks.size(), count()));
    return false;
}

bool ValidFence::isSignaled() const
{
    const bool isDone = m_inner->isSignaled();
    if (isDone) m_validator.complete(m_facts->lastSubmission);
    return isDone;
}

bool ValidFence::wait(uint64_t timeout)
{
    if (!m_facts->isSubmitted)
    {
        m_validator.report(m_facts->text() + ", wait(): it was not submitted, so it would wait for ever");
        return false;
    }
    const bool isDone = m_inner->wait(timeout);
    if (isDone) m_validator.complete(m_facts->lastSubmission);
    return isDone;
}

void ValidFence::reset()
{
    if (m_validator.isPending(*m_facts))
    {
        m_validator.report(m_facts->text() + ", reset(): its submission is pending");
        return;
    }
    m_facts->isSubmitted = false;
    m_inner->reset();
}
} // namespace rhi::validation
