#include "own_rhi.h"
#include "engine/compute.h"
#include "engine/error.h"
#include "formats.h"
#include <algorithm>
#include <cstring>

namespace example
{
namespace
{
// In the order of nrd::Format.
template <class Owner, class Create, class Info> Owner make(VkDevice device, Create create, const Info& info)
{
    decltype(Owner().get()) handle = VK_NULL_HANDLE;
    engine::check(create(device, &info, nullptr, &handle), "create an object of the denoiser");
    return {device, handle};
}

void barrier(VkCommandBuffer cmd)
{
    auto memory = engine::describe<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
    memory.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
    memory.dstAccessMask = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_INDIRECT_COMMAND_READ_BIT;
    vkCmdPipelineBarrier(cmd, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
                         VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT, 0, 1, &memory, 0,
                         nullptr, 0, nullptr);
}
} // namespace

OwnRhi::OwnRhi(const engine::Device& device, const nrd::InstanceDesc& desc, uint16_t width, uint16_t height,
               const ShaderSource& source)
    : m_device(device), m_desc(desc)
{
    createConstantsLayout();
    for (uint32_t i = 0; i < desc.pipelinesNum; i++) createPipeline(desc.pipelines[i], source);
    createPools(width, height);
    createDescriptorPool();
}

engine::UniqueSetLayout OwnRhi::makeSetLayout(const std::vector<VkDescriptorSetLayoutBinding>& bindings) const
{
    auto info = engine::describe<VkDescriptorSetLayoutCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
    info.bindingCount = static_cast<uint32_t>(bindings.size());
    info.pBindings = bindings.data();
    return make<engine::UniqueSetLayout>(m_device.handle(), vkCreateDescriptorSetLayout, info);
}

// The constants with an offset of their own for each dispatch, then the samplers.
void OwnRhi::createConstantsLayout()
{
    std::vector<VkDescriptorSetLayoutBinding> bindings = {{m_desc.constantBufferBinding,
                                                           VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC, 1,
                                                           VK_SHADER_STAGE_COMPUTE_BIT, nullptr}};
    std::vector<VkSampler> handles(m_desc.samplersNum);
    for (uint32_t i = 0; i < m_desc.samplersNum; i++)
    {
        const bool isLinear = m_desc.samplers[i] == nrd::Sampler::LINEAR_CLAMP;
        m_samplers.push_back(engine::createSampler(m_device, isLinear ? VK_FILTER_LINEAR : VK_FILTER_NEAREST,
                                                   VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE));
        handles[i] = m_samplers.back().get();
        bindings.push_back(
            {m_desc.samplersBaseBinding + i, VK_DESCRIPTOR_TYPE_SAMPLER, 1, VK_SHADER_STAGE_COMPUTE_BIT, &handles[i]});
    }
    m_constantsLayout = makeSetLayout(bindings);
}

OwnRhi::Pipeline OwnRhi::createLayouts(const nrd::PipelineDesc& desc) const
{
    std::vector<VkDescriptorSetLayoutBinding> bindings;
    const auto add = [&](uint32_t count, nrd::DescriptorType type)
    {
        for (uint32_t i = 0; i < count; i++)
            bindings.push_back(
                {static_cast<uint32_t>(bindings.size()), toVulkan(type), 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr});
    };
    add(desc.texturesNum, nrd::DescriptorType::TEXTURE);
    add(desc.storageTexturesNum, nrd::DescriptorType::STORAGE_TEXTURE);
    add(desc.storageBuffersNum, nrd::DescriptorType::STORAGE_BUFFER);
    Pipeline result;
    result.resources = makeSetLayout(bindings);
    VkDescriptorSetLayout sets[2];
    sets[m_desc.constantsAndSamplersSet] = m_constantsLayout.get();
    sets[m_desc.resourcesSet] = result.resources.get();
    auto layoutInfo = engine::describe<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
    layoutInfo.setLayoutCount = 2;
    layoutInfo.pSetLayouts = sets;
    result.layout = make<engine::UniquePipelineLayout>(m_device.handle(), vkCreatePipelineLayout, layoutInfo);
    return result;
}

void OwnRhi::createPipeline(const nrd::PipelineDesc& desc, const ShaderSource& source)
{
    Pipeline& result = m_pipelines.emplace_back(createLayouts(desc));
    const std::vector<uint32_t> words = source(desc);
    auto moduleInfo = engine::describe<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
    moduleInfo.codeSize = words.size() * sizeof(uint32_t);
    moduleInfo.pCode = words.data();
    const auto shader = make<engine::UniqueShaderModule>(m_device.handle(), vkCreateShaderModule, moduleInfo);
    std::vector<VkSpecializationMapEntry> entries;
    std::vector<uint32_t> values;
    for (uint32_t i = 0; i < desc.specializationConstantsNum; i++)
    {
        entries.push_back({desc.specializationConstants[i].id, static_cast<uint32_t>(i * sizeof(uint32_t)), 4});
        values.push_back(desc.specializationConstants[i].value);
    }
    const VkSpecializationInfo constants = {static_cast<uint32_t>(entries.size()), entries.data(),
                                            values.size() * sizeof(uint32_t), values.data()};
    auto info = engine::describe<VkComputePipelineCreateInfo>(VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO);
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.module = shader.get();
    info.stage.pName = m_desc.shaderEntryPoint;
    info.stage.pSpecializationInfo = &constants;
    info.layout = result.layout.get();
    VkPipeline pipeline = VK_NULL_HANDLE;
    engine::check(vkCreateComputePipelines(m_device.handle(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline),
                  desc.shaderIdentifier);
    result.pipeline = {m_device.handle(), pipeline};
}

void OwnRhi::createPools(uint16_t width, uint16_t height)
{
    const auto texture = [&](const nrd::TextureDesc& desc)
    {
        const uint32_t factor = desc.downsampleFactor;
        return engine::Image(m_device,
                             {"pool texture", engine::groupCount(width, factor), engine::groupCount(height, factor),
                              kFormats[static_cast<uint32_t>(desc.format)]});
    };
    for (uint32_t i = 0; i < m_desc.permanentPoolSize; i++) m_permanent.push_back(texture(m_desc.permanentPool[i]));
    for (uint32_t i = 0; i < m_desc.transientPoolSize; i++) m_transient.push_back(texture(m_desc.transientPool[i]));
    const uint32_t tiles = engine::groupCount(width, 16) * engine::groupCount(height, 16);
    for (uint32_t i = 0; i < m_desc.buffersNum; i++)
        m_buffers.push_back(engine::Buffer(
            m_device, {"pool buffer", m_desc.buffers[i].byteSizePerTile * tiles + m_desc.buffers[i].byteSize,
                       VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT}));
    const auto alignment = uint32_t(m_device.properties().limits.minUniformBufferOffsetAlignment);
    m_blockStride = engine::groupCount(std::max(m_desc.constantBufferMaxDataSize, 1u), alignment) * alignment;
    m_constants = engine::Buffer(m_device, {"constants", m_blockStride * m_desc.descriptorPoolDesc.setsMaxNum,
                                            VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, true});
}

void OwnRhi::createDescriptorPool()
{
    const nrd::DescriptorPoolDesc& totals = m_desc.descriptorPoolDesc;
    const VkDescriptorPoolSize sizes[] = {
        {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC, 1},
        {VK_DESCRIPTOR_TYPE_SAMPLER, std::max(m_desc.samplersNum, 1u)},
        {VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, std::max(totals.texturesMaxNum, 1u)},
        {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, std::max(totals.storageTexturesMaxNum, 1u)},
        {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, std::max(totals.storageBuffersMaxNum, 1u)}};
    auto info = engine::describe<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
    info.maxSets = totals.setsMaxNum + 1;
    info.poolSizeCount = static_cast<uint32_t>(std::size(sizes));
    info.pPoolSizes = sizes;
    m_descriptors = make<engine::UniqueDescriptorPool>(m_device.handle(), vkCreateDescriptorPool, info);
}

VkDescriptorSet OwnRhi::allocate(VkDescriptorSetLayout layout) const
{
    auto info = engine::describe<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO);
    info.descriptorPool = m_descriptors.get();
    info.descriptorSetCount = 1;
    info.pSetLayouts = &layout;
    VkDescriptorSet set = VK_NULL_HANDLE;
    engine::check(vkAllocateDescriptorSets(m_device.handle(), &info, &set), "allocate a descriptor set");
    return set;
}

VkDescriptorSet OwnRhi::writeConstants()
{
    const VkDescriptorBufferInfo buffer = {m_constants.handle(), 0, std::max(m_desc.constantBufferMaxDataSize, 1u)};
    auto write = engine::describe<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
    write.dstSet = allocate(m_constantsLayout.get());
    write.dstBinding = m_desc.constantBufferBinding;
    write.descriptorCount = 1;
    write.descriptorType = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC;
    write.pBufferInfo = &buffer;
    vkUpdateDescriptorSets(m_device.handle(), 1, &write, 0, nullptr);
    return write.dstSet;
}

VkDescriptorSet OwnRhi::writeResources(const nrd::DispatchDesc& dispatch,
                                       const std::map<nrd::ResourceType, engine::Image*>& userPool)
{
    const VkDescriptorSet set = allocate(m_pipelines[dispatch.pipelineIndex].resources.get());
    for (uint32_t i = 0; i < dispatch.resourcesNum; i++)
    {
        const nrd::ResourceDesc& resource = dispatch.resources[i];
        VkDescriptorImageInfo image = {VK_NULL_HANDLE, VK_NULL_HANDLE, VK_IMAGE_LAYOUT_GENERAL};
        VkDescriptorBufferInfo buffer = {VK_NULL_HANDLE, 0, VK_WHOLE_SIZE};
        if (resource.descriptorType == nrd::DescriptorType::STORAGE_BUFFER)
            buffer.buffer = m_buffers[resource.indexInPool].handle();
        else if (resource.type == nrd::ResourceType::PERMANENT_POOL)
            image.imageView = m_permanent[resource.indexInPool].view();
        else if (resource.type == nrd::ResourceType::TRANSIENT_POOL)
            image.imageView = m_transient[resource.indexInPool].view();
        else
            image.imageView = userPool.at(resource.type)->view();
        auto write = engine::describe<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
        write.dstSet = set;
        write.dstBinding = i; // bindings follow the order of the resources
        write.descriptorCount = 1;
        write.descriptorType = toVulkan(resource.descriptorType);
        write.pImageInfo = &image;
        write.pBufferInfo = &buffer;
        vkUpdateDescriptorSets(m_device.handle(), 1, &write, 0, nullptr);
    }
    return set;
}

void OwnRhi::record(VkCommandBuffer cmd, const nrd::DispatchDesc* dispatches, uint32_t dispatchNum,
                    const std::map<nrd::ResourceType, engine::Image*>& userPool)
{
    for (std::vector<engine::Image>* pool : {&m_permanent, &m_transient})
        for (engine::Image& image : *pool)
            if (image.state.layout != engine::kStorage.layout) engine::transition(cmd, image, engine::kStorage);
    engine::check(vkResetDescriptorPool(m_device.handle(), m_descriptors.get(), 0), "reset the descriptors");
    const VkDescriptorSet constants = writeConstants();
    for (uint32_t i = 0; i < dispatchNum; i++)
    {
        const nrd::DispatchDesc& dispatch = dispatches[i];
        const Pipeline& pipeline = m_pipelines[dispatch.pipelineIndex];
        const auto offset = static_cast<uint32_t>(m_blockStride * i);
        if (dispatch.constantBufferData)
            std::memcpy(m_constants.mapped().data() + offset, dispatch.constantBufferData,
                        dispatch.constantBufferDataSize);
        const VkDescriptorSet resources = writeResources(dispatch, userPool);
        const auto bind = [&](uint32_t index, VkDescriptorSet set, uint32_t offsetNum)
        {
            vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.layout.get(), index, 1, &set,
                                    offsetNum, &offset);
        };
        barrier(cmd);
        vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.pipeline.get());
        bind(m_desc.constantsAndSamplersSet, constants, 1);
        bind(m_desc.resourcesSet, resources, 0);
        if (dispatch.indirectBufferIndex == nrd::kNoBuffer)
            vkCmdDispatch(cmd, dispatch.gridWidth, dispatch.gridHeight, 1);
        else
            vkCmdDispatchIndirect(cmd, m_buffers[dispatch.indirectBufferIndex].handle(), dispatch.indirectBufferOffset);
    }
    barrier(cmd);
}
} // namespace example
