#pragma once
#include "layouts.h"

namespace rhi::vulkan
{
class Pipeline final : public rhi::Pipeline
{
public:
    Pipeline(const Context& context, const PipelineLayout& layout, const PipelineDesc& desc);
    uint64_t nativeHandle() const override { return rhi::detail::toHandle(m_pipeline.get()); }
    VkPipeline pipeline() const { return m_pipeline.get(); }
    const PipelineLayout& layout() const { return m_layout; }

private:
    const PipelineLayout& m_layout;
    UniquePipeline m_pipeline;
};
} // namespace rhi::vulkan
