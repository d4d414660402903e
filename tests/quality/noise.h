// Noisy signals with a known mean.
#pragma once
#include "harness.h"
#include <random>

namespace quality
{
// Luma 0 or 2 * mean with equal chance, so variance is mean^2; hit distance uniform round its mean.
inline Signal makeNoise(size_t count, float mean, unsigned seed)
{
    std::mt19937 rng(seed);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    Signal signal(count);
    for (glm::vec4& v : signal)
    {
        const float luma = unit(rng) < 0.5f ? 0.0f : 2.0f * mean;
        v = glm::vec4(luma, 0.1f * luma, -0.05f * luma, 0.2f + 0.3f * unit(rng));
    }
    return signal;
}
} // namespace quality
