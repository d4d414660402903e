#include "window/viewer_state.h"

#include <algorithm>
#include <map>

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
    std::vector<Family> owners;
    for (Family family : set.families())
        for (SettingField& field : settingFields(settings, family))
        {
            const auto isSame = [&](const SettingField& other) { return other.target == field.target; };
            if (!field.group || std::any_of(all.begin(), all.end(), isSame)) continue; // the common ones come again
            all.push_back(std::move(field));
            owners.push_back(family);
        }
    std::map<std::string, int> counts;
    for (const SettingField& field : all) ++counts[field.name];
    for (size_t i = 0; i < all.size(); ++i)
        if (counts[all[i].name] > 1) all[i].name = qualified(owners[i], all[i].name);
    return all;
}
} // namespace sample
