// What the front end has for shadows: penumbrae and their flags, translucency, several lights in one signal.
#include "catch.h"
#include "function_runner.h"
#include "functions.h"
#include <cmath>
#include <limits>
#include <random>

using namespace nrdtest;

namespace
{
constexpr float kLit = 65504.0f, kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

struct Penumbrae
{
    float sun, local;
};

Penumbrae penumbrae(float hitDist, float tangent, float distanceToLight, float size)
{
    const Results r = runFunction(FN_PENUMBRA, {Vec4{hitDist, tangent, distanceToLight, size}});
    return {r.first[0], r.first[1]};
}

Vec4 translucency(float hitDist, Vec4 color) { return runFunction(FN_PENUMBRA, {Vec4{hitDist}, color}).second; }

struct Light
{
    float radiance[3], penumbra, visibility[3];
};

double luminance(const double (&c)[3]) { return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]; }

Arguments argumentsOf(const Light (&lights)[3])
{
    Arguments v;
    Vec4* targets[] = {&v.a, &v.b, &v.c, &v.d, &v.e, &v.f};
    for (int i = 0; i < 3; i++)
    {
        const Light& l = lights[i];
        *targets[2 * i] = {l.radiance[0], l.radiance[1], l.radiance[2], l.penumbra};
        *targets[2 * i + 1] = {l.visibility[0], l.visibility[1], l.visibility[2], 0.0f};
    }
    return v;
}

// The formulas by themselves, for lights that all have every colour.
Results mixOf(const Light (&lights)[3])
{
    double sum[3] = {}, visible[3] = {}, penumbra = 0.0, weight = 0.0;
    for (const Light& l : lights)
    {
        const double own[3] = {l.radiance[0], l.radiance[1], l.radiance[2]};
        for (int c = 0; c < 3; c++) sum[c] += own[c];
        for (int c = 0; c < 3; c++) visible[c] += own[c] * double(l.visibility[c]);
        const double w = l.penumbra > 0.0f && l.penumbra < kLit ? luminance(own) : 0.0;
        penumbra += w * double(l.penumbra);
        weight += w;
    }
    const double color[3] = {visible[0] / sum[0], visible[1] / sum[1], visible[2] / sum[2]};
    const Vec4 packed = {float(luminance(color)), float(color[0]), float(color[1]), float(color[2])};
    return {Vec4{float(weight > 0.0 ? penumbra / weight : double(kLit))}, packed};
}
} // namespace

TEST_CASE("a penumbra is half as wide as similar triangles make it", "[gpu]")
{
    std::mt19937 rng(81);
    std::uniform_real_distribution<float> unit(0.01f, 1.0f);
    for (int i = 0; i < 100; i++)
    {
        const float d = 10.0f * unit(rng), t = unit(rng), D = d + 5.0f * unit(rng), s = unit(rng);
        const Penumbrae p = penumbrae(d, t, D, s);
        CHECK(p.sun == Approx(d * t).epsilon(1e-5));
        CHECK(p.local == Approx(0.5 * s * d / (D - d)).epsilon(1e-3)); // D - d cancels
    }
}

TEST_CASE("a far lamp's penumbra is that of a sun of its angular radius", "[gpu]")
{
    const float radius = 50.0f, distance = 1e4f;
    const Penumbrae p = penumbrae(2.0f, radius / distance, distance, 2.0f * radius);
    CHECK(p.local == Approx(p.sun).epsilon(1e-3));
}

TEST_CASE("a penumbra's flags can't be mistaken for sizes", "[gpu]")
{
    const Penumbrae contact = penumbrae(1e-9f, 0.005f, 10.0f, 1.0f), wide = penumbrae(60000.0f, 10.0f, 60000.0f, 5.0f);
    CHECK((contact.sun == 1e-4f && contact.local == 1e-4f));
    CHECK((wide.sun == 32768.0f && wide.local == 32768.0f));
    for (const float miss : {65504.0f, 1e30f, kInfinity, kNan})
    {
        const Penumbrae p = penumbrae(miss, 0.005f, 10.0f, 1.0f);
        CHECK((p.sun == kLit && p.local == kLit));
    }
    for (const float turnedAway : {0.0f, -1.0f, -kInfinity})
    {
        const Penumbrae p = penumbrae(turnedAway, 0.005f, 10.0f, 1.0f);
        CHECK((p.sun == 0.0f && p.local == 0.0f));
    }
}

TEST_CASE("a light of no size, or of none that makes sense, casts a hard shadow", "[gpu]")
{
    for (const float size : {0.0f, -1.0f, kNan})
    {
        const Penumbrae p = penumbrae(2.0f, size, 10.0f, size);
        CHECK((p.sun == 1e-4f && p.local == 1e-4f));
    }
    CHECK(penumbrae(2.0f, 0.1f, 1.0f, 1.0f).local == 32768.0f); // the hit lies behind the lamp
    CHECK(penumbrae(2.0f, 0.1f, kNan, 1.0f).local > 0.0f);
    CHECK(std::isfinite(penumbrae(2.0f, kInfinity, 3.0f, kInfinity).sun));
}

TEST_CASE("translucency says whether something was hit, and what came through", "[gpu]")
{
    CHECK(translucency(3.0f, {0.25f, 0.5f, 1.0f}) == Vec4{0.0f, 0.25f, 0.5f, 1.0f});
    CHECK(translucency(3.0f, {0.0f, 0.0f, 0.0f}) == Vec4{0.0f, 0.0f, 0.0f, 0.0f});
    CHECK(translucency(3.0f, {-1.0f, 2.0f, kNan}) == Vec4{0.0f, 0.0f, 1.0f, 0.0f});
    for (const float miss : {65504.0f, kInfinity, kNan})
        CHECK(translucency(miss, {0.0f, kNan, 0.5f}) == Vec4{1.0f, 1.0f, 1.0f, 1.0f});
}

TEST_CASE("the shadow is the square of what is stored", "[gpu]")
{
    const Results r = runFunction(FN_UNPACK_SHADOW, {Vec4{0.5f, 0.25f, 1.0f, 0.0f}});
    CHECK(r.first[0] == 0.25f);
    CHECK(r.second == Vec4{0.25f, 0.0625f, 1.0f, 0.0f});
}

TEST_CASE("several lights give what they give one by one", "[gpu]")
{
    std::mt19937 rng(82);
    std::uniform_real_distribution<float> unit(0.01f, 1.0f);
    std::vector<Arguments> in;
    std::vector<Results> expected;
    for (int i = 0; i < 500; i++)
    {
        Light lights[3];
        for (Light& l : lights)
        {
            const bool isLit = unit(rng) < 0.3f;
            l = {{5.0f * unit(rng), unit(rng), unit(rng)}, isLit ? kLit : unit(rng), {1.0f, 1.0f, 1.0f}};
            if (!isLit)
                for (float& v : l.visibility) v = unit(rng) < 0.5f ? 0.0f : unit(rng);
        }
        in.push_back(argumentsOf(lights));
        expected.push_back(mixOf(lights));
    }
    const std::vector<Results> out = runFunction(FN_MULTI_LIGHT, in);
    for (size_t i = 0; i < in.size(); i++)
    {
        CHECK(out[i].first[0] == Approx(expected[i].first[0]).epsilon(1e-4));
        for (size_t c = 0; c < 4; c++) CHECK(out[i].second[c] == Approx(expected[i].second[c]).margin(1e-5));
    }
}

TEST_CASE("lights that don't reach the surface change nothing of what the others give", "[gpu]")
{
    const Light hit = {{1, 2, 3}, 0.5f, {0, 0, 0}}, lit = {{3, 2, 1}, kLit, {1, 1, 1}};
    const Light turnedAway = {{0, 0, 0}, 0.0f, {0, 0, 0}}, black = {{0, 0, 0}, 7.0f, {0, 0, 0}};
    const Light broken = {{kNan, 1, 1}, 7.0f, {0, 0, 0}}, infinite = {{kInfinity, 1, 1}, kLit, {1, 1, 1}};
    const Results alone = runFunction(FN_MULTI_LIGHT, argumentsOf({hit, lit, turnedAway}));
    CHECK(alone.first[0] == Approx(0.5f)); // a device may round the division of the weighted sum
    for (const Light& other : {black, broken, infinite})
    {
        const Results r = runFunction(FN_MULTI_LIGHT, argumentsOf({hit, lit, other}));
        CHECK((r.first == alone.first && r.second == alone.second));
    }
    CHECK(runFunction(FN_MULTI_LIGHT, argumentsOf({black, turnedAway, broken})).first[0] == 0.0f); // left alone
}

TEST_CASE("several lights are lit only where each of them is", "[gpu]")
{
    const Light red = {{4, 0, 0}, kLit, {1, 1, 1}}, blue = {{0, 0, 2}, kLit, {1, 1, 1}},
                dark = {{0, 0, 0}, 0, {0, 0, 0}};
    const Light shadowed = {{4, 0, 0}, 0.25f, {0, 0, 0}};
    const Results lit = runFunction(FN_MULTI_LIGHT, argumentsOf({red, blue, dark}));
    CHECK(lit.first[0] == kLit);
    for (const float x : lit.second) CHECK(x == Approx(1.0f)); // green, which nobody gives, must not count as shadow
    const Results shadow = runFunction(FN_MULTI_LIGHT, argumentsOf({shadowed, dark, dark}));
    CHECK(shadow.first[0] == Approx(0.25f));
    CHECK(shadow.second == Vec4{0.0f, 0.0f, 0.0f, 0.0f});
}
