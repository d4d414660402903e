// Roughness against the directions that the specular paths took: microfacet normals spread as GGX of that roughness
// says, so that the likelihood of what was seen tells which encoding was meant.
#include "check.h"
#include "ggx.h"

namespace nrd::doctor
{
namespace
{
struct Hypothesis
{
    double (*meant)(double given);
    const char* text;
};
constexpr Hypothesis kHypotheses[] = {
    {[](double r) { return r; }, ""},
    {[](double r) { return std::sqrt(r); },
     "its square root, so that what is stored is GGX alpha: pack the linear (perceptual) roughness, or create the "
     "instance with RoughnessEncoding::SQ_LINEAR"},
    {[](double r) { return r * r; },
     "its square, so that what is stored is the square root of linear roughness: pack the linear (perceptual) one, or "
     "create the instance with RoughnessEncoding::SQRT_LINEAR"},
    {[](double r) { return 1.0 - r; }, "one minus it, so that what is stored is smoothness: pack 1 - smoothness"},
};
constexpr size_t kHypothesisCount = std::size(kHypotheses);

class RoughnessCheck final : public Check
{
public:
    void look(const Frame& frame, const Frame*) override
    {
        if (!frame.input().normalRoughness || !frame.input().specularDirection) return;
        const Ggx& ggx = Ggx::get();
        double sums[kHypothesisCount] = {};
        size_t count = 0;
        forSamples(frame,
                   [&](int x, int y)
                   {
                       HalfVector half;
                       if (!findHalfVector(frame, x, y, half)) return;
                       const double roughness = frame.roughness(x, y);
                       if (!(roughness > 0.02) || roughness > 0.97) return; // every encoding says the same
                       const double given = ggx.logDensity(half, roughness);
                       for (size_t i = 1; i < kHypothesisCount; i++)
                       {
                           const double gain = ggx.logDensity(half, kHypotheses[i].meant(roughness)) - given;
                           sums[i] += std::clamp(gain, -kMostGain, kMostGain); // one outlier decides nothing
                       }
                       count++;
                   });
        if (count < kLeastSamples) return;
        for (size_t i = 1; i < kHypothesisCount; i++) m_gains[i].add(sums[i] / static_cast<double>(count));
    }

    void report(Reports& reports) const override
    {
        size_t best = 1;
        for (size_t i = 2; i < kHypothesisCount; i++)
            if (m_gains[i].value() > m_gains[best].value()) best = i;
        const double gain = m_gains[best].value();
        if (!(gain > kLeastGain)) return;
        reports.push_back({DoctorRule::ROUGHNESS_ENCODING, FindingSeverity::FAULT, ResourceType::IN_NORMAL_ROUGHNESS,
                           gain,
                           text("the directions of specular paths spread as if roughness were not what is stored "
                                "(likelihood ratio e^%.2f per pixel) but %s",
                                gain, kHypotheses[best].text)});
    }

private:
    static constexpr size_t kLeastSamples = 300; // in a frame
    static constexpr double kMostGain = 3.0;
    static constexpr double kLeastGain = 0.05;

    static bool findHalfVector(const Frame& frame, int x, int y, HalfVector& half)
    {
        const Vec3 direction = toVec3(frame.signal(frame.input().specularDirection, x, y));
        if (!(length(direction) > 0.5)) return false; // no specular path here
        const Vec3 normal = frame.normal(x, y);
        const Vec3 toCamera = frame.camera().toCamera(frame.position(x, y));
        const Vec3 middle = normalize(normalize(direction) + toCamera);
        const double sine = length(cross(normal, middle));
        half = {dot(normal, toCamera), dot(normal, middle), sine * sine};
        return half.cosView > 0.1 && dot(normal, direction) > 0.0 && half.cosHalf > 0.0;
    }

    Series m_gains[kHypothesisCount]; // mean logarithm of the likelihood ratio
};
} // namespace

void addRoughnessChecks(Checks& checks) { checks.push_back(std::make_unique<RoughnessCheck>()); }
} // namespace nrd::doctor
