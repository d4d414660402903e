// Every field of the settings by name, for command lines, panels and interfaces that know no structs.
#pragma once
#include <nrd/settings.h>
#include <string>
#include <variant>
#include <vector>

namespace nrd
{
using SettingTarget = std::variant<float*, double*, uint32_t*, uint16_t*, bool*, AccumulationMode*, PrePassMode*,
                                   CheckerboardMode*, HitDistanceReconstructionMode*>;

// What a number may be; infinite: as large as its type has it. Of no use to flags and modes.
struct SettingRange
{
    double low = 0.0;
    double high = 0.0;
    bool isLowExcluded = false; // (low; high], else [low; high]
};

// One field of a given settings object; an array has several values in a row.
struct SettingField
{
    std::string name; // as in the struct, nested ones with a dot
    SettingTarget target;
    size_t count = 1;
    const char* group = nullptr; // the heading a panel shows it under; null: the application's own, without a range
    SettingRange range;

    bool hasRange() const { return range.high > range.low; }
};

std::vector<SettingField> settingFields(CommonSettings& settings);
std::vector<SettingField> settingFields(ReblurSettings& settings);
std::vector<SettingField> settingFields(RelaxSettings& settings);
std::vector<SettingField> settingFields(SigmaSettings& settings);
std::vector<SettingField> settingFields(ReferenceSettings& settings);
std::vector<SettingField> settingFields(ConfidenceSettings& settings);
} // namespace nrd
