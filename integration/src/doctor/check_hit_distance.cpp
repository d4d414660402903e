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
        std::vector<double> stored, relative;
        forSamples(frame,
                   [&](int x, int y)
                   {
                       const double value = double(frame.signal(frame.input().*m_lobe.image, x, y)[3]);
                       if (!(value > 0.0) || !std::isfinite(value)) return; // no sample here
                       stored.push_back(value);
                       m_tooLong.add(value > 1.001);
                       if (value < 0.99) relative.push_back(distanceOverPrimary(frame, x, y, value));
                   });
        if (stored.size() < kLeastSamples) return;
        m_low.add(quantile(stored, 0.05));
        m_high.add(quantile(stored, 0.95));
        if (relative.size() < kLeastSamples / 2) return;
        m_nearest.add(quantile(relative, 0.002));
        m_near.add(quantile(relative, 0.03));
    }

    void report(Reports& reports) const override
    {
        const char* const slot = toString(m_lobe.slot);
        if (m_tooLong.value() > 0.005)
            add(reports, DoctorRule::HIT_DISTANCE_SCALE, m_tooLong.value(),
                text("%s has hit distances above 1 in %.1f %% of the pixels: divide them by "
                     "REBLUR_FrontEnd_GetNormHitDist with the parameters of ReblurSettings",
                     slot, 100.0 * m_tooLong.value()));
        if (isConstant())
            add(reports, DoctorRule::HIT_DISTANCE_CONSTANT, m_high.value(),
                text("%s has the hit distance %.3g everywhere: store the distance from the surface to what the first "
                     "bounce hits, normalised by REBLUR_FrontEnd_GetNormHitDist",
                     slot, m_high.value()));
        // Something always lies closer to a surface than the camera does, but for paths that start at the camera.
        else if (m_nearest.value() > kSurely && m_near.value() < kTouching)
            add(reports, DoctorRule::HIT_DISTANCE_PRIMARY, m_nearest.value(),
                text("no hit distance of %s is shorter than the way from the camera to the surface (the shortest ones "
                     "are %.2f of it): measure from the primary hit on",
                     slot, m_nearest.value()));
    }

private:
    static constexpr size_t kLeastSamples = 300; // in a frame
    static constexpr double kSurely = 0.97;      // hit distances are rounded to half floats
    static constexpr double kTouching = 1.5;     // walls that meet give distances down to 0 beyond the primary one

    // A specular lobe that only sees sky is 1 everywhere; a diffuse one touches something somewhere.
    bool isConstant() const
    {
        const bool isSame = m_high.value() - m_low.value() <= 2e-3 * m_high.value();
        return isSame && (m_lobe.isDiffuse || m_high.value() < 0.99);
    }

    double distanceOverPrimary(const Frame& frame, int x, int y, double value) const
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
    Series m_low, m_high;     // of the stored values
    Series m_nearest, m_near; // over the distance to the camera
};
} // namespace

void addHitDistanceChecks(Checks& checks)
{
    for (const Lobe& lobe : kLobes) checks.push_back(std::make_unique<HitDistanceCheck>(lobe));
}
} // namespace nrd::doctor
