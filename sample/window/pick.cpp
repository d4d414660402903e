// What is known of one pixel, read back for the panel.
#include "engine/transfer.h"
#include "window/viewer.h"
#include "window/views.h"

namespace sample
{
namespace
{
// The history length in .w, where the denoiser was asked to leave it there, or always does.
bool tellsHistory(const DenoiserSet& set, Lobe lobe)
{
    return set.lobes->hasRadiance(lobe) && (set.lobes->family == Family::Reblur || set.lobes->family == Family::Relax);
}
} // namespace

PickedPixel Viewer::readPicked()
{
    PickedPixel out;
    out.pixel = state.picked.value_or(glm::ivec2(0));
    FrameImages& in = m_renderer->tracer().images();
    DenoiseStage& a = side(0);
    std::vector<engine::Image*> images = {&in.viewZ, &in.normalRoughness, &in.motion, &noisy().composed(),
                                          &a.composed()};
    for (Lobe lobe : kLobes)
        if (tellsHistory(a.set(), lobe)) images.push_back(a.denoised(lobe));
    const auto texels = engine::readTexels(m_device, images, uint32_t(out.pixel.x), uint32_t(out.pixel.y));
    const auto vector = [&](size_t i) { return glm::vec4(texels[i][0], texels[i][1], texels[i][2], texels[i][3]); };
    out.viewZ = texels[0][0];
    out.normalRoughness = vector(1);
    out.motionMaterial = vector(2);
    out.noisy = vector(3);
    out.denoised = vector(4);
    size_t next = 5;
    for (Lobe lobe : kLobes)
        if (tellsHistory(a.set(), lobe)) out.historyLength[size_t(lobe)] = texels[next++][3];
    return out;
}
} // namespace sample
