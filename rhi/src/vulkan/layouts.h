// Descriptor set layouts and pipeline layouts, shared by all pipelines with equal bindings.
#pragma once
#include "context.h"
#include <array>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

namespace rhi::vulkan
{
struct SetLayout
{
    UniqueSetLayout owner;
    std::vector<BindingDesc> bindings;       // by binding number; their set is 0
    std::array<uint32_t, 5> typeCounts = {}; // by BindingType
    uint32_t dynamicCount = 0;
};

struct PipelineLayout
{
    UniquePipelineLayout owner;
    std::vector<const SetLayout*> sets;
};

class LayoutCache
{
public:
    explicit LayoutCache(const Context& context) : m_context(context) {}
    /// Valid for as long as the cache. From any thread.
    const PipelineLayout& find(Span<const BindingDesc> bindings);

private:
    const SetLayout& findSet(std::vector<BindingDesc> bindings);
    VkSampler sampler(SamplerKind kind);

    const Context& m_context;
    std::mutex m_mutex;
    std::array<UniqueSampler, 4> m_samplers; // by SamplerKind, made when first asked for
    std::map<std::vector<uint32_t>, std::unique_ptr<SetLayout>> m_sets;
    std::map<std::vector<const SetLayout*>, std::unique_ptr<PipelineLayout>> m_layouts;
};
} // namespace rhi::vulkan
