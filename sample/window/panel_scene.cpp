#include "window/panel.h"

#include <imgui.h>

namespace sample
{
namespace
{
constexpr const char* kCameraModes[] = {"the scene's", "fly", "orbit"};
constexpr const char* kPathCounts[] = {"two: one per lobe", "one: probabilistic", "one: merged"};
constexpr const char* kCheckerboards[] = {"off", "black", "white"};
} // namespace

void drawScenePart(Viewer& viewer, Wishes& wishes)
{
    if (!ImGui::CollapsingHeader("Scene")) return;
    ViewerState& state = viewer.state;
    if (ImGui::BeginCombo("scene", viewer.scene().name.c_str()))
    {
        for (const BuiltInScene& row : builtInScenes())
            if (ImGui::Selectable(row.name)) wishes.scene = row.name;
        ImGui::TextDisabled("or drop .gltf, .glb, .hdr, .exr");
        ImGui::EndCombo();
    }
    ImGui::SliderFloat("rendered scale", &wishes.renderScale, 0.1f, 2.0f, "%.2f", ImGuiSliderFlags_AlwaysClamp);
    int mode = int(state.cameraMode);
    if (ImGui::Combo("camera", &mode, kCameraModes, int(std::size(kCameraModes)))) viewer.startCamera(CameraMode(mode));
    if (viewer.isAnimated()) ImGui::SliderFloat("animation speed", &state.animationSpeed, 0.0f, 4.0f);
    if (viewer.hasSun())
    {
        ImGui::SliderFloat("sun azimuth", &state.sun.azimuth, -180.0f, 180.0f, "%.0f deg");
        ImGui::SliderFloat("sun elevation", &state.sun.elevation, 0.0f, 90.0f, "%.0f deg");
    }
    if (viewer.hasEnvironment())
        ImGui::SliderFloat("environment rotation", &state.environmentTurn, -180.0f, 180.0f, "%.0f deg");
}

void drawTracingPart(Viewer& viewer)
{
    ViewerState& state = viewer.state;
    if (!ImGui::CollapsingHeader("Path tracing")) return;
    int bounces = int(state.bounces), lobes = int(state.lobes), checkerboard = int(state.checkerboard);
    if (ImGui::SliderInt("bounces", &bounces, 1, 16)) state.bounces = uint32_t(bounces);
    if (ImGui::Combo("paths per pixel", &lobes, kPathCounts, int(std::size(kPathCounts)))) state.lobes = Lobes(lobes);
    if (state.lobes == Lobes::Both &&
        ImGui::Combo("checkerboard", &checkerboard, kCheckerboards, int(std::size(kCheckerboards))))
        state.checkerboard = nrd::CheckerboardMode(checkerboard);
    ImGui::SliderFloat("roughening", &state.roughening, 0.0f, 1.0f);
    ImGui::Checkbox("jitter", &state.hasJitter);
    ImGui::Checkbox("temporal anti-aliasing", &state.hasTemporalAa);
    ImGui::Checkbox("follow mirrors (PSR)", &state.hasPsr);
    ImGui::Checkbox("history confidence by re-traced samples", &state.hasConfidence);
}
} // namespace sample
