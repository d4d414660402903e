// Small pictures for the tests of the measures.
#pragma once
#include "catch.h"

#include "measures.h"

#include <random>

namespace test
{
inline sample::Picture constant(int width, int height, const std::vector<float>& color)
{
    sample::Picture picture(width, height, color.size());
    for (size_t c = 0; c < color.size(); c++) picture.planes[c].assign(picture.pixelCount(), color[c]);
    return picture;
}

// Independent values in [0; high).
inline sample::Picture noise(int width, int height, size_t planeCount, uint32_t seed, float high = 1.0f)
{
    sample::Picture picture(width, height, planeCount);
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> values(0.0f, high);
    for (auto& plane : picture.planes)
        for (float& v : plane) v = values(random);
    return picture;
}
} // namespace test
