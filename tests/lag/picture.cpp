#include "picture.h"
#include <cmath>
#include <random>

namespace lag
{
quality::Signal makePathNoise(const Means& means, unsigned seed)
{
    std::mt19937 rng(seed);
    const float variance = std::log(2.0f); // of the logarithm, for a relative variance of 1
    std::normal_distribution<float> logarithm(-0.5f * variance, std::sqrt(variance));
    std::uniform_real_distribution<float> hitDist(0.2f, 0.5f);
    quality::Signal signal;
    for (const float mean : means)
    {
        const float luma = mean * std::exp(logarithm(rng));
        signal.emplace_back(luma, luma, luma, hitDist(rng));
    }
    return signal;
}

double toneMap(double luminance)
{
    const double x = std::isfinite(luminance) && luminance > 0.0 ? luminance / (1.0 + luminance) : 0.0;
    return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
}

double pictureError(const quality::Signal& picture, const Means& means, const IsCounted& isCounted)
{
    double sum = 0.0, count = 0.0;
    for (size_t i = 0; i < picture.size(); i++)
    {
        if (!isCounted(i)) continue;
        const double difference = toneMap(double(picture[i].x)) - toneMap(double(means[i]));
        sum += difference * difference;
        count += 1.0;
    }
    return std::sqrt(sum / count);
}
} // namespace lag
