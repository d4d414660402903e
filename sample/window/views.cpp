#include "window/views.h"

#include "shaders/view_modes.h"
#include "window/viewer.h"

#include <algorithm>

namespace sample
{
namespace
{
using engine::Image;

constexpr float kPerFrame = 1.0f / 64.0f; // the longest history is white

template <Image FrameImages::*Member> Image* traced(Viewer& viewer, size_t)
{
    return &(viewer.renderer().tracer().images().*Member);
}
template <Image FrameImages::*Member> Image* tracedShadow(Viewer& viewer, size_t side)
{
    return viewer.hasShadowSignal() ? traced<Member>(viewer, side) : nullptr;
}
template <Lobe kLobe> Image* denoisedLobe(Viewer& viewer, size_t side) { return viewer.side(side).denoised(kLobe); }
template <Lobe kLobe> Image* confidence(Viewer& viewer, size_t side) { return viewer.side(side).confidence(kLobe); }
Image* denoised(Viewer& viewer, size_t side) { return &viewer.side(side).shown(); }
Image* composed(Viewer& viewer, size_t side) { return &viewer.side(side).composed(); }
Image* denoisedShadow(Viewer& viewer, size_t side) { return viewer.side(side).denoisedShadow(); }
Image* noisy(Viewer& viewer, size_t) { return &viewer.noisy().composed(); }
Image* overlay(Viewer& viewer, size_t side)
{
    return hasOverlay(viewer.side(side).set().lobes->family) ? viewer.side(side).overlay() : nullptr;
}
Image* overlaid(Viewer& viewer, size_t side) { return overlay(viewer, side) ? composed(viewer, side) : nullptr; }
Image* reference(Viewer& viewer, size_t)
{
    return viewer.reference().sampleCount() > 0 ? &viewer.reference().composed() : nullptr;
}
Image* differing(Viewer& viewer, size_t side) { return reference(viewer, side) ? composed(viewer, side) : nullptr; }
Image* none(Viewer&, size_t) { return nullptr; }

// clang-format off
constexpr ViewRow kViews[] = {
    {"denoised",                     VIEW_LIGHT,      1.0f,      denoised,                                  none},
    {"noisy",                        VIEW_LIGHT,      1.0f,      noisy,                                     none},
    {"reference",                    VIEW_LIGHT,      1.0f,      reference,                                 none},
    {"difference from reference",    VIEW_DIFFERENCE, 4.0f,      differing,                                 reference},
    {"validation overlay",           VIEW_OVERLAY,    1.0f,      overlaid,                                  overlay},
    {"denoised diffuse",             VIEW_LIGHT,      1.0f,      denoisedLobe<Lobe::Diffuse>,               none},
    {"denoised specular",            VIEW_LIGHT,      1.0f,      denoisedLobe<Lobe::Specular>,              none},
    {"denoised diffuse hit distance", VIEW_W,         1.0f,      denoisedLobe<Lobe::Diffuse>,               none},
    {"denoised specular hit distance", VIEW_W,         1.0f,      denoisedLobe<Lobe::Specular>,              none},
    {"diffuse history length",       VIEW_W,          kPerFrame, denoisedLobe<Lobe::Diffuse>,               none, true},
    {"specular history length",      VIEW_W,          kPerFrame, denoisedLobe<Lobe::Specular>,              none, true},
    {"diffuse confidence",           VIEW_X,          1.0f,      confidence<Lobe::Diffuse>,                 none},
    {"specular confidence",          VIEW_X,          1.0f,      confidence<Lobe::Specular>,                none},
    {"denoised shadow",              VIEW_W,          1.0f,      denoisedShadow,                            none},
    {"denoised translucency",        VIEW_VALUE,      1.0f,      denoisedShadow,                            none},
    {"viewZ",                        VIEW_DEPTH,      0.3f,      traced<&FrameImages::viewZ>,               none},
    {"normal",                       VIEW_SIGNED,     1.0f,      traced<&FrameImages::normalRoughness>,     none},
    {"roughness",                    VIEW_W,          1.0f,      traced<&FrameImages::normalRoughness>,     none},
    {"motion",                       VIEW_MOTION,     20.0f,     traced<&FrameImages::motion>,              none},
    {"material",                     VIEW_ID,         1.0f,      traced<&FrameImages::motion>,              none},
    {"diffuse",                      VIEW_LIGHT,      1.0f,      traced<&FrameImages::diffuse>,             none},
    {"specular",                     VIEW_LIGHT,      1.0f,      traced<&FrameImages::specular>,            none},
    {"diffuse hit distance",         VIEW_W,          0.2f,      traced<&FrameImages::diffuse>,             none},
    {"specular hit distance",        VIEW_W,          0.2f,      traced<&FrameImages::specular>,            none},
    {"diffuse direction",            VIEW_SIGNED,     1.0f,      traced<&FrameImages::diffuseDirection>,    none},
    {"specular direction",           VIEW_SIGNED,     1.0f,      traced<&FrameImages::specularDirection>,   none},
    {"diffuse factor",               VIEW_VALUE,      1.0f,      traced<&FrameImages::diffuseFactor>,       none},
    {"specular factor",              VIEW_VALUE,      1.0f,      traced<&FrameImages::specularFactor>,      none},
    {"specular motion",              VIEW_MOTION,     20.0f,     traced<&FrameImages::specularMotion>,      none},
    {"direct light",                 VIEW_LIGHT,      1.0f,      traced<&FrameImages::direct>,              none},
    {"shadow distance",              VIEW_W,          0.1f,      tracedShadow<&FrameImages::shadow>,        none},
    {"translucency",                 VIEW_VALUE,      1.0f,      tracedShadow<&FrameImages::shadow>,        none},
    {"unshadowed sun",               VIEW_LIGHT,      1.0f,      tracedShadow<&FrameImages::sun>,           none},
};
// clang-format on
} // namespace

std::span<const ViewRow> views() { return kViews; }

size_t findView(std::string_view name)
{
    for (size_t i = 0; i < std::size(kViews); ++i)
        if (name == kViews[i].name) return i;
    throw SettingError("there is no view '" + std::string(name) + "'; print views lists them");
}

engine::Image* Viewer::viewedImage() { return views()[state.view].image(*this, 0); }

void Viewer::recordPicture(VkCommandBuffer cmd, uint32_t slot)
{
    const ViewRow& view = views()[state.view];
    const size_t right = state.isCompared ? 1 : 0;
    DisplayConstants constants;
    constants.mode = view.mode;
    constants.tone = state.tone;
    constants.exposure = std::exp2(state.exposure);
    constants.range = view.range * state.range;
    if (state.picked) constants.picked = *state.picked;
    if (state.isCompared) constants.split = int32_t(std::lround(state.split * float(m_options.width)));
    m_display->record(cmd, slot,
                      {view.image(*this, 0), view.image(*this, right), view.over(*this, 0), view.over(*this, right)},
                      constants);
}
} // namespace sample
