// Radiance that still carries albedo: across a texture's edges on a flat surface the light is the same on both sides,
// so the radiance must be too, in the mean.
#include "check.h"

namespace nrd::doctor
{
namespace
{
struct Lobe
{
    ResourceType slot;
    const float* DoctorFrame::*image;
    const float* DoctorFrame::*factor;
    const char* factorName;
    double roughnessStep; // the most across an edge: specular light changes with roughness, diffuse light does not
};
constexpr Lobe kLobes[] = {
    {ResourceType::IN_DIFF_RADIANCE_HITDIST, &DoctorFrame::diffuse, &DoctorFrame::diffuseFactor, "diffuse", 1.0},
    {ResourceType::IN_SPEC_RADIANCE_HITDIST, &DoctorFrame::specular, &DoctorFrame::specularFactor, "specular", 0.02},
};

class DemodulationCheck final : public Check
{
public:
    explicit DemodulationCheck(const Lobe& lobe) : m_lobe(lobe) {}

    void look(const Frame& frame, const Frame*) override
    {
        const DoctorFrame& input = frame.input();
        if (!(input.*m_lobe.image) || !(input.*m_lobe.factor) || !input.normalRoughness) return;
        const double limit = findLimit(frame);
        for (int y = 0; y < frame.height(); y++)
            for (int x = 0; x + kReach < frame.width(); x++)
            {
                lookAtPair(frame, x, y, x + kReach, y, limit);
                if (y + kReach < frame.height()) lookAtPair(frame, x, y, x, y + kReach, limit);
            }
    }

    void report(Reports& reports) const override
    {
        if (m_pairs < kLeastPairs || !(m_bright.sum > 0.0) || !(m_dark.sum > 0.0)) return;
        const double pairs = static_cast<double>(m_pairs);
        const double contrast = m_contrast / pairs;
        const double slope = std::log(m_bright.sum / m_dark.sum) / contrast;
        const double error = std::hypot(m_bright.relativeError(pairs), m_dark.relativeError(pairs)) / contrast;
        if (slope - kDeviations * error < kLeastSlope) return;
        reports.push_back({DoctorRule::ALBEDO_IN_RADIANCE, FindingSeverity::FAULT, m_lobe.slot, slope,
                           text("%s follows the %s factor across the edges of textures (slope %.2f of logarithms, 0 is "
                                "right, 1 is not demodulated): divide radiance by the factor before packing",
                                toString(m_lobe.slot), m_lobe.factorName, slope)});
    }

private:
    static constexpr int kReach = 2; // pixels: over an edge that is smoothed
    static constexpr uint64_t kLeastPairs = 200;
    static constexpr double kLeastSlope = 0.35;
    static constexpr double kDeviations = 2.0;    // standard ones
    static constexpr double kLeastContrast = 0.3; // logarithm
    static constexpr double kLeastFactor = 0.03;

    struct Sum
    {
        double sum = 0.0, squares = 0.0;
        void add(double value)
        {
            sum += value;
            squares += value * value;
        }
        double relativeError(double count) const { return std::sqrt(std::max(squares - sum * sum / count, 0.0)) / sum; }
    };

    // Fireflies say nothing about textures: the clamp is the same on both sides.
    double findLimit(const Frame& frame) const
    {
        std::vector<double> lumas;
        forSamples(frame, [&](int x, int y) { lumas.push_back(luma(frame, x, y)); });
        return quantile(std::move(lumas), 0.98);
    }

    double luma(const Frame& frame, int x, int y) const
    {
        const double y0 = double(frame.signal(frame.input().*m_lobe.image, x, y)[0]);
        return std::isfinite(y0) ? std::max(y0, 0.0) : 0.0;
    }

    bool isFlat(const Frame& frame, int x0, int y0, int x1, int y1) const
    {
        if (!frame.isSurface(x0, y0) || !frame.isSurface(x1, y1)) return false;
        const Vec3 normal = frame.normal(x0, y0);
        if (dot(normal, frame.normal(x1, y1)) < 0.9995) return false;
        if (std::abs(frame.roughness(x0, y0) - frame.roughness(x1, y1)) > m_lobe.roughnessStep) return false;
        const Vec3 way = frame.position(x1, y1) - frame.position(x0, y0);
        return std::abs(dot(normal, way)) < 0.05 * length(way);
    }

    void lookAtPair(const Frame& frame, int x0, int y0, int x1, int y1, double limit)
    {
        const double a = lumaOfRgb(frame.signal(frame.input().*m_lobe.factor, x0, y0));
        const double b = lumaOfRgb(frame.signal(frame.input().*m_lobe.factor, x1, y1));
        if (!(std::min(a, b) > kLeastFactor)) return; // nothing left to see, or no lobe
        const double contrast = std::abs(std::log(a / b));
        if (contrast < kLeastContrast || !isFlat(frame, x0, y0, x1, y1)) return;
        const double first = std::min(luma(frame, x0, y0), limit), second = std::min(luma(frame, x1, y1), limit);
        m_bright.add(a > b ? first : second);
        m_dark.add(a > b ? second : first);
        m_contrast += contrast;
        m_pairs++;
    }

    Lobe m_lobe;
    Sum m_bright, m_dark; // radiance on either side
    double m_contrast = 0.0;
    uint64_t m_pairs = 0;
};
} // namespace

void addDemodulationChecks(Checks& checks)
{
    for (const Lobe& lobe : kLobes) checks.push_back(std::make_unique<DemodulationCheck>(lobe));
}
} // namespace nrd::doctor
