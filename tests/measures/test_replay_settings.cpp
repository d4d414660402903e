// The table behind --set against the structs themselves: a field without a row must not go unnoticed.
#include "catch.h"

#include "replay_settings.h"

#include <set>
#include <utility>

using namespace sample;

namespace
{
// Initialises any member of an aggregate. An array member takes one per element, a nested struct takes one.
struct Anything
{
    template <class T> operator T() const;
};

template <class T, size_t... I> constexpr bool takes(std::index_sequence<I...>)
{
    return requires { T{(static_cast<void>(I), Anything{})...}; };
}

// How many values initialise the aggregate T: unlike sizes and offsets this also sees a field that fills padding.
template <class T, size_t Count = 1> constexpr size_t valueCount()
{
    if constexpr (takes<T>(std::make_index_sequence<Count>()))
        return valueCount<T, Count + 1>();
    else
        return Count - 1;
}

struct Padded
{
    float a[3];
    bool b;
    bool hidden;
    double c;
    bool last;
};
static_assert(valueCount<Padded>() == 7);

// The same of the table's rows whose name begins with `prefix`; a nested struct counts once.
size_t rowValueCount(const std::vector<SettingField>& fields, const std::string& prefix)
{
    std::set<std::string> nested;
    size_t count = 0;
    for (const SettingField& field : fields)
    {
        if (field.name.compare(0, prefix.size(), prefix) != 0) continue;
        const std::string name = field.name.substr(prefix.size());
        const size_t dot = name.find('.');
        if (dot == std::string::npos)
            count += field.count;
        else
            nested.insert(name.substr(0, dot));
    }
    return count + nested.size();
}
} // namespace

TEST_CASE("every field of every settings struct has a row", "[unit]")
{
    ReplaySettings settings;
    const size_t common = rowValueCount(settingFields(settings, Family::None), "");
    CHECK(common == valueCount<nrd::CommonSettings>());
    const std::vector<SettingField> reblur = settingFields(settings, Family::Reblur);
    CHECK(rowValueCount(reblur, "") - common == valueCount<nrd::ReblurSettings>());
    CHECK(rowValueCount(reblur, "hitDistanceParameters.") == valueCount<nrd::HitDistanceParameters>());
    CHECK(rowValueCount(reblur, "antilagSettings.") == valueCount<nrd::ReblurAntilagSettings>());
    CHECK(rowValueCount(reblur, "responsiveAccumulationSettings.") ==
          valueCount<nrd::ResponsiveAccumulationSettings>());
    CHECK(rowValueCount(reblur, "convergenceSettings.") == valueCount<nrd::ConvergenceSettings>());
    const std::vector<SettingField> relax = settingFields(settings, Family::Relax);
    CHECK(rowValueCount(relax, "") - common == valueCount<nrd::RelaxSettings>());
    CHECK(rowValueCount(relax, "antilagSettings.") == valueCount<nrd::RelaxAntilagSettings>());
    const std::vector<SettingField> sigma = settingFields(settings, Family::Sigma);
    CHECK(rowValueCount(sigma, "") - common == valueCount<nrd::SigmaSettings>());
    const std::vector<SettingField> reference = settingFields(settings, Family::Reference);
    CHECK(rowValueCount(reference, "") - common == valueCount<nrd::ReferenceSettings>());
}

TEST_CASE("every family is given its own settings", "[unit]")
{
    ReplaySettings settings;
    settings.reblur.checkerboardMode = nrd::CheckerboardMode::BLACK;
    settings.relax.checkerboardMode = nrd::CheckerboardMode::WHITE;
    settings.sigma.checkerboardMode = nrd::CheckerboardMode::BLACK;
    const void* given = nullptr;
    const auto set = [&](const auto& own)
    {
        given = &own;
        return nrd::Result::INVALID_ARGUMENT;
    };
    const std::pair<Family, const void*> rows[] = {{Family::Reblur, &settings.reblur},
                                                   {Family::Relax, &settings.relax},
                                                   {Family::Sigma, &settings.sigma},
                                                   {Family::Reference, &settings.reference}};
    for (const auto& [family, expected] : rows)
    {
        CHECK(setDenoiserSettings(settings, family, set) == nrd::Result::INVALID_ARGUMENT);
        CHECK(given == expected);
    }
    given = nullptr;
    CHECK(setDenoiserSettings(settings, Family::None, set) == nrd::Result::SUCCESS);
    CHECK(given == nullptr);
    CHECK(checkerboardModeOf(settings, Family::Reblur) == nrd::CheckerboardMode::BLACK);
    CHECK(checkerboardModeOf(settings, Family::Relax) == nrd::CheckerboardMode::WHITE);
    CHECK(checkerboardModeOf(settings, Family::Sigma) == nrd::CheckerboardMode::BLACK);
    CHECK(checkerboardModeOf(settings, Family::Reference) == nrd::CheckerboardMode::OFF);
}

TEST_CASE("BALANCED is the defaults, and no other preset is", "[unit]")
{
    const auto isEqual = [](const SettingField& a, const SettingField& b)
    {
        const auto compare = [&](auto* values)
        { return std::equal(values, values + a.count, std::get<decltype(values)>(b.target)); };
        return std::visit(compare, a.target);
    };
    ReplaySettings defaults;
    for (const char* name : {"FAST", "BALANCED", "BEST"})
    {
        INFO(name);
        ReplaySettings settings = presetSettings(parsePreset(name));
        size_t differenceCount = 0;
        for (Family family : {Family::Reblur, Family::Relax, Family::Sigma, Family::Reference})
        {
            const std::vector<SettingField> a = settingFields(settings, family), b = settingFields(defaults, family);
            for (size_t i = 0; i < a.size(); i++) differenceCount += !isEqual(a[i], b[i]);
        }
        CHECK((differenceCount == 0) == (parsePreset(name) == nrd::Quality::BALANCED));
    }
    CHECK_THROWS_AS(parsePreset("best"), SettingError);
}
