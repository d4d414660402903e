// Hit distances: normalised, from the surface on, and not all the same.
#include "check.h"

namespace nrd::doctor
{
namespace
{
struct Lobe
{
    ResourceType slot;
    const float* DoctorFrame::*image;
    bool isDiffuse;
};
constexpr Lobe kLobes[] = {
    {ResourceType::IN_DIFF_RADIANCE_HITDIST, &DoctorFrame::diffuse, true},
    {ResourceType::IN_SPEC_RADIANCE_HITDIST, &DoctorFrame::specular, false},
};

class HitDistanceCheck final : public Check
{
public:
    explicit HitDistanceCheck(const Lobe& lobe) : m_lobe(lobe) {}

    void look(const Frame& frame, const Frame*) override
    {
        if (!(frame.input().*m_lobe.image)) return;
        std::vector<double> stored;
        forSamples(frame,
                   [&](int x, int y)
                   {
                       const double value = double(frame.signal(frame.input().*m_lobe.image, x, y)[3]);
                       if (!(value > 0.0) || !std::isfinite(value)) return; // no sample here
                       stored.push_back(value);
                       m_tooLong.add(value > 1.001);
                       m_ended.add(value < kSaturated);
                       if (m_lobe.isDiffuse) m_corners.add(isCorner(frame, x, y));
                       if (value >= kSaturated) return;
                       const double ratio = distanceOverDepth(frame, x, y, value);
                       m_shorter.add(ratio < kSurely);
                       m_touching.add(ratio < kTouching);
                   });
        if (stored.size() < kLeastSamples) return;
        m_low.add(quantile(stored, 0.05));
        m_high.add(quantile(stored, 0.95));
    }

    void report(Reports& reports) const override
    {
        const char* const slot = toString(m_lobe.slot);
        if (m_tooLong.value() > 0.005)
            add(reports, DoctorRule::HIT_DISTANCE_SCALE, m_tooLong.value(),
                text("%s has hit distances above 1 in %.1f %% of the pixels: divide them by "
                     "REBLUR_FrontEnd_GetNormHitDist with the parameters of ReblurSettings",
                     slot, 100.0 * m_tooLong.value()));
        const bool isConstant = m_high.value() - m_low.value() <= kSame * m_high.value();
        if (isConstant && m_high.value() < kSaturated)
            add(reports, DoctorRule::HIT_DISTANCE_CONSTANT, m_high.value(),
                text("%s has the hit distance %.3g everywhere: store the distance from the surface to what the first "
                     "bounce hits, normalised by REBLUR_FrontEnd_GetNormHitDist",
                     slot, m_high.value()));
        // Something always lies closer to a surface than the camera does, but for paths that start at the camera.
        else if (m_shorter.total > kLeastSamples && m_shorter.value() < kRarely && m_touching.value() > kSometimes)
            add(reports, DoctorRule::HIT_DISTANCE_PRIMARY, m_shorter.value(),
                text("only %.2f %% of the hit distances of %s are shorter than the way from the camera to the surface, "
                     "and %.0f %% just longer: measure from the primary hit on",
                     100.0 * m_shorter.value(), slot, 100.0 * m_touching.value()));
        else if (isConstant && m_ended.value() < kHardly && m_corners.value() > kManyCorners)
            add(reports, DoctorRule::HIT_DISTANCE_CONSTANT, m_high.value(),
                text("%s has the hit distance 1 everywhere, which stands for all that is long: measure from the "
                     "primary hit on, not from the camera, and choose hitDistanceParameters in the scene's units",
                     slot));
    }

private:
    static constexpr size_t kLeastSamples = 300; // in a frame
    static constexpr double kSaturated = 0.99;   // of the stored value, which ends at 1
    static constexpr double kSurely = 0.97;      // of the depth; hit distances are rounded to half floats
    static constexpr double kRarely = 0.002;
    static constexpr double kTouching = 1.5; // of the depth: beyond the camera's, walls that meet give any down to 0
    static constexpr double kSometimes = 0.03;
    static constexpr double kSame = 2e-3;
    static constexpr double kHardly = 1e-3;
    static constexpr double kManyCorners = 0.01; // otherwise one convex body may float in the sky

    // Whether a surface near it in the picture stands in the way of what the pixel sees, well within the range.
    bool isCorner(const Frame& frame, int x, int y) const
    {
        constexpr int kSteps[][2] = {{-24, 0}, {24, 0}, {0, -24}, {0, 24}, {-8, 0}, {8, 0}, {0, -8}, {0, 8}};
        if (!frame.input().normalRoughness) return false;
        const Vec3 position = frame.position(x, y), normal = frame.normal(x, y);
        const double range = hitDistanceRange(frame.viewZ(x, y), frame.input().hitDistanceParameters, 1.0);
        for (const auto& [dx, dy] : kSteps)
        {
            if (!frame.contains(x + dx, y + dy) || !frame.isSurface(x + dx, y + dy)) continue;
            const Vec3 way = frame.position(x + dx, y + dy) - position;
            const double distance = length(way);
            if (distance < 0.5 * range && dot(normal, way) > 0.3 * distance) return true;
        }
        return false;
    }

    double distanceOverDepth(const Frame& frame, int x, int y, double value) const
    {
        const bool hasRoughness = frame.input().normalRoughness != nullptr;
        const double roughness = m_lobe.isDiffuse || !hasRoughness ? 1.0 : frame.roughness(x, y);
        const double z = frame.viewZ(x, y);
        // What is added by mistake is the distance to the camera, or the depth, which is shorter.
        return value * hitDistanceRange(z, frame.input().hitDistanceParameters, roughness) / z;
    }

    void add(Reports& reports, DoctorRule rule, double evidence, std::string sentence) const
    {
        reports.push_back({rule, FindingSeverity::FAULT, m_lobe.slot, evidence, std::move(sentence)});
    }

    Lobe m_lobe;
    Share m_tooLong;
    Series m_low, m_high; // of the stored values
    Share m_ended;        // before the longest distance that is kept
    Share m_corners;      // pixels that see another surface nearby
    Share m_shorter;      // than the depth, of those that end somewhere
    Share m_touching;     // short but for that
};
} // namespace

void addHitDistanceChecks(Checks& checks)
{
    for (const Lobe& lobe : kLobes) checks.push_back(std::make_unique<HitDistanceCheck>(lobe));
}
} // namespace nrd::doctor
