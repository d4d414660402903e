#include "engine/compute.h"

#include <map>

namespace engine
{
namespace
{
UniqueSetLayout createSetLayout(const Device& device, const ComputeDesc& desc)
{
    std::vector<VkDescriptorSetLayoutBinding> bindings;
    for (uint32_t i = 0; i < desc.bindings.size(); ++i)
        bindings.push_back({i, desc.bindings[i], 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr});
    auto info = describe<VkDescriptorSetLayoutCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
    info.bindingCount = static_cast<uint32_t>(bindings.size());
    info.pBindings = bindings.data();
    VkDescriptorSetLayout layout = VK_NULL_HANDLE;
    check(vkCreateDescriptorSetLayout(device.handle(), &info, nullptr, &layout), "create the layout of " + desc.name);
    return {device.handle(), layout};
}

UniquePipelineLayout createLayout(const Device& device, const ComputeDesc& desc, VkDescriptorSetLayout set)
{
    const VkPushConstantRange range = {VK_SHADER_STAGE_COMPUTE_BIT, 0, desc.pushConstantByteSize};
    auto info = describe<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
    info.setLayoutCount = 1;
    info.pSetLayouts = &set;
    info.pushConstantRangeCount = desc.pushConstantByteSize ? 1 : 0;
    info.pPushConstantRanges = &range;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    check(vkCreatePipelineLayout(device.handle(), &info, nullptr, &layout), "create the layout of " + desc.name);
    return {device.handle(), layout};
}

UniquePipeline createPipeline(const Device& device, const ComputeDesc& desc, VkPipelineLayout layout)
{
    auto moduleInfo = describe<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
    moduleInfo.codeSize = desc.byteSize;
    moduleInfo.pCode = desc.words;
    VkShaderModule handle = VK_NULL_HANDLE;
    check(vkCreateShaderModule(device.handle(), &moduleInfo, nullptr, &handle), "create shader " + desc.name);
    const UniqueShaderModule shader(device.handle(), handle);
    std::vector<VkSpecializationMapEntry> entries;
    for (uint32_t i = 0; i < desc.specialization.size(); ++i)
        entries.push_back({i, static_cast<uint32_t>(i * sizeof(uint32_t)), sizeof(uint32_t)});
    const VkSpecializationInfo constants = {static_cast<uint32_t>(entries.size()), entries.data(),
                                            desc.specialization.size() * sizeof(uint32_t), desc.specialization.data()};
    auto info = describe<VkComputePipelineCreateInfo>(VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO);
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.module = shader.get();
    info.stage.pName = "main";
    info.stage.pSpecializationInfo = &constants;
    info.layout = layout;
    VkPipeline pipeline = VK_NULL_HANDLE;
    check(vkCreateComputePipelines(device.handle(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline),
          "create pipeline " + desc.name);
    device.setName(VK_OBJECT_TYPE_PIPELINE, reinterpret_cast<uint64_t>(pipeline), desc.name);
    return {device.handle(), pipeline};
}

UniqueDescriptorPool createPool(const Device& device, const ComputeDesc& desc)
{
    std::map<VkDescriptorType, uint32_t> counts;
    for (VkDescriptorType type : desc.bindings) counts[type] += desc.setCount;
    std::vector<VkDescriptorPoolSize> sizes;
    for (const auto& [type, count] : counts) sizes.push_back({type, count});
    auto info = describe<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
    info.maxSets = desc.setCount;
    info.poolSizeCount = static_cast<uint32_t>(sizes.size());
    info.pPoolSizes = sizes.data();
    VkDescriptorPool pool = VK_NULL_HANDLE;
    check(vkCreateDescriptorPool(device.handle(), &info, nullptr, &pool), "create the pool of " + desc.name);
    return {device.handle(), pool};
}
} // namespace

ComputePipeline::ComputePipeline(const Device& device, const ComputeDesc& desc) : m_desc(desc)
{
    m_setLayout = createSetLayout(device, desc);
    m_layout = createLayout(device, desc, m_setLayout.get());
    m_pipeline = createPipeline(device, desc, m_layout.get());
    m_pool = createPool(device, desc);
}

VkDescriptorSet ComputePipeline::createSet(const std::vector<Binding>& bindings) const
{
    const VkDescriptorSetLayout layout = m_setLayout.get();
    auto info = describe<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO);
    info.descriptorPool = m_pool.get();
    info.descriptorSetCount = 1;
    info.pSetLayouts = &layout;
    VkDescriptorSet set = VK_NULL_HANDLE;
    check(vkAllocateDescriptorSets(m_pool.device(), &info, &set), "allocate a descriptor set of " + m_desc.name);
    writeSet(set, bindings);
    return set;
}

void ComputePipeline::writeSet(VkDescriptorSet set, const std::vector<Binding>& bindings) const
{
    if (bindings.size() != m_desc.bindings.size())
        throw Error("pipeline " + m_desc.name + " has " + std::to_string(m_desc.bindings.size()) + " bindings, not " +
                    std::to_string(bindings.size()));
    std::vector<VkDescriptorImageInfo> images(bindings.size());
    std::vector<VkDescriptorBufferInfo> buffers(bindings.size());
    std::vector<VkWriteDescriptorSet> writes(bindings.size());
    for (uint32_t i = 0; i < bindings.size(); ++i)
    {
        const VkDescriptorType type = m_desc.bindings[i];
        images[i] = {bindings[i].sampler, bindings[i].view,
                     type == VK_DESCRIPTOR_TYPE_STORAGE_IMAGE ? kStorage.layout : kSampled.layout};
        buffers[i] = {bindings[i].buffer, 0, VK_WHOLE_SIZE};
        writes[i] = {VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                     nullptr,
                     set,
                     i,
                     0,
                     1,
                     type,
                     &images[i],
                     &buffers[i],
                     &bindings[i].texelView};
    }
    vkUpdateDescriptorSets(m_pool.device(), static_cast<uint32_t>(writes.size()), writes.data(), 0, nullptr);
}

void ComputePipeline::dispatch(VkCommandBuffer cmd, VkDescriptorSet set, std::span<const std::byte> pushConstants,
                               VkExtent3D groups) const
{
    vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, m_pipeline.get());
    vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, m_layout.get(), 0, 1, &set, 0, nullptr);
    if (!pushConstants.empty())
        vkCmdPushConstants(cmd, m_layout.get(), VK_SHADER_STAGE_COMPUTE_BIT, 0,
                           static_cast<uint32_t>(pushConstants.size()), pushConstants.data());
    vkCmdDispatch(cmd, groups.width, groups.height, groups.depth);
}

UniqueSampler createSampler(const Device& device, VkFilter filter, VkSamplerAddressMode addressMode)
{
    auto info = describe<VkSamplerCreateInfo>(VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO);
    info.magFilter = filter;
    info.minFilter = filter;
    info.addressModeU = addressMode;
    info.addressModeV = addressMode;
    info.addressModeW = addressMode;
    VkSampler sampler = VK_NULL_HANDLE;
    check(vkCreateSampler(device.handle(), &info, nullptr, &sampler), "create a sampler");
    return {device.handle(), sampler};
}
} // namespace engine
