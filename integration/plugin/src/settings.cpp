#include "settings.h"
#include "refusal.h"
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <setting_fields.h>

namespace nrd::plugin
{
namespace
{
// One number of a field.
struct Number
{
    SettingField field;
    size_t element = 0;
};

// In the order of the names below.
std::vector<Number> numbersOf(DenoiserSettings& settings)
{
    std::vector<Number> result;
    for (const SettingField& field : std::visit([](auto& s) { return settingFields(s); }, settings))
        if (field.name != "lightDirection")
            for (size_t i = 0; i < field.count; i++) result.push_back({field, i});
    return result;
}

// They outlive every caller.
const std::vector<std::string>& namesOf(Denoiser denoiser)
{
    static const auto kNames = []
    {
        std::array<std::vector<std::string>, std::variant_size_v<DenoiserSettings>> names;
        for (uint32_t i = 0; i < static_cast<uint32_t>(Denoiser::MAX_NUM); i++)
        {
            DenoiserSettings settings = defaultSettings(static_cast<Denoiser>(i));
            std::vector<std::string>& own = names[settings.index()];
            own.clear();
            for (const Number& number : numbersOf(settings))
                own.push_back(number.field.count == 1 ? number.field.name
                                                      : number.field.name + "[" + std::to_string(number.element) + "]");
        }
        return names;
    }();
    return kNames[defaultSettings(denoiser).index()];
}

double read(const Number& number)
{
    return std::visit([&](const auto* values) { return static_cast<double>(values[number.element]); },
                      number.field.target);
}

// What the type takes; the library knows the ranges.
const char* write(const Number& number, double value)
{
    const auto assign = [&](auto* values) -> const char*
    {
        using T = std::remove_pointer_t<decltype(values)>;
        const bool isWhole = value >= 0.0 && value == std::floor(value);
        if constexpr (std::is_same_v<T, bool>)
        {
            if (value != 0.0 && value != 1.0) return "0 or 1";
        }
        else if constexpr (std::is_enum_v<T>)
        {
            if (!isWhole || value >= static_cast<double>(T::MAX_NUM)) return "the number of a mode";
        }
        else if constexpr (std::is_integral_v<T>)
        {
            if (!isWhole || value > static_cast<double>(std::numeric_limits<T>::max())) return "a whole number";
        }
        else if (!(std::abs(value) <= static_cast<double>(std::numeric_limits<float>::max())))
            return "finite";
        if constexpr (std::is_enum_v<T>)
            values[number.element] = static_cast<T>(static_cast<uint32_t>(value));
        else
            values[number.element] = static_cast<T>(value);
        return nullptr;
    };
    return std::visit(assign, number.field.target);
}
} // namespace

DenoiserSettings defaultSettings(Denoiser denoiser)
{
    if (denoiser <= Denoiser::REBLUR_DIFFUSE_DIRECTIONAL_OCCLUSION) return ReblurSettings{};
    if (denoiser <= Denoiser::RELAX_DIFFUSE_SPECULAR_SH) return RelaxSettings{};
    if (denoiser <= Denoiser::SIGMA_SHADOW_TRANSLUCENCY) return SigmaSettings{};
    return ReferenceSettings{};
}

uint32_t settingNum(Denoiser denoiser) { return static_cast<uint32_t>(namesOf(denoiser).size()); }

void describeSetting(Denoiser denoiser, uint32_t index, const DenoiserSettings& settings, NrdPluginSettingInfo& info)
{
    DenoiserSettings copy = settings;
    const Number number = numbersOf(copy)[index];
    info.isLowExcluded = number.field.range.isLowExcluded ? 1 : 0;
    info.name = namesOf(denoiser)[index].c_str();
    info.value = read(number);
    info.low = number.field.range.low;
    info.high = number.field.range.high;
}

void setSetting(Denoiser denoiser, const char* name, double value, DenoiserSettings& settings)
{
    const std::vector<std::string>& names = namesOf(denoiser);
    for (size_t i = 0; i < names.size(); i++)
    {
        if (names[i] != name) continue;
        if (const char* expected = write(numbersOf(settings)[i], value))
            throw Refusal(Result::INVALID_ARGUMENT, sentence("%s is %g, must be %s", name, value, expected));
        return;
    }
    throw Refusal(Result::INVALID_ARGUMENT, sentence("%s has no setting '%s'", toString(denoiser), name));
}
} // namespace nrd::plugin
