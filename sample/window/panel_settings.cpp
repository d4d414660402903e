// Widgets for every setting of a denoiser, made from the table of fields.
#include "window/panel.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <imgui.h>

namespace sample
{
namespace
{
constexpr double kWide = 1000.0; // ranges that span more are on a logarithmic scale

// What a slider's lower end is where the bound itself is excluded.
double lowerEnd(const SettingRange& range)
{
    if (!range.isLowExcluded) return range.low;
    return range.low + (std::isinf(range.high) ? 1e-6 : 1e-4 * (range.high - range.low));
}

template <class T> bool editNumber(const char* label, T& value, const SettingRange& range, ImGuiDataType type)
{
    const T low = static_cast<T>(lowerEnd(range));
    if (std::isinf(range.high)) return ImGui::DragScalar(label, type, &value, 0.01f * float(value) + 0.001f, &low);
    const T high = static_cast<T>(range.high);
    const bool isWide = range.high - range.low > kWide;
    return ImGui::SliderScalar(label, type, &value, &low, &high, nullptr,
                               ImGuiSliderFlags_AlwaysClamp | (isWide ? ImGuiSliderFlags_Logarithmic : 0));
}

bool editMode(const char* label, const SettingTarget& target)
{
    const auto names = modeNames(target);
    const auto edit = [&](auto* value)
    {
        using T = std::remove_pointer_t<decltype(value)>;
        int index = 0;
        if constexpr (std::is_enum_v<T>) index = int(*value);
        if (!ImGui::Combo(label, &index, names.data(), int(names.size()))) return false;
        if constexpr (std::is_enum_v<T>) *value = static_cast<T>(index);
        return true;
    };
    return std::visit(edit, target);
}

bool edit(const SettingField& field)
{
    const char* label = field.name.c_str();
    if (bool* const* flag = std::get_if<bool*>(&field.target)) return ImGui::Checkbox(label, *flag);
    if (float* const* real = std::get_if<float*>(&field.target))
        return editNumber(label, **real, field.range, ImGuiDataType_Float);
    if (uint32_t* const* count = std::get_if<uint32_t*>(&field.target))
        return editNumber(label, **count, field.range, ImGuiDataType_U32);
    return editMode(label, field.target);
}

void drawField(Side& side, const SettingField& field, const std::string& defaultText)
{
    ImGui::PushID(field.name.c_str());
    const bool isOwn = std::any_of(side.settings.begin(), side.settings.end(),
                                   [&](const Assignment& a) { return a.first == field.name; });
    if (ImGui::SmallButton(isOwn ? "x" : " ") && isOwn)
        unassign(side.settings, field.name);
    else
    {
        ImGui::SameLine();
        if (edit(field)) assign(side.settings, {field.name, valueText(field)});
    }
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("%s\ndefault %s%s%s", field.name.c_str(), defaultText.c_str(),
                          field.hasRange() ? ", range " : "", field.hasRange() ? rangeText(field.range).c_str() : "");
    ImGui::PopID();
}

void drawSide(Viewer& viewer, Side& side)
{
    ReplaySettings now = viewer.settingsOf(side), defaults = viewer.settingsOf(side, true);
    const std::vector<SettingField> fields = panelFields(now, side.set);
    const std::vector<SettingField> untouched = panelFields(defaults, side.set);
    if (ImGui::Button("All to defaults")) side.settings.clear();
    const char* group = nullptr;
    bool isOpen = false;
    for (size_t i = 0; i < fields.size(); ++i)
    {
        if (!group || std::strcmp(group, fields[i].group) != 0)
        {
            if (isOpen) ImGui::TreePop();
            group = fields[i].group;
            ImGui::PushID(int(i)); // families may share a heading
            isOpen = ImGui::TreeNode(group);
            ImGui::PopID();
        }
        if (isOpen) drawField(side, fields[i], valueText(untouched[i]));
    }
    if (isOpen) ImGui::TreePop();
}
} // namespace

void drawSettingsPart(Viewer& viewer)
{
    ViewerState& state = viewer.state;
    constexpr const char* kHeadings[] = {"Settings of A", "Settings of B"};
    for (size_t i = 0; i < (state.isCompared ? 2u : 1u); ++i)
    {
        if (state.sides[i].set.isNone() || !ImGui::CollapsingHeader(kHeadings[i])) continue;
        ImGui::PushID(kHeadings[i]);
        drawSide(viewer, state.sides[i]);
        ImGui::PopID();
    }
}
} // namespace sample
