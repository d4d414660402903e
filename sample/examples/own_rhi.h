// The descriptor library executed by an application's own Vulkan code: nothing of `rhi` or of NrdIntegration. The
// namespace `engine` stands for yours: its device, its images and buffers with their memory.
//
// The simplest way that is right: all images stay in the general layout, one memory barrier stands between dispatches,
// and a frame's descriptors and constants are used again when the device is done with the frame.
#pragma once
#include "engine/resources.h"
#include <functional>
#include <map>
#include <nrd/nrd.h>

namespace example
{
/// SPIR-V of a pipeline; by default what the library has embedded.
using ShaderSource = std::function<std::vector<uint32_t>(const nrd::PipelineDesc&)>;
inline std::vector<uint32_t> embeddedShader(const nrd::PipelineDesc& pipeline)
{
    const nrd::SPIRV& spirv = pipeline.computeShaderSPIRV;
    return {spirv.words, spirv.words + spirv.byteSize / sizeof(uint32_t)};
}

class OwnRhi
{
public:
    /// Pipelines, and textures and buffers of the size.
    OwnRhi(const engine::Device& device, const nrd::InstanceDesc& desc, uint16_t width, uint16_t height,
           const ShaderSource& source = embeddedShader);

    /// Records the dispatches. `userPool` has the images of the application, in the general layout.
    void record(VkCommandBuffer cmd, const nrd::DispatchDesc* dispatches, uint32_t dispatchNum,
                const std::map<nrd::ResourceType, engine::Image*>& userPool);

private:
    struct Pipeline
    {
        engine::UniqueSetLayout resources;
        engine::UniquePipelineLayout layout;
        engine::UniquePipeline pipeline;
    };

    engine::UniqueSetLayout makeSetLayout(const std::vector<VkDescriptorSetLayoutBinding>& bindings) const;
    void createConstantsLayout();
    Pipeline createLayouts(const nrd::PipelineDesc& desc) const;
    void createPipeline(const nrd::PipelineDesc& desc, const ShaderSource& source);
    void createPools(uint16_t width, uint16_t height);
    void createDescriptorPool();
    VkDescriptorSet allocate(VkDescriptorSetLayout layout) const;
    VkDescriptorSet writeConstants();
    VkDescriptorSet writeResources(const nrd::DispatchDesc& dispatch,
                                   const std::map<nrd::ResourceType, engine::Image*>& userPool);

    const engine::Device& m_device;
    const nrd::InstanceDesc& m_desc;
    std::vector<engine::UniqueSampler> m_samplers;
    engine::UniqueSetLayout m_constantsLayout;
    std::vector<Pipeline> m_pipelines;
    std::vector<engine::Image> m_permanent, m_transient;
    std::vector<engine::Buffer> m_buffers;
    engine::Buffer m_constants;     // one block for each dispatch of a frame
    VkDeviceSize m_blockStride = 0; // bytes
    engine::UniqueDescriptorPool m_descriptors;
};
} // namespace example
