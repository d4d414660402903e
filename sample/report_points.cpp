#include "report_points.h"
#include "replay_slots.h"

#include <nrd/nrd.h>

#include <algorithm>
#include <memory>
#include <sstream>

namespace sample::report
{
namespace
{
using nrd::Quality;

struct PointRow
{
    Family family;
    const char* name;
    Quality preset;
    std::vector<Assignment> settings;
    Resolution resolution = {};
};

// clang-format off
const std::vector<PointRow>& rows()
{
    constexpr Quality kDefault = Quality::BALANCED;
    static const std::vector<PointRow> table = {
        {Family::Reblur, "FAST",             Quality::FAST, {}},
        {Family::Reblur, "BALANCED",         kDefault,      {}},
        {Family::Reblur, "BEST",             Quality::BEST, {}},
        {Family::Reblur, "pre-pass off",     kDefault, {{"prePassMode", "OFF"}}},
        {Family::Reblur, "pre-pass on",      kDefault, {{"prePassMode", "SIMPLE"}, {"diffusePrepassBlurRadius", "18"},
                                                        {"specularPrepassBlurRadius", "36"}}},
        {Family::Reblur, "no stabilisation", kDefault, {{"maxStabilizedFrameNum", "0"}}},
        {Family::Reblur, "history 20",       kDefault, {{"maxAccumulatedFrameNum", "20"}}},
        {Family::Reblur, "history 63",       kDefault, {{"maxAccumulatedFrameNum", "63"}}},
        {Family::Reblur, "radius 15",        kDefault, {{"maxBlurRadius", "15"}}},
        {Family::Reblur, "radius 60",        kDefault, {{"maxBlurRadius", "60"}}},
        {Family::Reblur, "half size",        kDefault, {}, {2}},
        {Family::Reblur, "half size sparse", kDefault, {}, {2, true}},
        {Family::Relax, "FAST",         Quality::FAST, {}},
        {Family::Relax, "BALANCED",     kDefault,      {}},
        {Family::Relax, "BEST",         Quality::BEST, {}},
        {Family::Relax, "pre-pass off", kDefault, {{"prePassMode", "OFF"}}},
        {Family::Relax, "pre-pass on",  kDefault, {{"prePassMode", "SIMPLE"}, {"diffusePrepassBlurRadius", "18"},
                                                   {"specularPrepassBlurRadius", "36"}}},
        {Family::Relax, "2 iterations", kDefault, {{"atrousIterationNum", "2"}}},
        {Family::Relax, "3 iterations", kDefault, {{"atrousIterationNum", "3"}}},
        {Family::Relax, "4 iterations", kDefault, {{"atrousIterationNum", "4"}}},
        {Family::Relax, "5 iterations", kDefault, {{"atrousIterationNum", "5"}}},
        {Family::Relax, "history 63",   kDefault, {{"diffuseMaxAccumulatedFrameNum", "63"},
                                                   {"specularMaxAccumulatedFrameNum", "63"}}},
        {Family::Relax, "half size",        kDefault, {}, {2}},
        {Family::Relax, "half size sparse", kDefault, {}, {2, true}},
        {Family::Sigma, "BALANCED",         kDefault, {}},
        {Family::Sigma, "no stabilisation", kDefault, {{"maxStabilizedFrameNum", "0"}}},
        {Family::Sigma, "stabilised 4",     kDefault, {{"maxStabilizedFrameNum", "4"}}},
        {Family::Sigma, "stabilised 15",    kDefault, {{"maxStabilizedFrameNum", "15"}}},
        {Family::Sigma, "half size sparse", kDefault, {}, {2, true}},
        {Family::Reference, "default", kDefault, {}},
    };
    return table;
}
// clang-format on

std::vector<std::string> wordsOf(const std::string& text)
{
    std::istringstream stream(text);
    std::vector<std::string> words;
    for (std::string word; stream >> word;) words.push_back(word);
    return words;
}

struct InstanceDeleter
{
    void operator()(nrd::Instance* instance) const { nrd::DestroyInstance(instance); }
};
} // namespace

std::vector<Point> pointsOf(Family family)
{
    std::vector<Point> points;
    for (const PointRow& row : rows())
        if (row.family == family) points.push_back({row.name, row.preset, row.settings, row.resolution});
    return points;
}

Point parsePoint(const std::string& text, nrd::Quality preset)
{
    const size_t colon = text.find(':');
    if (colon == std::string::npos || colon == 0)
        throw SettingError("--point " + text + ": expected NAME: key=value key=value");
    Point point{text.substr(0, colon), preset, {}};
    for (const std::string& word : wordsOf(text.substr(colon + 1))) point.settings.push_back(parseAssignment(word));
    return point;
}

bool hasSettings(Family family, const Point& point)
{
    ReplaySettings settings;
    const std::vector<SettingField> fields = settingFields(settings, family);
    for (const auto& [key, value] : point.settings)
    {
        const auto isNamed = [&name = key](const SettingField& field) { return field.name == name; };
        if (std::none_of(fields.begin(), fields.end(), isNamed)) return false;
    }
    applySettings(settings, family, point.settings);
    return true;
}

bool fits(const Capture& capture, const ReplayDenoiser& denoiser)
{
    const nrd::DenoiserDesc row{0, denoiser.denoiser};
    nrd::InstanceCreationDesc desc;
    desc.denoisers = &row;
    desc.denoisersNum = 1;
    nrd::Instance* raw = nullptr;
    if (nrd::CreateInstance(desc, raw) != nrd::Result::SUCCESS) return false; // not in this build
    const std::unique_ptr<nrd::Instance, InstanceDeleter> instance(raw);
    const nrd::ResourceRequirement* requirements = nullptr;
    uint32_t count = 0;
    if (nrd::GetRequiredResources(*instance, 0, requirements, count) != nrd::Result::SUCCESS) return false;
    for (uint32_t i = 0; i < count; i++)
    {
        if (!requirements[i].isRequired) continue;
        const SlotRow* slot = findSlot(requirements[i].type, denoiser.family);
        if (!slot) return false;
        for (const std::optional<Layer>& layer : {slot->layer, slot->direction})
            for (Channel channel : layer ? neededChannels(*layer) : std::vector<Channel>())
                if (!capture.has(channel)) return false;
    }
    return true;
}

std::string groupOf(const ReplayDenoiser& denoiser)
{
    std::string group, scalars;
    for (Signal signal : denoiser.signals)
    {
        const bool isHitDistance = signal == Signal::NormHitDist || signal == Signal::SpecularNormHitDist;
        std::string& list = isHitDistance ? scalars : group;
        if (!list.empty()) list += '-';
        list += signalInfo(signal).name;
    }
    return group.empty() ? scalars : group;
}
} // namespace sample::report
