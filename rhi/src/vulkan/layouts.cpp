#include "layouts.h"
#include "convert.h"
#include <algorithm>

namespace rhi::vulkan
{
VkSampler LayoutCache::sampler(SamplerKind kind)
{
    UniqueSampler& slot = m_samplers.at(static_cast<size_t>(kind));
    if (slot.get()) return slot.get();
    const bool isLinear = kind == SamplerKind::LinearClamp || kind == SamplerKind::LinearMirroredRepeat;
    const bool isClamp = kind == SamplerKind::LinearClamp || kind == SamplerKind::NearestClamp;
    auto info = vkStruct<VkSamplerCreateInfo>(VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO);
    info.magFilter = info.minFilter = isLinear ? VK_FILTER_LINEAR : VK_FILTER_NEAREST;
    info.mipmapMode = isLinear ? VK_SAMPLER_MIPMAP_MODE_LINEAR : VK_SAMPLER_MIPMAP_MODE_NEAREST;
    info.addressModeU = info.addressModeV = info.addressModeW =
        isClamp ? VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE : VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT;
    info.maxLod = VK_LOD_CLAMP_NONE;
    VkSampler handle = VK_NULL_HANDLE;
    check(m_context.fn.createSampler(m_context.device, &info, m_context.callbacks, &handle), "sampler", "immutable");
    slot = UniqueSampler(m_context, handle);
    return handle;
}

const SetLayout& LayoutCache::findSet(std::vector<BindingDesc> bindings)
{
    const auto byBinding = [](const BindingDesc& a, const BindingDesc& b) { return a.binding < b.binding; };
    std::sort(bindings.begin(), bindings.end(), byBinding);
    std::vector<uint32_t> key;
    for (const BindingDesc& b : bindings)
    {
        const uint32_t samplerKey = b.type == BindingType::Sampler ? static_cast<uint32_t>(b.sampler) : 0;
        key.insert(key.end(), {b.binding, static_cast<uint32_t>(b.type), samplerKey});
    }
    if (const auto it = m_sets.find(key); it != m_sets.end()) return *it->second;

    auto layout = std::make_unique<SetLayout>();
    std::vector<VkSampler> samplers(bindings.size());
    std::vector<VkDescriptorSetLayoutBinding> vkBindings;
    for (size_t i = 0; i < bindings.size(); i++)
    {
        const BindingDesc& b = bindings[i];
        if (b.type == BindingType::Sampler) samplers[i] = sampler(b.sampler);
        vkBindings.push_back(
            {b.binding, toVulkan(b.type), 1, VK_SHADER_STAGE_COMPUTE_BIT, samplers[i] ? &samplers[i] : nullptr});
        layout->typeCounts.at(static_cast<size_t>(b.type))++;
        layout->dynamicCount += b.type == BindingType::UniformBufferDynamic;
    }
    auto info = vkStruct<VkDescriptorSetLayoutCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
    info.bindingCount = static_cast<uint32_t>(vkBindings.size());
    info.pBindings = vkBindings.data();
    VkDescriptorSetLayout handle = VK_NULL_HANDLE;
    check(m_context.fn.createDescriptorSetLayout(m_context.device, &info, m_context.callbacks, &handle),
          "descriptor set layout", "shared");
    layout->owner = UniqueSetLayout(m_context, handle);
    layout->bindings = std::move(bindings);
    return *m_sets.emplace(std::move(key), std::move(layout)).first->second;
}

const PipelineLayout& LayoutCache::find(Span<const BindingDesc> bindings)
{
    const std::lock_guard lock(m_mutex);
    uint32_t setCount = 0;
    for (const BindingDesc& b : bindings) setCount = std::max(setCount, b.set + 1);
    std::vector<const SetLayout*> sets;
    for (uint32_t set = 0; set < setCount; set++) // a set that is left out gets an empty layout
    {
        std::vector<BindingDesc> ofSet;
        for (const BindingDesc& b : bindings)
            if (b.set == set) ofSet.push_back({0, b.binding, b.type, b.sampler});
        sets.push_back(&findSet(std::move(ofSet)));
    }
    if (const auto it = m_layouts.find(sets); it != m_layouts.end()) return *it->second;

    std::vector<VkDescriptorSetLayout> handles;
    for (const SetLayout* set : sets) handles.push_back(set->owner.get());
    auto info = vkStruct<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
    info.setLayoutCount = setCount;
    info.pSetLayouts = handles.data();
    auto layout = std::make_unique<PipelineLayout>(); // before there is a handle to lose
    VkPipelineLayout handle = VK_NULL_HANDLE;
    check(m_context.fn.createPipelineLayout(m_context.device, &info, m_context.callbacks, &handle), "pipeline layout",
          "shared");
    layout->owner = UniquePipelineLayout(m_context, handle);
    layout->sets = sets;
    return *m_layouts.emplace(std::move(sets), std::move(layout)).first->second;
}
} // namespace rhi::vulkan
