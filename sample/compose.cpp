#include "compose.h"

#include "nrd_sample_shaders.h"

namespace sample
{
ComposePass::ComposePass(const engine::Device& device)
    : m_pipeline(createPixelPipeline(device, shaderBlob(Shader::Compose), 7, sizeof(ComposeConstants)))
{
}

void ComposePass::record(VkCommandBuffer cmd, FrameImages& frame, const ComposeSignals& signals, engine::Image& target,
                         const ComposeConstants& constants)
{
    std::vector<engine::Binding> bindings;
    for (engine::Image* in : {signals.diffuse, signals.specular, &frame.diffuseFactor, &frame.specularFactor,
                              &frame.direct, &frame.sun, signals.shadow})
    {
        transition(cmd, *in, engine::kSampled);
        bindings.emplace_back(*in);
    }
    transition(cmd, target, engine::kStorage);
    bindings.emplace_back(target);
    if (!m_set) m_set = m_pipeline.createSet(bindings);
    dispatchPixels(cmd, m_pipeline, m_set, constants, constants.size);
}
} // namespace sample
