#include "check.h"
#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <exception>
#include <optional>

namespace nrd
{
namespace doctor
{
std::string text(const char* format, ...)
{
    char buffer[512];
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(buffer, sizeof(buffer), format, arguments);
    va_end(arguments);
    return buffer;
}

namespace
{
// Empty, or what is wrong.
std::string findError(const DoctorFrame& frame)
{
    const CommonSettings& common = frame.common;
    if (!frame.viewZ) return "viewZ is null, but every rule needs it";
    if (frame.normalEncoding >= NormalEncoding::MAX_NUM) return "normalEncoding is no NormalEncoding";
    if (frame.roughnessEncoding >= RoughnessEncoding::MAX_NUM) return "roughnessEncoding is no RoughnessEncoding";
    for (int i = 0; i < 2; i++)
    {
        if (common.rectSize[i] == 0) return text("common.rectSize[%d] is 0, must be at least 1", i);
        if (common.rectOrigin[i] + common.rectSize[i] > common.resourceSize[i])
            return text("common.rectOrigin + rectSize is %d in component %d, must be at most resourceSize %d",
                        common.rectOrigin[i] + common.rectSize[i], i, common.resourceSize[i]);
    }
    return {};
}

Checks makeChecks()
{
    Checks checks;
    addSettingsChecks(checks);
    addValueChecks(checks);
    addNormalChecks(checks);
    addRoughnessChecks(checks);
    addMotionChecks(checks);
    addHitDistanceChecks(checks);
    addDemodulationChecks(checks);
    return checks;
}

// What follows from one fault is no second one: a rule rests when another has found what it builds upon to be wrong.
struct Dependence
{
    DoctorRule rule;
    std::vector<DoctorRule> foundations;
};
const std::vector<Dependence>& dependences()
{
    using R = DoctorRule;
    static const std::vector<Dependence> kDependences = {
        {R::SKY_IN_RANGE, {R::VIEWZ_ENCODING}},
        {R::NORMAL_ENCODING, {R::VIEWZ_ENCODING}},
        {R::NORMAL_SPACE, {R::VIEWZ_ENCODING}},
        {R::ROUGHNESS_ENCODING, {R::VIEWZ_ENCODING, R::NORMAL_ENCODING, R::NORMAL_SPACE}},
        {R::MOTION, {R::VIEWZ_ENCODING, R::JITTER_IN_MATRIX}},
        {R::MOTION_DEPTH, {R::VIEWZ_ENCODING}},
        {R::JITTER_IN_MOTION, {R::VIEWZ_ENCODING, R::JITTER_IN_MATRIX}},
        {R::HIT_DISTANCE_PRIMARY, {R::VIEWZ_ENCODING, R::NORMAL_ENCODING, R::HIT_DISTANCE_SCALE}},
        {R::HIT_DISTANCE_CONSTANT, {R::HIT_DISTANCE_SCALE}},
        {R::ALBEDO_IN_RADIANCE, {R::VIEWZ_ENCODING, R::NORMAL_ENCODING}},
    };
    return kDependences;
}

bool isFounded(const Report& report, const Reports& all)
{
    for (const Dependence& dependence : dependences())
        for (const DoctorRule foundation : dependence.foundations)
            if (dependence.rule == report.rule &&
                std::any_of(all.begin(), all.end(), [&](const Report& r) { return r.rule == foundation; }))
                return false;
    return true;
}

bool isNextOf(const Frame& frame, const Frame& before)
{
    const CommonSettings& a = before.common();
    const CommonSettings& b = frame.common();
    // A frame index that stands still is a finding of its own, and no reason to look away.
    const bool isNext = b.frameIndex == a.frameIndex + 1 || b.frameIndex == a.frameIndex;
    return isNext && b.accumulationMode == AccumulationMode::CONTINUE;
}
} // namespace
} // namespace doctor

struct InputDoctor::Impl
{
    doctor::Checks checks = doctor::makeChecks();
    std::optional<doctor::Frame> before;
    uint32_t frameCount = 0;
    doctor::Reports reports;
    std::vector<Finding> findings;
    std::string message;

    void look(const DoctorFrame& input)
    {
        doctor::Frame frame(input);
        const bool isPair = before && doctor::isNextOf(frame, *before);
        for (const std::unique_ptr<doctor::Check>& check : checks) check->look(frame, isPair ? &*before : nullptr);
        frame.dropImages();
        before = std::move(frame);
        frameCount++;
    }

    void collect()
    {
        reports.clear();
        findings.clear();
        doctor::Reports all;
        for (const std::unique_ptr<doctor::Check>& check : checks) check->report(all);
        std::copy_if(all.begin(), all.end(), std::back_inserter(reports),
                     [&](const doctor::Report& report) { return doctor::isFounded(report, all); });
        std::stable_sort(reports.begin(), reports.end(),
                         [](const doctor::Report& a, const doctor::Report& b) { return a.severity > b.severity; });
        for (const doctor::Report& report : reports)
            findings.push_back(
                {report.rule, report.severity, report.slot, static_cast<float>(report.evidence), report.text.c_str()});
    }
};

const char* toString(DoctorRule rule)
{
    switch (rule)
    {
    case DoctorRule::FRAME_INDEX:
        return "FRAME_INDEX";
    case DoctorRule::PREVIOUS_CAMERA:
        return "PREVIOUS_CAMERA";
    case DoctorRule::JITTER_IN_MATRIX:
        return "JITTER_IN_MATRIX";
    case DoctorRule::NON_FINITE:
        return "NON_FINITE";
    case DoctorRule::NEGATIVE_RADIANCE:
        return "NEGATIVE_RADIANCE";
    case DoctorRule::SKY_IN_RANGE:
        return "SKY_IN_RANGE";
    case DoctorRule::VIEWZ_ENCODING:
        return "VIEWZ_ENCODING";
    case DoctorRule::NORMAL_ENCODING:
        return "NORMAL_ENCODING";
    case DoctorRule::NORMAL_SPACE:
        return "NORMAL_SPACE";
    case DoctorRule::ROUGHNESS_ENCODING:
        return "ROUGHNESS_ENCODING";
    case DoctorRule::MOTION:
        return "MOTION";
    case DoctorRule::MOTION_DEPTH:
        return "MOTION_DEPTH";
    case DoctorRule::JITTER_IN_MOTION:
        return "JITTER_IN_MOTION";
    case DoctorRule::HIT_DISTANCE_PRIMARY:
        return "HIT_DISTANCE_PRIMARY";
    case DoctorRule::HIT_DISTANCE_CONSTANT:
        return "HIT_DISTANCE_CONSTANT";
    case DoctorRule::HIT_DISTANCE_SCALE:
        return "HIT_DISTANCE_SCALE";
    case DoctorRule::ALBEDO_IN_RADIANCE:
        return "ALBEDO_IN_RADIANCE";
    case DoctorRule::MAX_NUM:
        break;
    }
    return "UNKNOWN";
}

InputDoctor::InputDoctor() = default;
InputDoctor::~InputDoctor() = default;
InputDoctor::InputDoctor(InputDoctor&&) noexcept = default;
InputDoctor& InputDoctor::operator=(InputDoctor&&) noexcept = default;

Result InputDoctor::AddFrame(const DoctorFrame& frame)
try
{
    if (!m_impl) m_impl = std::make_unique<Impl>();
    std::string error = doctor::findError(frame);
    m_impl->message = std::move(error);
    if (!m_impl->message.empty()) return Result::INVALID_ARGUMENT;
    m_impl->look(frame);
    return Result::SUCCESS;
}
catch (const std::exception&) // memory of the host
{
    if (m_impl) m_impl->message = "out of memory"; // short enough to need none
    return Result::FAILURE;
}

Result InputDoctor::GetFindings(const Finding*& findings, uint32_t& findingsNum)
try
{
    findings = nullptr;
    findingsNum = 0;
    if (!m_impl) return Result::SUCCESS;
    m_impl->collect();
    findings = m_impl->findings.data();
    findingsNum = static_cast<uint32_t>(m_impl->findings.size());
    return Result::SUCCESS;
}
catch (const std::exception&)
{
    m_impl->message = "out of memory";
    return Result::FAILURE;
}

uint32_t InputDoctor::GetFrameNum() const { return m_impl ? m_impl->frameCount : 0; }
void InputDoctor::Reset() { m_impl.reset(); }
const char* InputDoctor::GetLastMessage() const { return m_impl ? m_impl->message.c_str() : ""; }
} // namespace nrd
