// Roughness against the directions that the specular paths took: microfacet normals spread as GGX of that roughness
// says, so that the likelihood of what was seen tells which encoding was meant.
#include "check.h"

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

struct Sample
{
    double cosView = 0.0;   // normal and camera
    double cosHalf = 0.0;   // normal and microfacet normal
    double sin2Half = 0.0;  // squared sine of that angle, which near 0 a cosine does not tell
    double roughness = 0.0; // as given
};

// Logarithm of the density of visible normals (Heitz 2014), but for what does not depend on roughness.
double logDensity(const Sample& sample, double roughness)
{
    const double alpha = std::max(roughness * roughness, 4e-3); // below it the normal's rounding decides
    const double a2 = alpha * alpha;
    const double spread = sample.sin2Half / a2 + sample.cosHalf * sample.cosHalf;
    const double tan2 = 1.0 / (sample.cosView * sample.cosView) - 1.0;
    const double masking = 2.0 / (1.0 + std::sqrt(1.0 + a2 * tan2));
    return std::log(masking) - std::log(a2) - 2.0 * std::log(spread);
}

class RoughnessCheck final : public Check
{
public:
    void look(const Frame& frame, const Frame*) override
    {
        if (!frame.input().normalRoughness || !frame.input().specularDirection) return;
        double sums[kHypothesisCount] = {};
        size_t count = 0;
        forSamples(frame,
                   [&](int x, int y)
                   {
                       Sample sample;
                       if (!findSample(frame, x, y, sample)) return;
                       const double given = logDensity(sample, sample.roughness);
                       for (size_t i = 1; i < kHypothesisCount; i++)
                       {
                           const double gain = logDensity(sample, kHypotheses[i].meant(sample.roughness)) - given;
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

    static bool findSample(const Frame& frame, int x, int y, Sample& sample)
    {
        const Vec3 direction = toVec3(frame.signal(frame.input().specularDirection, x, y));
        if (!(length(direction) > 0.5)) return false; // no specular path here
        const Vec3 normal = frame.normal(x, y);
        const Vec3 toCamera = frame.camera().toCamera(frame.position(x, y));
        const Vec3 half = normalize(normalize(direction) + toCamera);
        const double sine = length(cross(normal, half));
        sample = {dot(normal, toCamera), dot(normal, half), sine * sine, frame.roughness(x, y)};
        const bool isTelling = sample.roughness > 0.02 && sample.roughness < 0.97;
        return isTelling && sample.cosView > 0.1 && dot(normal, direction) > 0.0 && sample.cosHalf > 0.0;
    }

    Series m_gains[kHypothesisCount]; // mean logarithm of the likelihood ratio
};
} // namespace

void addRoughnessChecks(Checks& checks) { checks.push_back(std::make_unique<RoughnessCheck>()); }
} // namespace nrd::doctor
