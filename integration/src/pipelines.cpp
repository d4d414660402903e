#include "pipelines.h"
#include "convert.h"
#include "refusal.h"

namespace nrd
{
namespace
{
std::vector<rhi::BindingDesc> bindingsOf(const InstanceDesc& instance, const PipelineDesc& pipeline)
{
    std::vector<rhi::BindingDesc> result;
    if (pipeline.hasConstantData)
    {
        result.push_back(
            {instance.constantsAndSamplersSet, instance.constantBufferBinding, rhi::BindingType::UniformBufferDynamic});
        for (uint32_t i = 0; i < instance.samplersNum; i++)
            result.push_back({instance.constantsAndSamplersSet, instance.samplersBaseBinding + i,
                              rhi::BindingType::Sampler, toRhi(instance.samplers[i])});
    }
    uint32_t binding = 0;
    const auto add = [&](uint32_t count, rhi::BindingType type)
    {
        for (uint32_t i = 0; i < count; i++) result.push_back({instance.resourcesSet, binding++, type});
    };
    add(pipeline.texturesNum, rhi::BindingType::SampledTexture);
    add(pipeline.storageTexturesNum, rhi::BindingType::StorageTexture);
    add(pipeline.storageBuffersNum, rhi::BindingType::StorageBuffer);
    return result;
}
} // namespace

Pipelines::Pipelines(rhi::Device& device, const char* name, uint32_t pipelineCount, const Replacement& replacement)
    : m_device(device), m_name(name), m_replacement(replacement), m_pipelines(pipelineCount)
{
}

const rhi::Pipeline& Pipelines::get(const InstanceDesc& instance, uint32_t index)
{
    std::unique_ptr<rhi::Pipeline>& pipeline = m_pipelines[index];
    if (pipeline) return *pipeline;
    const PipelineDesc& source = instance.pipelines[index];
    const std::vector<rhi::BindingDesc> bindings = bindingsOf(instance, source);
    std::vector<rhi::SpecConstant> constants;
    for (uint32_t i = 0; i < source.specializationConstantsNum; i++)
        constants.push_back({source.specializationConstants[i].id, source.specializationConstants[i].value});
    const std::string name = sentence("%s %s", m_name.c_str(), source.shaderIdentifier);
    rhi::PipelineDesc desc;
    SPIRV module = source.computeShaderSPIRV;
    const SPIRV other =
        m_replacement.find ? m_replacement.find(m_replacement.userArg, source.shaderIdentifier) : SPIRV{};
    if (other.words) module = other;
    desc.spirv = {module.words, module.byteSize / sizeof(uint32_t)};
    desc.bindings = bindings;
    desc.constants = constants;
    desc.name = name.c_str();
    pipeline = m_device.createPipeline(desc);
    m_createdCount++;
    return *pipeline;
}
} // namespace nrd
