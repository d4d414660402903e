// The ranges of the panel's table against what the library takes: neither a slider that is refused nor one that ends
// early.
#include "catch.h"
#include "denoiser_set.h"
#include "window/viewer_state.h"

#include <cmath>
#include <nrd/nrd.h>
#include <set>

using namespace sample;

namespace
{
struct Outcome
{
    bool isTaken = false;
    std::string message;
};

// An instance of one denoiser that keeps the last message.
class Taker
{
public:
    explicit Taker(const SampleDenoiser& row) : m_family(row.family)
    {
        nrd::DenoiserDesc denoiser;
        denoiser.denoiser = row.denoiser;
        nrd::InstanceCreationDesc desc;
        desc.denoisers = &denoiser;
        desc.denoisersNum = 1;
        desc.confidenceTileSize = 5;
        desc.messageSink.userArg = this;
        desc.messageSink.report = [](void* self, nrd::Result, const char* text)
        { static_cast<Taker*>(self)->m_message = text; };
        REQUIRE(nrd::CreateInstance(desc, m_instance) == nrd::Result::SUCCESS);
    }
    ~Taker() { nrd::DestroyInstance(m_instance); }
    Taker(const Taker&) = delete;
    Taker& operator=(const Taker&) = delete;

    Outcome offer(ReplaySettings settings)
    {
        m_message.clear();
        nrd::CommonSettings& s = settings.common;
        for (float* matrix : {s.viewToClipMatrix, s.viewToClipMatrixPrev, s.worldToViewMatrix, s.worldToViewMatrixPrev})
            for (int i = 0; i < 4; ++i) matrix[i * 5] = 1.0f;
        for (float* matrix : {s.viewToClipMatrix, s.viewToClipMatrixPrev})
            matrix[10] = 0.0f, matrix[15] = 0.0f, matrix[11] = 1.0f, matrix[14] = 0.1f;
        for (uint16_t* size : {s.resourceSize, s.resourceSizePrev, s.rectSize, s.rectSizePrev}) size[0] = size[1] = 64;
        s.frameIndex = m_frame++;
        const auto set = [&](const auto& own) { return nrd::SetDenoiserSettings(*m_instance, 0, own); };
        const bool isTaken = setDenoiserSettings(settings, m_family, set) == nrd::Result::SUCCESS &&
                             nrd::SetConfidenceSettings(*m_instance, settings.confidence) == nrd::Result::SUCCESS &&
                             nrd::SetCommonSettings(*m_instance, s) == nrd::Result::SUCCESS;
        return {isTaken, m_message};
    }

private:
    Family m_family;
    nrd::Instance* m_instance = nullptr;
    std::string m_message;
    uint32_t m_frame = 0;
};

void write(const SettingField& field, double value)
{
    const auto put = [&](auto* target)
    {
        using T = std::remove_pointer_t<decltype(target)>;
        if constexpr (!std::is_enum_v<T>) *target = static_cast<T>(value);
    };
    std::visit(put, field.target);
}

// As the library knows it.
std::string ownName(const SettingField& field)
{
    const std::string prefix = "confidence.";
    return field.name.rfind(prefix, 0) == 0 ? field.name.substr(prefix.size()) : field.name;
}

bool isReal(const SettingField& field) { return std::holds_alternative<float*>(field.target); }

// Some fields bound others: the defaults, and what leaves most room to either side.
std::vector<ReplaySettings> bases()
{
    ReplaySettings wide, narrow;
    wide.reblur.maxFastAccumulatedFrameNum = 63;
    wide.reblur.historyFixFrameNum = 8;
    wide.relax.diffuseMaxFastAccumulatedFrameNum = wide.relax.specularMaxFastAccumulatedFrameNum = 63;
    narrow.reblur.historyFixFrameNum = narrow.reblur.responsiveAccumulationSettings.minAccumulatedFrameNum = 0;
    narrow.relax.historyFixFrameNum = 0;
    return {ReplaySettings(), wide, narrow};
}

// Taken on top of one of the bases.
Outcome offer(Taker& taker, const DenoiserSet& set, size_t index, double value)
{
    Outcome outcome;
    for (ReplaySettings settings : bases())
    {
        write(panelFields(settings, set)[index], value);
        outcome = taker.offer(settings);
        if (outcome.isTaken) break;
    }
    return outcome;
}

// From the lowest value to the highest, and one step further on either side.
size_t walk(Taker& taker, const DenoiserSet& set, size_t index)
{
    ReplaySettings settings;
    const SettingField field = panelFields(settings, set)[index];
    if (!field.hasRange()) return 0;
    INFO(field.name << " " << rangeText(field.range));
    const double low = field.range.low,
                 high = std::isinf(field.range.high) ? std::max(1e6, 2.0 * low) : field.range.high;
    const double step = isReal(field) ? (high - low) / 8.0 : std::max(1.0, std::floor((high - low) / 8.0));
    for (double value = field.range.isLowExcluded ? low + step : low; value < high + 0.5 * step; value += step)
    {
        const Outcome outcome = offer(taker, set, index, std::min(value, high));
        INFO(value << ": " << outcome.message);
        CHECK(outcome.isTaken);
    }
    std::vector<double> wrong;
    if (!std::isinf(field.range.high)) wrong.push_back(high + (isReal(field) ? 1e-3 * std::max(1.0, high) : 1.0));
    if (field.range.isLowExcluded) wrong.push_back(low);
    if (!field.range.isLowExcluded && (isReal(field) || low > 0.0)) wrong.push_back(low - 1.0);
    for (double value : wrong)
    {
        if (field.name == "responsiveAccumulationSettings.minAccumulatedFrameNum") break; // unused while it is off
        const Outcome outcome = offer(taker, set, index, value);
        INFO(value << ": " << outcome.message);
        CHECK_FALSE(outcome.isTaken);
        CHECK_THAT(outcome.message, containing(ownName(field)));
    }
    return 1;
}
} // namespace

TEST_CASE("the library takes every setting of the panel over its whole range, and no further", "[unit]")
{
    size_t walked = 0;
    for (const char* name : {"REBLUR_DIFFUSE_SPECULAR", "RELAX_DIFFUSE_SPECULAR", "SIGMA_SHADOW", "REFERENCE"})
    {
        const DenoiserSet set = parseDenoiserSets(name).front();
        Taker taker(set.shadow ? *set.shadow : *set.lobes);
        ReplaySettings settings;
        const size_t count = panelFields(settings, set).size();
        for (size_t i = 0; i < count; ++i) walked += walk(taker, set, i);
    }
    CHECK(walked > 80);
}

TEST_CASE("every setting of a family is in the panel or the application's own", "[unit]")
{
    ReplaySettings settings;
    for (Family family : {Family::Reblur, Family::Relax, Family::Sigma, Family::Reference})
        for (const SettingField& field : settingFields(settings, family))
        {
            INFO(field.name);
            const bool isNumber = isReal(field) || std::holds_alternative<uint32_t*>(field.target);
            if (field.group && isNumber) CHECK(field.hasRange());
            if (field.group) CHECK(field.count == 1);
            if (field.hasRange()) CHECK(isInRange(field)); // the default
        }
}

TEST_CASE("settings of one name of two families can be set apart", "[unit]")
{
    const DenoiserSet set = parseDenoiserSets("REBLUR_DIFFUSE+SIGMA_SHADOW").front();
    ReplaySettings settings;
    applySettings(settings, set.families(), {{"REBLUR.maxStabilizedFrameNum", "200"}});
    CHECK(settings.reblur.maxStabilizedFrameNum == 200);
    CHECK(settings.sigma.maxStabilizedFrameNum == 8);
    applySettings(settings, set.families(), {{"maxStabilizedFrameNum", "3"}});
    CHECK(settings.reblur.maxStabilizedFrameNum == 3);
    CHECK(settings.sigma.maxStabilizedFrameNum == 3);
    CHECK_THROWS_AS(applySettings(settings, set.families(), {{"RELAX.depthThreshold", "1"}}), SettingError);
    std::set<std::string> names;
    for (const SettingField& field : panelFields(settings, set)) CHECK(names.insert(field.name).second);
    CHECK(names.count("SIGMA.maxStabilizedFrameNum") == 1);
}

TEST_CASE("a value's text is read back as the same value", "[unit]")
{
    ReplaySettings settings, other;
    settings.reblur.maxBlurRadius = 12.3456789f;
    settings.reblur.prePassMode = nrd::PrePassMode::OFF;
    settings.common.enableValidation = true;
    std::vector<Assignment> all;
    for (const SettingField& field : settingFields(settings, Family::Reblur))
        all.emplace_back(field.name, valueText(field));
    applySettings(other, Family::Reblur, all);
    CHECK(other.reblur.maxBlurRadius == settings.reblur.maxBlurRadius);
    CHECK(other.reblur.prePassMode == nrd::PrePassMode::OFF);
    CHECK(other.common.enableValidation);
}

TEST_CASE("a value out of its range is refused with the range", "[unit]")
{
    ReplaySettings settings;
    settings.reblur.maxBlurRadius = 300.0f;
    CHECK_THROWS_WITH(checkRanges(settings, {Family::Reblur}, "maxBlurRadius"), containing("[0; 256]"));
    settings.reblur.minHitDistanceWeight = 0.2f;
    CHECK_NOTHROW(checkRanges(settings, {Family::Reblur}, "minHitDistanceWeight"));
}
