#include "denoiser_set.h"

#include <algorithm>

namespace sample
{
namespace
{
std::vector<std::string> split(const std::string& text, char separator)
{
    std::vector<std::string> parts;
    for (size_t begin = 0;;)
    {
        const size_t end = std::min(text.find(separator, begin), text.size());
        parts.push_back(text.substr(begin, end - begin));
        if (end == text.size()) return parts;
        begin = end + 1;
    }
}

const SampleDenoiser& denoiserNamed(const std::string& name)
{
    if (const SampleDenoiser* row = findSampleDenoiser(name)) return *row;
    std::string text = "--denoiser: '" + name + "' is not auto or one of";
    for (const SampleDenoiser& row : sampleDenoisers()) text += std::string(" ") + row.name;
    throw SettingError(text);
}

DenoiserSet parseSet(const std::string& text)
{
    DenoiserSet set;
    for (const std::string& name : split(text, '+'))
    {
        const SampleDenoiser& row = denoiserNamed(name);
        const SampleDenoiser*& place = row.isOfShadow() ? set.shadow : set.lobes;
        if (place)
            throw SettingError(std::string("--denoiser: ") + place->name + " and " + row.name +
                               " would denoise the same picture; a comma between them compares them");
        place = &row;
    }
    if (!set.lobes) set.lobes = findSampleDenoiser("NONE");
    return set;
}

constexpr std::pair<Family, const char*> kFamilyNames[] = {
    {Family::Reblur, "REBLUR"}, {Family::Relax, "RELAX"}, {Family::Sigma, "SIGMA"}, {Family::Reference, "REFERENCE"}};

// The field of the family that the key reaches, "SIGMA.x" only SIGMA's; empty: it is for another family.
std::string fieldOf(Family family, const std::string& key)
{
    for (const auto& [owner, name] : kFamilyNames)
        if (key.rfind(std::string(name) + ".", 0) == 0)
            return owner == family ? key.substr(std::string(name).size() + 1) : std::string();
    return key;
}

bool hasSetting(Family family, const std::string& key)
{
    ReplaySettings settings;
    const std::vector<SettingField> fields = settingFields(settings, family);
    const std::string name = fieldOf(family, key);
    return std::any_of(fields.begin(), fields.end(), [&](const SettingField& field) { return field.name == name; });
}

void addOnce(std::vector<Family>& families, Family family)
{
    if (std::find(families.begin(), families.end(), family) == families.end()) families.push_back(family);
}
} // namespace

std::string DenoiserSet::name() const
{
    if (!shadow) return lobes->name;
    return (lobes->family == Family::None ? std::string() : std::string(lobes->name) + "+") + shadow->name;
}

bool DenoiserSet::composesLight() const
{
    const bool isOcclusion = lobes->hasOcclusionOnly(Lobe::Diffuse) || lobes->hasOcclusionOnly(Lobe::Specular);
    return !isOcclusion && (shadow || lobes->composesLight());
}

std::vector<Family> DenoiserSet::families() const
{
    std::vector<Family> all = {lobes->family};
    if (shadow) addOnce(all, shadow->family);
    if (lobes->family == Family::Reblur || lobes->family == Family::Relax) addOnce(all, Family::Confidence);
    return all;
}

std::string qualified(Family family, const std::string& name)
{
    for (const auto& [owner, prefix] : kFamilyNames)
        if (owner == family) return std::string(prefix) + "." + name;
    return name;
}

std::vector<DenoiserSet> parseDenoiserSets(const std::string& text)
{
    std::vector<DenoiserSet> sets;
    for (const std::string& part : split(text, ','))
    {
        const DenoiserSet set = parseSet(part);
        for (const DenoiserSet& other : sets)
            if (other.name() == set.name()) throw SettingError("--denoiser: " + set.name() + " is there twice");
        sets.push_back(set);
    }
    return sets;
}

std::vector<Family> familiesOf(const std::vector<DenoiserSet>& sets)
{
    std::vector<Family> all;
    for (const DenoiserSet& set : sets)
        for (Family family : set.families()) addOnce(all, family);
    return all;
}

bool hasSetting(const std::vector<Family>& families, const std::string& key)
{
    return std::any_of(families.begin(), families.end(), [&](Family family) { return hasSetting(family, key); });
}

bool isCommonSetting(const std::string& key) { return hasSetting(Family::None, key); }

void checkRanges(ReplaySettings& settings, const std::vector<Family>& families, const std::string& key)
{
    for (Family family : families)
        for (const SettingField& field : settingFields(settings, family))
            if (field.name == fieldOf(family, key) && !isInRange(field))
                throw SettingError("--set " + key + "=" + valueText(field) + ": expected " + rangeText(field.range));
}

void applySettings(ReplaySettings& settings, const std::vector<Family>& families,
                   const std::vector<Assignment>& assignments)
{
    for (const Assignment& assignment : assignments)
    {
        std::vector<Family> knowing;
        std::copy_if(families.begin(), families.end(), std::back_inserter(knowing),
                     [&](Family family) { return hasSetting(family, assignment.first); });
        if (knowing.empty()) applySettings(settings, families.front(), {assignment}); // which says so
        for (Family family : knowing)
            applySettings(settings, family, {{fieldOf(family, assignment.first), assignment.second}});
    }
}
} // namespace sample
