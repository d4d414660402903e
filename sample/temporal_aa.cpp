#include "temporal_aa.h"

#include "nrd_sample_shaders.h"
#include "pixel_pass.h"

namespace sample
{
namespace
{
// As in temporal_aa.comp.glsl; 128 bytes at most. Rows of clip x, y and w.
struct Constants
{
    std::array<glm::vec4, 3> viewToClipBefore;
    std::array<glm::vec4, 3> motionToClipBefore; // .w unused
    glm::vec2 tanHalfFov;
    glm::uvec2 size;
    uint32_t isCut;
};

constexpr int kClipRows[] = {0, 1, 3};

Constants constantsOf(const View& now, const View* before, const glm::uvec2& size)
{
    const Camera& camera = before ? before->camera : now.camera;
    const glm::mat4 worldToClip = camera.viewToClip * camera.worldToView;
    const glm::mat4 viewToClip = worldToClip * glm::inverse(now.camera.worldToView);
    Constants c = {};
    for (size_t i = 0; i < 3; ++i)
    {
        c.viewToClipBefore[i] = glm::transpose(viewToClip)[kClipRows[i]];
        c.motionToClipBefore[i] = glm::transpose(worldToClip)[kClipRows[i]];
    }
    c.tanHalfFov = {now.camera.tanHalfFovX, now.camera.tanHalfFovY};
    c.size = size;
    c.isCut = before == nullptr;
    return c;
}
} // namespace

TemporalAa::TemporalAa(const engine::Device& device, uint32_t width, uint32_t height)
    : m_pipeline(createPixelPipeline(device, shaderBlob(Shader::TemporalAa), 4, sizeof(Constants), 2))
{
    for (engine::Image& image : m_history)
        image = engine::Image(device, {"anti-aliased", width, height, VK_FORMAT_R32G32B32A32_SFLOAT});
}

void TemporalAa::record(VkCommandBuffer cmd, FrameImages& frame, engine::Image& composed, const View& now,
                        const View* before)
{
    engine::Image& history = m_history[m_current];
    m_current = 1 - m_current;
    std::vector<engine::Binding> bindings;
    for (engine::Image* in : {&composed, &history, &frame.viewZ, &frame.motion})
    {
        transition(cmd, *in, engine::kSampled);
        bindings.emplace_back(*in);
    }
    transition(cmd, result(), engine::kStorage);
    bindings.emplace_back(result());
    VkDescriptorSet& set = m_sets[m_current];
    if (!set) set = m_pipeline.createSet(bindings);
    const glm::uvec2 size(composed.desc().width, composed.desc().height);
    dispatchPixels(cmd, m_pipeline, set, constantsOf(now, before, size), size);
}
} // namespace sample
