#include "pipeline.h"

namespace rhi::vulkan
{
namespace
{
UniqueShaderModule createModule(const Context& context, const PipelineDesc& desc)
{
    auto info = vkStruct<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
    info.codeSize = desc.spirv.size() * sizeof(uint32_t);
    info.pCode = desc.spirv.data();
    VkShaderModule module = VK_NULL_HANDLE;
    check(context.fn.createShaderModule(context.device, &info, context.callbacks, &module), "shader of pipeline",
          desc.name);
    return UniqueShaderModule(context, module);
}
} // namespace

Pipeline::Pipeline(const Context& context, const PipelineLayout& layout, const PipelineDesc& desc)
    : rhi::Pipeline(desc.name), m_layout(layout)
{
    const UniqueShaderModule module = createModule(context, desc);
    std::vector<VkSpecializationMapEntry> entries;
    std::vector<uint32_t> values;
    for (const SpecConstant& constant : desc.constants)
    {
        entries.push_back({constant.id, static_cast<uint32_t>(values.size() * sizeof(uint32_t)), sizeof(uint32_t)});
        values.push_back(constant.value);
    }
    const VkSpecializationInfo specialization = {static_cast<uint32_t>(entries.size()), entries.data(),
                                                 values.size() * sizeof(uint32_t), values.data()};
    auto info = vkStruct<VkComputePipelineCreateInfo>(VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO);
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.module = module.get();
    info.stage.pName = "main";
    info.stage.pSpecializationInfo = entries.empty() ? nullptr : &specialization;
    info.layout = layout.owner.get();
    VkPipeline pipeline = VK_NULL_HANDLE;
    check(context.fn.createComputePipelines(context.device, context.pipelineCache, 1, &info, context.callbacks,
                                            &pipeline),
          "pipeline", name());
    m_pipeline = UniquePipeline(context, pipeline);
    context.setName(VK_OBJECT_TYPE_PIPELINE, pipeline, name());
}
} // namespace rhi::vulkan
