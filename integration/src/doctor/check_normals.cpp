// Normals against the depths' own, under every hypothesis about what went wrong. The one that explains them is named.
#include "check.h"
#include "depth_normal.h"
#include <array>

namespace nrd::doctor
{
namespace
{
constexpr double kLeastAngle = 4.0;    // degrees
constexpr double kClearly = 1.0 / 3.0; // how much smaller the error of a better hypothesis is
constexpr double kMostAngle = 60.0;    // degrees; what is farther off is wrong, no matter how far
constexpr double kToDegrees = 57.29577951308232;
constexpr size_t kLeastSamples = 300; // in a frame

// What the texel may be instead, decoded with its length; then what space the vector may be in.
enum class Code : uint8_t
{
    AsSaid,
    Unorm,       // 0.5 n + 0.5
    Snorm,       // n
    Octahedral,  // folded, upper half in the middle
    Octahedral45 // as NRD_FrontEnd_PackNormalAndRoughness does for R10_G10_B10_A2_UNORM
};
enum class Space : uint8_t
{
    World,
    View,
    ViewBackwards, // view space with z the other way round than the matrices have it
    Negated,
    FlippedX,
    FlippedY,
    FlippedZ
};

struct Hypothesis
{
    Code code;
    Space space;
    DoctorRule rule;
    const char* text;
};
constexpr Hypothesis kHypotheses[] = {
    {Code::AsSaid, Space::World, DoctorRule::MAX_NUM, ""},
    {Code::AsSaid, Space::View, DoctorRule::NORMAL_SPACE,
     "are in view space: rotate them to world space with the inverse of worldToViewMatrix"},
    {Code::AsSaid, Space::ViewBackwards, DoctorRule::NORMAL_SPACE,
     "are in a view space with z the other way round than worldToViewMatrix has it: rotate them to world space"},
    {Code::AsSaid, Space::Negated, DoctorRule::NORMAL_SPACE, "point away from the camera: negate them"},
    {Code::AsSaid, Space::FlippedX, DoctorRule::NORMAL_SPACE, "have x flipped: negate x"},
    {Code::AsSaid, Space::FlippedY, DoctorRule::NORMAL_SPACE, "have y flipped: negate y"},
    {Code::AsSaid, Space::FlippedZ, DoctorRule::NORMAL_SPACE, "have z flipped: negate z"},
    {Code::Unorm, Space::World, DoctorRule::NORMAL_ENCODING,
     "are stored as 0.5 * n + 0.5, which the instance's NormalEncoding does not decode: pack them with "
     "NRD_FrontEnd_PackNormalAndRoughness"},
    {Code::Snorm, Space::World, DoctorRule::NORMAL_ENCODING,
     "are stored as they are, which the instance's NormalEncoding does not decode: pack them with "
     "NRD_FrontEnd_PackNormalAndRoughness"},
    {Code::Octahedral, Space::World, DoctorRule::NORMAL_ENCODING,
     "are stored in a folded octahedral map: pack them with NRD_FrontEnd_PackNormalAndRoughness"},
    {Code::Octahedral45, Space::World, DoctorRule::NORMAL_ENCODING,
     "are packed for R10_G10_B10_A2_UNORM: define NRD_NORMAL_ENCODING as the instance's NormalEncoding, or create the "
     "instance with that one"},
};
constexpr size_t kHypothesisCount = std::size(kHypotheses);

Vec3 foldedOctahedral(const Vec3& p)
{
    const double x = 2.0 * p.x - 1.0, y = 2.0 * p.y - 1.0, z = 1.0 - std::abs(x) - std::abs(y);
    if (z >= 0.0) return {x, y, z};
    return {std::copysign(1.0 - std::abs(y), x), std::copysign(1.0 - std::abs(x), y), z};
}

Vec3 decode(Code code, const float* texel, NormalEncoding said)
{
    switch (code)
    {
    case Code::AsSaid:
        return decodeNormal(texel, said);
    case Code::Unorm:
        return decodeNormal(texel, NormalEncoding::RGBA16_UNORM);
    case Code::Snorm:
        return decodeNormal(texel, NormalEncoding::RGBA16_SNORM);
    case Code::Octahedral:
        return foldedOctahedral(toVec3(texel));
    case Code::Octahedral45:
        return decodeNormal(texel, NormalEncoding::R10_G10_B10_A2_UNORM);
    }
    return {};
}

Vec3 toWorld(Space space, const Vec3& n, const Camera& camera)
{
    switch (space)
    {
    case Space::World:
        return n;
    case Space::View:
        return camera.viewToWorld(n);
    case Space::ViewBackwards:
        return camera.viewToWorld({n.x, n.y, -n.z});
    case Space::Negated:
        return -n;
    case Space::FlippedX:
        return {-n.x, n.y, n.z};
    case Space::FlippedY:
        return {n.x, -n.y, n.z};
    case Space::FlippedZ:
        return {n.x, n.y, -n.z};
    }
    return n;
}

double angle(const Vec3& a, const Vec3& b)
{
    return std::min(kToDegrees * std::atan2(length(cross(a, b)), dot(a, b)), kMostAngle);
}

// A mean, since some faults leave most normals as they are: a flipped axis, the view space of a camera that only tilts.
struct Mean
{
    double sum = 0.0;
    size_t count = 0;
    void add(double value)
    {
        if (!std::isfinite(value)) return;
        sum += value;
        count++;
    }
    double value() const { return count < kLeastSamples ? std::nan("") : sum / static_cast<double>(count); }
};

class NormalCheck final : public Check
{
public:
    void look(const Frame& frame, const Frame*) override
    {
        if (!frame.input().normalRoughness) return;
        const bool isOctahedral = frame.input().normalEncoding == NormalEncoding::R10_G10_B10_A2_UNORM;
        std::array<Mean, kHypothesisCount> angles;
        Share outside;
        forSamples(frame,
                   [&](int x, int y)
                   {
                       const float* texel = frame.guide(frame.input().normalRoughness, x, y);
                       if (isOctahedral) outside.add(isOutsideOfOctahedron(texel));
                       const auto depth = [&](int px, int py) { return frame.viewZ(px, py); };
                       const std::optional<Vec3> expected = depthNormal(frame, x, y, depth);
                       if (expected) addAngles(angles, frame, texel, *expected);
                   });
        if (isOctahedral) m_outside.add(outside.value());
        for (size_t i = 0; i < kHypothesisCount; i++) m_angles[i].add(angles[i].value());
    }

    void report(Reports& reports) const override
    {
        size_t best = 0;
        for (size_t i = 1; i < kHypothesisCount; i++)
            if (m_angles[i].value() < m_angles[best].value()) best = i;
        const double given = m_angles[0].value();
        const bool isClear = given > kLeastAngle && m_angles[best].value() < kClearly * given;
        if (isClear)
            add(reports, kHypotheses[best].rule, given,
                text("normals are off the depth's by %.0f degrees; they fit to %.1f degrees if they %s", given,
                     m_angles[best].value(), kHypotheses[best].text));
        else if (m_outside.value() > kMostOutside)
            add(reports, DoctorRule::NORMAL_ENCODING, m_outside.value(),
                text("%.1f %% of the texels of IN_NORMAL_ROUGHNESS are none that an octahedral normal has: pack them "
                     "with NRD_FrontEnd_PackNormalAndRoughness for R10_G10_B10_A2_UNORM",
                     100.0 * m_outside.value()));
    }

private:
    static constexpr double kMostOutside = 0.01;

    static bool isOutsideOfOctahedron(const float* texel)
    {
        constexpr double kRounding = 4.0 / 1023.0;
        const double x = double(texel[0]) - double(texel[1]), y = double(texel[0]) + double(texel[1]) - 1.0;
        return std::abs(x) + std::abs(y) > 1.0 + kRounding;
    }

    static void addAngles(std::array<Mean, kHypothesisCount>& angles, const Frame& frame, const float* texel,
                          const Vec3& expected)
    {
        for (size_t i = 0; i < kHypothesisCount; i++)
        {
            const Vec3 n = decode(kHypotheses[i].code, texel, frame.input().normalEncoding);
            angles[i].add(angle(toWorld(kHypotheses[i].space, normalize(n), frame.camera()), expected));
        }
    }

    static void add(Reports& reports, DoctorRule rule, double evidence, std::string sentence)
    {
        reports.push_back(
            {rule, FindingSeverity::FAULT, ResourceType::IN_NORMAL_ROUGHNESS, evidence, std::move(sentence)});
    }

    Series m_angles[kHypothesisCount]; // degrees
    Series m_outside;
};

// Depth that is not linear bends planes: the normals fit once it is read as what it is.
class ViewZCheck final : public Check
{
public:
    void look(const Frame& frame, const Frame*) override
    {
        if (!frame.input().normalRoughness) return;
        const auto angleUnder = [&](auto&& depth)
        {
            Mean angles;
            forSamples(frame,
                       [&](int x, int y)
                       {
                           const std::optional<Vec3> expected = depthNormal(frame, x, y, depth);
                           if (expected) angles.add(angle(frame.normal(x, y), *expected));
                       });
            return angles.value();
        };
        m_linear.add(angleUnder([&](int x, int y) { return frame.viewZ(x, y); }));
        m_distance.add(angleUnder([&](int x, int y) { return viewZOfDistance(frame, x, y); }));
        m_buffer.add(angleUnder(
            [&](int x, int y)
            {
                const double depth = frame.viewZ(x, y);
                return depth < 1.0 ? frame.camera().viewZOfDepth(depth) : -1.0;
            }));
    }

    void report(Reports& reports) const override
    {
        const double given = m_linear.value();
        const bool isDistance = !(m_buffer.value() < m_distance.value());
        const double best = isDistance ? m_distance.value() : m_buffer.value();
        // Without any smooth surface under the given depth there is nothing to beat.
        const double beaten = std::isfinite(given) ? given : kMostAngle;
        if (!(best < kClearly * beaten) || beaten <= kLeastBend) return;
        reports.push_back(
            {DoctorRule::VIEWZ_ENCODING, FindingSeverity::FAULT, ResourceType::IN_VIEWZ, beaten,
             text("the surfaces of IN_VIEWZ are off the normals by %.0f degrees; they fit to %.1f degrees if it holds "
                  "%s: store linear view depth",
                  beaten, best, isDistance ? "the distance to the camera" : "the values of the depth buffer")});
    }

private:
    static constexpr double kLeastBend = 2.0; // degrees

    static double viewZOfDistance(const Frame& frame, int x, int y)
    {
        const Vec3 ray = frame.positionAt(x, y, 1.0);
        return frame.camera().isOrthographic() ? frame.viewZ(x, y) : frame.viewZ(x, y) / length(ray);
    }

    Series m_linear; // degrees
    Series m_distance;
    Series m_buffer;
};
} // namespace

void addNormalChecks(Checks& checks)
{
    checks.push_back(std::make_unique<NormalCheck>());
    checks.push_back(std::make_unique<ViewZCheck>());
}
} // namespace nrd::doctor
