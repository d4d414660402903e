#include "pictures.h"

#include "flip.h"

#include <algorithm>
#include <cmath>

using namespace sample;
using namespace test;

namespace
{
// A checked, straight implementation of the colour term for constant pictures: the contrast-sensitivity filters have
// sum 1, so that a constant passes through them, and there are no features.
double expectedForConstants(const double (&a)[3], const double (&b)[3])
{
    const auto lab = [](const double(&rgb)[3], double(&result)[3])
    {
        const double x = 0.4123863 * rgb[0] + 0.3575915 * rgb[1] + 0.1804505 * rgb[2];
        const double y = 0.2126368 * rgb[0] + 0.7151830 * rgb[1] + 0.0721802 * rgb[2];
        const double z = 0.0193306 * rgb[0] + 0.1191972 * rgb[1] + 0.9503726 * rgb[2];
        const auto f = [](double t)
        { return t > 0.008856 ? std::cbrt(t) : t / (3 * std::pow(6.0 / 29.0, 2)) + 4.0 / 29.0; };
        const double fx = f(x / 0.9504283), fy = f(y), fz = f(z / 1.0889004);
        result[0] = 116 * fy - 16;
        result[1] = 0.01 * result[0] * 500 * (fx - fy);
        result[2] = 0.01 * result[0] * 200 * (fy - fz);
    };
    const auto distance = [&](const double(&p)[3], const double(&q)[3])
    {
        double l[3], m[3];
        lab(p, l);
        lab(q, m);
        return std::abs(l[0] - m[0]) + std::hypot(l[1] - m[1], l[2] - m[2]);
    };
    const double green[3] = {0, 1, 0}, blue[3] = {0, 0, 1};
    const double maximum = std::pow(distance(green, blue), 0.7);
    const double error = std::pow(distance(a, b), 0.7);
    const double knee = 0.4 * maximum;
    return error < knee ? error / knee * 0.95 : 0.95 + (error - knee) / (maximum - knee) * 0.05;
}

double flipOf(const std::vector<float>& a, const std::vector<float>& b)
{
    return sample::flip(constant(40, 40, a), constant(40, 40, b), {});
}
} // namespace

TEST_CASE("FLIP of constant pictures is the paper's colour distance", "[unit]")
{
    const double colors[][3] = {{0, 0, 0}, {1, 1, 1}, {0.5, 0.5, 0.5}, {1, 0, 0}, {0.2, 0.7, 0.1}, {0.05, 0.02, 0.9}};
    for (const auto& a : colors)
    {
        for (const auto& b : colors)
        {
            const std::vector<float> fa(a, a + 3), fb(b, b + 3);
            INFO(a[0] << " " << a[1] << " " << a[2] << " against " << b[0] << " " << b[1] << " " << b[2]);
            CHECK(flipOf(fa, fb) == Approx(expectedForConstants(a, b)).epsilon(1e-3).margin(2e-3));
        }
    }
}

TEST_CASE("FLIP has its largest colour error between green and blue, and a known value of black against white",
          "[unit]")
{
    CHECK(flipOf({0, 1, 0}, {0, 0, 1}) == Approx(1.0).epsilon(1e-4));
    // HyAB is 100 against a maximum of 203.4, with the exponent: 25.12 of 41.28, so 0.95 + 8.61 / 24.77 * 0.05.
    CHECK(flipOf({0, 0, 0}, {1, 1, 1}) == Approx(0.96739).margin(1e-4));
}

TEST_CASE("FLIP lies in [0; 1] and does not depend on the order of the pictures", "[unit]")
{
    const Picture a = noise(70, 50, 3, 11);
    const Picture b = noise(70, 50, 3, 12);
    const std::vector<float> ab = flipMap(a, b);
    const std::vector<float> ba = flipMap(b, a);
    CHECK(ab == ba);
    CHECK(*std::min_element(ab.begin(), ab.end()) >= 0.0f);
    CHECK(*std::max_element(ab.begin(), ab.end()) <= 1.0f);
    CHECK(*std::max_element(ab.begin(), ab.end()) > 0.1f);
}

TEST_CASE("FLIP weighs a lone firefly more than its energy spread out", "[unit]")
{
    const Picture reference = constant(61, 61, {0.2f, 0.2f, 0.2f});
    Picture point = reference;
    for (auto& plane : point.planes) plane[30 * 61 + 30] = 1.0f;
    Picture spread = reference;
    const float share = 0.8f / (21.0f * 21.0f);
    for (auto& plane : spread.planes)
        for (size_t y = 20; y <= 40; y++)
            for (size_t x = 20; x <= 40; x++) plane[y * 61 + x] += share;
    const std::vector<float> map = flipMap(reference, point);
    const std::vector<float> spreadMap = flipMap(reference, spread);
    CHECK(map[30 * 61 + 30] > 5.0f * spreadMap[30 * 61 + 30]);
    CHECK(map[0] == 0.0f); // far from it nothing is seen
    CHECK(std::max_element(map.begin(), map.end()) - map.begin() == 30 * 61 + 30);
}

TEST_CASE("FLIP does not depend on orientation", "[unit]")
{
    const Picture a = noise(48, 48, 3, 13);
    const Picture b = noise(48, 48, 3, 14);
    const auto transposed = [](const Picture& p)
    {
        Picture result(p.height, p.width, 3);
        for (size_t c = 0; c < 3; c++)
            for (size_t y = 0; y < 48; y++)
                for (size_t x = 0; x < 48; x++) result.planes[c][x * 48 + y] = p.planes[c][y * 48 + x];
        return result;
    };
    CHECK(sample::flip(a, b, {}) == Approx(sample::flip(transposed(a), transposed(b), {})).epsilon(1e-5));
}

TEST_CASE("FLIP sees fine detail less from further away", "[unit]")
{
    Picture checker(64, 64, 3);
    for (auto& plane : checker.planes)
        for (size_t i = 0; i < plane.size(); i++) plane[i] = (i % 64 + i / 64) % 2 ? 0.55f : 0.45f;
    const Picture flat = constant(64, 64, {0.5f, 0.5f, 0.5f});
    const auto mean = [&](double pixelsPerDegree)
    {
        double sum = 0.0;
        for (float v : flipMap(flat, checker, pixelsPerDegree)) sum += v;
        return sum / (64.0 * 64.0);
    };
    CHECK(mean(10.0) > 1.5 * mean(kFlipPixelsPerDegree));
}
