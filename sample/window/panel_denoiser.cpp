#include "window/panel.h"

#include <imgui.h>

namespace sample
{
namespace
{
// True when another row was chosen. The first row is none.
bool choose(const char* label, const SampleDenoiser*& chosen, bool isOfShadow)
{
    const SampleDenoiser* const before = chosen;
    if (!ImGui::BeginCombo(label, chosen ? chosen->name : "NONE")) return false;
    if (isOfShadow && ImGui::Selectable("NONE", !chosen)) chosen = nullptr;
    for (const SampleDenoiser& row : sampleDenoisers())
        if (row.isOfShadow() == isOfShadow && ImGui::Selectable(row.name, chosen == &row)) chosen = &row;
    ImGui::EndCombo();
    return chosen != before;
}

constexpr const char* kResolutions[] = {"off", "means of all paths", "sparse tracing"};

void chooseResolution(Resolution& resolution)
{
    int chosen = resolution.divisor == 1 ? 0 : resolution.isSparse ? 2 : 1;
    if (!ImGui::Combo("half resolution", &chosen, kResolutions, int(std::size(kResolutions)))) return;
    resolution = {chosen == 0 ? 1u : 2u, chosen == 2};
}

void drawSide(Viewer& viewer, size_t index, const char* name)
{
    Side& side = viewer.state.sides[index];
    ImGui::PushID(name);
    ImGui::TextDisabled("%s", name);
    choose("lobes", side.set.lobes, false);
    if (hasShadowLight(viewer.scene())) choose("shadow", side.set.shadow, true);
    if (!side.set.isNone()) chooseResolution(side.resolution);
    ImGui::PopID();
}
} // namespace

void drawDenoiserPart(Viewer& viewer)
{
    if (!ImGui::CollapsingHeader("Denoiser", ImGuiTreeNodeFlags_DefaultOpen)) return;
    ViewerState& state = viewer.state;
    drawSide(viewer, 0, state.isCompared ? "A, left" : "A");
    ImGui::Checkbox("compare with B", &state.isCompared);
    if (!state.isCompared) return;
    drawSide(viewer, 1, "B, right");
    ImGui::SliderFloat("split", &state.split, 0.0f, 1.0f);
    if (ImGui::SmallButton("Copy A to B")) state.sides[1] = state.sides[0];
    ImGui::SameLine();
    if (ImGui::SmallButton("Swap")) std::swap(state.sides[0], state.sides[1]);
}
} // namespace sample
