// Compute pipelines with one descriptor set, and the sets themselves.
#pragma once
#include "engine/resources.h"

namespace engine
{
struct ComputeDesc
{
    std::string name;
    const uint32_t* words = nullptr; // SPIR-V
    size_t byteSize = 0;
    std::vector<VkDescriptorType> bindings; // element i is binding i of set 0
    uint32_t pushConstantByteSize = 0;      // [0; 128], multiple of 4
    uint32_t setCount = 1;                  // descriptor sets the pipeline can hand out
    std::vector<uint32_t> specialization;   // element i is the 32-bit constant with id i
};

/// What a binding is given; the field that counts follows from the binding's type.
struct Binding
{
    Binding(const Image& image, VkSampler imageSampler = VK_NULL_HANDLE) : view(image.view()), sampler(imageSampler) {}
    Binding(const Buffer& source) : buffer(source.handle()), texelView(source.texelView()) {}
    VkImageView view = VK_NULL_HANDLE;
    VkSampler sampler = VK_NULL_HANDLE;
    VkBuffer buffer = VK_NULL_HANDLE;
    VkBufferView texelView = VK_NULL_HANDLE;
};

class ComputePipeline
{
public:
    ComputePipeline() = default;
    ComputePipeline(const Device& device, const ComputeDesc& desc);

    /// A new set with all bindings written; at most ComputeDesc::setCount of them, freed with the pipeline.
    /// Throws Error when the number of bindings is not the pipeline's.
    VkDescriptorSet createSet(const std::vector<Binding>& bindings) const;

    /// Writes all bindings of a set that no pending frame uses.
    void writeSet(VkDescriptorSet set, const std::vector<Binding>& bindings) const;

    /// Binds pipeline, set and push constants, and dispatches `groups`.
    void dispatch(VkCommandBuffer cmd, VkDescriptorSet set, std::span<const std::byte> pushConstants,
                  VkExtent3D groups) const;

private:
    ComputeDesc m_desc;
    UniqueSetLayout m_setLayout;
    UniquePipelineLayout m_layout;
    UniquePipeline m_pipeline;
    UniqueDescriptorPool m_pool;
};

/// One level, normalised coordinates. `filter` is VK_FILTER_NEAREST or VK_FILTER_LINEAR.
UniqueSampler createSampler(const Device& device, VkFilter filter, VkSamplerAddressMode addressMode);

/// Groups of `groupSize` that cover `size`.
constexpr uint32_t groupCount(uint32_t size, uint32_t groupSize) { return (size + groupSize - 1) / groupSize; }
} // namespace engine
