#include "window/live_reference.h"

#include "engine/transfer.h"
#include "measures.h"

namespace sample
{
namespace
{
Picture readPicture(const engine::Device& device, engine::Image& image)
{
    const std::vector<float> rgba = engine::readBackAs<float>(device, image);
    Picture picture(int(image.desc().width), int(image.desc().height), 3);
    for (size_t i = 0; i < picture.pixelCount(); ++i)
        for (size_t c = 0; c < 3; ++c) picture.planes[c][i] = rgba[i * 4 + c];
    return picture;
}
} // namespace

LiveReference::LiveReference(const engine::Device& device, uint32_t width, uint32_t height)
    : m_composed(device, {"reference", width, height}), m_compose(device)
{
}

void LiveReference::record(VkCommandBuffer cmd, PathTracer& tracer, const View& view, uint32_t samples)
{
    tracer.recordReference(cmd, view, {m_count, samples});
    m_count += samples;
    ComposeConstants constants;
    constants.size = {m_composed.desc().width, m_composed.desc().height};
    constants.hasShadow = tracer.desc().hasShadowSignal;
    constants.signalScale = 1.0f / float(m_count);
    m_compose.record(cmd, tracer.images(), {&tracer.sumDiffuse(), &tracer.sumSpecular(), &tracer.sumShadow()},
                     m_composed, constants);
}

double measurePsnr(const engine::Device& device, engine::Image& result, engine::Image& reference)
{
    return psnr(toneMapped(readPicture(device, result)), toneMapped(readPicture(device, reference)), {});
}
} // namespace sample
