#include "window/viewer_state.h"

#include <algorithm>

namespace sample
{
void assign(std::vector<Assignment>& settings, const Assignment& assignment)
{
    unassign(settings, assignment.first);
    settings.push_back(assignment);
}

void unassign(std::vector<Assignment>& settings, const std::string& key)
{
    std::erase_if(settings, [&](const Assignment& a) { return a.first == key; });
}

std::vector<SettingField> panelFields(ReplaySettings& settings, const DenoiserSet& set)
{
    std::vector<SettingField> all;
    for (Family family : set.families())
        for (SettingField& field : settingFields(settings, family))
        {
            const auto isSame = [&](const SettingField& other) { return other.name == field.name; };
            if (field.group && std::none_of(all.begin(), all.end(), isSame)) all.push_back(std::move(field));
        }
    return all;
}
} // namespace sample
