// The cavity's shadow against double precision, and in the cases whose answer is known.
#include "catch.h"
#include "function_runner.h"
#include "functions.h"
#include "lobes.h"

using namespace nrdtest;

namespace
{
double acosApprox(double x)
{
    const double a = std::min(std::abs(x), 1.0), positive = (kPi / 2.0 - 0.156583 * a) * std::sqrt(1.0 - a);
    return x < 0.0 ? kPi - positive : positive;
}

double expectedShadow(double cavity, double nol, double lightCos, double strength)
{
    const double openingCos = std::sqrt(cavity), rA = acosApprox(openingCos), rB = acosApprox(lightCos);
    const double t = acosApprox(nol), smaller = 1.0 - std::max(openingCos, lightCos);
    double visible = 0.0;
    if (t <= std::abs(rA - rB))
        visible = smaller;
    else if (t < rA + rB)
    {
        const double s = 1.0 - saturated((t - std::abs(rA - rB)) / (rA + rB - std::abs(rA - rB)));
        visible = s * s * (3.0 - 2.0 * s) * smaller;
    }
    return lerp(1.0, saturated(visible / (1.0 - lightCos)), strength);
}

// Grey lobe towards an axis at the given cosine from the normal.
Arguments cavityAt(double cavity, double nol, double lightCos, double strength)
{
    return {{1, 0, 0, 0},
            {float(std::sqrt(1.0 - nol * nol)), 0, float(nol), 0},
            {0, 0, 1, float(cavity)},
            {float(lightCos), float(strength), 0, 0}};
}
} // namespace

TEST_CASE("the cavity's shadow agrees with double precision", "[gpu]")
{
    std::mt19937 rng(51);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    std::vector<Arguments> in;
    std::vector<std::array<double, 2>> expected;
    for (int i = 0; i < 2000; i++)
    {
        const double cavity = unit(rng), nol = 2.0 * unit(rng) - 1.0, lightCos = 0.95 * unit(rng), strength = unit(rng);
        in.push_back(cavityAt(cavity, nol, lightCos, strength));
        expected.push_back({expectedShadow(cavity, nol, lightCos, strength), expectedShadow(cavity, nol, 0.707, 0.85)});
    }
    const std::vector<Results> out = runFunction(FN_CAVITY, in);
    for (size_t i = 0; i < in.size(); i++)
        for (size_t c = 0; c < 2; c++) CHECK(out[i].first[c] == Approx(expected[i][c]).margin(1e-4));
}

TEST_CASE("open cavities let light in, closed ones and light from behind do not", "[gpu]")
{
    const auto shadow = [](double cavity, double nol)
    { return runFunction(FN_CAVITY, cavityAt(cavity, nol, 0.707, 1.0)).first[0]; };
    CHECK(shadow(0.0, 1.0) == Approx(1.0f).margin(1e-6));
    CHECK(shadow(0.2, 1.0) ==
          Approx(1.0f).margin(1e-6)); // devices round the last bit differently // the light fits through the opening
    CHECK(shadow(1.0, 1.0) == 0.0f);
    CHECK(shadow(0.5, -1.0) == 0.0f);
    CHECK(shadow(0.0, 0.3) > shadow(0.5, 0.3));
    CHECK(shadow(0.5, 0.3) > shadow(0.9, 0.3));
    Arguments none = cavityAt(0.9, 0.3, 0.707, 1.0);
    none.b = {};
    CHECK(runFunction(FN_CAVITY, none).first[0] == 1.0f);                         // nobody knows where from
    CHECK(runFunction(FN_CAVITY, cavityAt(0.5, 0.3, 1.0, 1.0)).first[0] >= 0.0f); // a light cone without width
}
