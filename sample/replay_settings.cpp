#include "replay_settings.h"

#include <charconv>
#include <cmath>
#include <iterator>
#include <sstream>

namespace sample
{
namespace
{
// The enumerators' names in the order of their values.
template <class Mode> struct ModeNames;
template <> struct ModeNames<nrd::AccumulationMode>
{
    static constexpr const char* names[] = {"CONTINUE", "RESTART", "CLEAR_AND_RESTART"};
};
template <> struct ModeNames<nrd::PrePassMode>
{
    static constexpr const char* names[] = {"OFF", "SIMPLE", "AUTO"};
};
template <> struct ModeNames<nrd::CheckerboardMode>
{
    static constexpr const char* names[] = {"OFF", "BLACK", "WHITE"};
};
template <> struct ModeNames<nrd::HitDistanceReconstructionMode>
{
    static constexpr const char* names[] = {"OFF", "AREA_3X3", "AREA_5X5"};
};
template <> struct ModeNames<nrd::Quality>
{
    static constexpr const char* names[] = {"FAST", "BALANCED", "BEST"};
};

// Parses one value of type T out of the whole of `text`; returns what was expected when it is none, else null.
template <class T> const char* parseValue(const std::string& text, T& value)
{
    if constexpr (std::is_same_v<T, bool>)
    {
        if (text != "true" && text != "false" && text != "1" && text != "0") return "true or false";
        value = text == "true" || text == "1";
        return nullptr;
    }
    else if constexpr (std::is_enum_v<T>)
    {
        static_assert(std::size(ModeNames<T>::names) == static_cast<size_t>(T::MAX_NUM));
        static const std::string expected = []
        {
            std::string list = "one of";
            for (const char* name : ModeNames<T>::names) list += std::string(" ") + name;
            return list;
        }();
        for (size_t i = 0; i < std::size(ModeNames<T>::names); i++)
        {
            if (text != ModeNames<T>::names[i]) continue;
            value = static_cast<T>(i);
            return nullptr;
        }
        return expected.c_str();
    }
    else
    {
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool isWhole = error == std::errc() && end == text.data() + text.size();
        if constexpr (std::is_floating_point_v<T>)
            return isWhole && std::isfinite(value) ? nullptr : "a finite number";
        else
            return isWhole          ? nullptr
                   : sizeof(T) == 2 ? "a whole number from 0 to 65535"
                                    : "a whole number of at least 0";
    }
}

// What parseValue() takes back.
template <class T> std::string textOf(T value)
{
    if constexpr (std::is_same_v<T, bool>)
        return value ? "true" : "false";
    else if constexpr (std::is_enum_v<T>)
        return ModeNames<T>::names[static_cast<size_t>(value)];
    else
    {
        char digits[32];
        return {digits, std::to_chars(digits, digits + sizeof(digits), value).ptr};
    }
}

std::vector<std::string> split(const std::string& text)
{
    std::vector<std::string> parts;
    size_t begin = 0;
    while (true)
    {
        const size_t comma = text.find(',', begin);
        parts.push_back(text.substr(begin, comma - begin));
        if (comma == std::string::npos) return parts;
        begin = comma + 1;
    }
}

void assign(const SettingField& target, const std::string& text)
{
    const std::vector<std::string> parts = split(text);
    const auto fail = [&](const std::string& expected)
    { throw SettingError("--set " + target.name + "=" + text + ": expected " + expected); };
    if (parts.size() != target.count) fail(std::to_string(target.count) + " value(s), separated by commas");
    for (size_t i = 0; i < parts.size(); i++)
    {
        const auto parse = [&](auto* values) -> const char*
        {
            auto value = values[i];
            const char* expected = parseValue(parts[i], value);
            if (!expected) values[i] = value;
            return expected;
        };
        if (const char* expected = std::visit(parse, target.target)) fail(expected);
    }
}
} // namespace

std::span<const char* const> modeNames(const SettingTarget& target)
{
    const auto names = [](auto* value) -> std::span<const char* const>
    {
        using T = std::remove_pointer_t<decltype(value)>;
        if constexpr (std::is_enum_v<T>)
            return ModeNames<T>::names;
        else
            return {};
    };
    return std::visit(names, target);
}

std::string valueText(const SettingField& field)
{
    std::string text;
    for (size_t i = 0; i < field.count; i++)
    {
        if (i > 0) text += ",";
        text += std::visit([&](const auto* values) { return textOf(values[i]); }, field.target);
    }
    return text;
}

bool isInRange(const SettingField& field)
{
    const SettingRange& range = field.range;
    const auto isInside = [&](const auto* value)
    {
        using T = std::remove_const_t<std::remove_pointer_t<decltype(value)>>;
        if constexpr (std::is_enum_v<T>)
            return true;
        else // in its own type: 0.2 as a float is a little more than 0.2
            return (range.isLowExcluded ? *value > static_cast<T>(range.low) : *value >= static_cast<T>(range.low)) &&
                   (std::isinf(range.high) || *value <= static_cast<T>(range.high));
    };
    return !field.hasRange() || std::visit(isInside, field.target);
}

std::string rangeText(const SettingRange& range)
{
    std::ostringstream text;
    if (std::isinf(range.high))
        text << (range.isLowExcluded ? "> " : ">= ") << range.low;
    else
        text << (range.isLowExcluded ? "(" : "[") << range.low << "; " << range.high << "]";
    return text.str();
}

std::vector<SettingField> settingFields(ReplaySettings& settings, Family family)
{
    std::vector<SettingField> fields = nrd::settingFields(settings.common);
    std::vector<SettingField> own;
    switch (family)
    {
    case Family::Reblur:
        own = nrd::settingFields(settings.reblur);
        break;
    case Family::Relax:
        own = nrd::settingFields(settings.relax);
        break;
    case Family::Reference:
        own = nrd::settingFields(settings.reference);
        break;
    case Family::Sigma:
        own = nrd::settingFields(settings.sigma);
        break;
    case Family::Confidence:
        own = nrd::settingFields(settings.confidence);
        for (SettingField& field : own) field.name = "confidence." + field.name;
        break;
    case Family::None:
        break;
    }
    fields.insert(fields.end(), std::make_move_iterator(own.begin()), std::make_move_iterator(own.end()));
    return fields;
}

nrd::CheckerboardMode checkerboardModeOf(const ReplaySettings& settings, Family family)
{
    if (family == Family::Reblur) return settings.reblur.checkerboardMode;
    if (family == Family::Sigma) return settings.sigma.checkerboardMode;
    return family == Family::Relax ? settings.relax.checkerboardMode : nrd::CheckerboardMode::OFF;
}

ReplaySettings presetSettings(nrd::Quality preset)
{
    ReplaySettings settings;
    settings.reblur = nrd::GetReblurSettings(preset);
    settings.relax = nrd::GetRelaxSettings(preset);
    settings.sigma = nrd::GetSigmaSettings(preset);
    return settings;
}

nrd::Quality parsePreset(const std::string& text)
{
    nrd::Quality preset = nrd::Quality::BALANCED;
    if (const char* expected = parseValue(text, preset))
        throw SettingError("--preset " + text + ": expected " + expected);
    return preset;
}

const char* nameOf(nrd::Quality preset) { return ModeNames<nrd::Quality>::names[static_cast<size_t>(preset)]; }

Assignment parseAssignment(const std::string& text)
{
    const size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0) throw SettingError("--set " + text + ": expected key=value");
    return {text.substr(0, equals), text.substr(equals + 1)};
}

void applySettings(ReplaySettings& settings, Family family, const std::vector<Assignment>& assignments)
{
    const std::vector<SettingField> fields = settingFields(settings, family);
    for (const auto& [key, value] : assignments)
    {
        const SettingField* found = nullptr;
        for (const SettingField& candidate : fields)
            if (candidate.name == key) found = &candidate;
        if (!found) throw SettingError("--set " + key + ": the denoiser has no setting of that name");
        assign(*found, value);
    }
}
} // namespace sample
