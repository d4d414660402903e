// The slots that a RELAX denoiser reads and writes, by its name: what each program's table has to have a row for.
#pragma once
#include <nrd/types.h>

#include <string_view>
#include <vector>

// Of the lobes, without the guides.
inline std::vector<nrd::ResourceType> relaxLobeSlots(std::string_view name)
{
    using nrd::ResourceType;
    const auto has = [name](std::string_view part) { return name.find(part) != std::string_view::npos; };
    std::vector<ResourceType> slots;
    const auto add = [&](bool isThere, std::vector<ResourceType> some)
    {
        if (isThere) slots.insert(slots.end(), some.begin(), some.end());
    };
    const bool isSh = has("_SH"), isDiffuse = has("_DIFFUSE"), isSpecular = has("_SPECULAR");
    add(isDiffuse && !isSh, {ResourceType::IN_DIFF_RADIANCE_HITDIST, ResourceType::OUT_DIFF_RADIANCE_HITDIST});
    add(isSpecular && !isSh, {ResourceType::IN_SPEC_RADIANCE_HITDIST, ResourceType::OUT_SPEC_RADIANCE_HITDIST});
    add(isDiffuse && isSh, {ResourceType::IN_DIFF_SH0, ResourceType::IN_DIFF_SH1});
    add(isDiffuse && isSh, {ResourceType::OUT_DIFF_SH0, ResourceType::OUT_DIFF_SH1});
    add(isSpecular && isSh, {ResourceType::IN_SPEC_SH0, ResourceType::IN_SPEC_SH1});
    add(isSpecular && isSh, {ResourceType::OUT_SPEC_SH0, ResourceType::OUT_SPEC_SH1});
    return slots;
}

// With the guides and the validation overlay.
inline std::vector<nrd::ResourceType> relaxSlots(std::string_view name)
{
    using nrd::ResourceType;
    std::vector<ResourceType> slots = relaxLobeSlots(name);
    slots.insert(slots.end(), {ResourceType::IN_MV, ResourceType::IN_NORMAL_ROUGHNESS, ResourceType::IN_VIEWZ,
                               ResourceType::OUT_VALIDATION});
    return slots;
}

inline bool isOutputSlot(nrd::ResourceType type)
{
    return type >= nrd::ResourceType::OUT_DIFF_RADIANCE_HITDIST && type <= nrd::ResourceType::OUT_VALIDATION;
}
