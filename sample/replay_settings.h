// --preset and --set key=value: every field of CommonSettings and of the families' settings by name.
#pragma once
#include "replay_denoisers.h"

#include <nrd/presets.h>
#include <setting_fields.h>

#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sample
{
// A key or value that --set cannot take, in one sentence.
class SettingError : public std::runtime_error
{
public:
    using std::runtime_error::runtime_error;
};

struct ReplaySettings
{
    nrd::CommonSettings common;
    nrd::ReblurSettings reblur;
    nrd::RelaxSettings relax;
    nrd::SigmaSettings sigma;
    nrd::ReferenceSettings reference;
    nrd::ConfidenceSettings confidence;
};

// What `set` answers to the family's settings; SUCCESS for a family without any.
template <class Set> nrd::Result setDenoiserSettings(const ReplaySettings& settings, Family family, const Set& set)
{
    switch (family)
    {
    case Family::Reblur:
        return set(settings.reblur);
    case Family::Relax:
        return set(settings.relax);
    case Family::Reference:
        return set(settings.reference);
    case Family::Sigma:
        return set(settings.sigma);
    case Family::None:
    case Family::Confidence:
        break;
    }
    return nrd::Result::SUCCESS;
}

// OFF for a family that knows no checkerboard.
nrd::CheckerboardMode checkerboardModeOf(const ReplaySettings& settings, Family family);

using nrd::SettingField;
using nrd::SettingRange;
using nrd::SettingTarget;

// The fields --set reaches for a family: the common ones, then the family's own; those of confidence are
// "confidence.x".
std::vector<SettingField> settingFields(ReplaySettings& settings, Family family);

// The families' settings at a preset; the common ones know none.
ReplaySettings presetSettings(nrd::Quality preset);

// FAST, BALANCED or BEST. Throws SettingError.
nrd::Quality parsePreset(const std::string& text);

const char* nameOf(nrd::Quality preset);

// Of an enumeration the names in the order of their values; empty for flags and numbers.
std::span<const char* const> modeNames(const SettingTarget& target);

// The field's values as an assignment has them.
std::string valueText(const SettingField& field);

// True for fields without a range.
bool isInRange(const SettingField& field);
// "[0; 63]", "(0; 1]", ">= 1".
std::string rangeText(const SettingRange& range);

// "key=value" as given on the command line.
using Assignment = std::pair<std::string, std::string>;

// Splits "key=value". Throws SettingError.
Assignment parseAssignment(const std::string& text);

// Writes the values into `settings`. A list's values are separated by commas, flags are true or false, modes are named
// as in the header. Throws SettingError for a key the family has no field for, and a value its type does not take.
void applySettings(ReplaySettings& settings, Family family, const std::vector<Assignment>& assignments);
} // namespace sample
