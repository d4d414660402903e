// What SIGMA's passes keep of a shadow between them and from frame to frame.
#include "catch.h"
#include "function_runner.h"
#include "functions.h"
#include <algorithm>
#include <cmath>
#include <cstdio>

using namespace nrdtest;

namespace
{
constexpr float kLitRadius = 32768.0f, kUnlitRadius = 0.0f;

double relativeError(float value, float truth) { return std::abs(double(value) / double(truth) - 1.0); }

// 0 and 1 among them.
std::vector<Arguments> ramp(int steps)
{
    std::vector<Arguments> in;
    for (int i = 0; i <= steps; i++)
    {
        const float x = static_cast<float>(i) / static_cast<float>(steps);
        in.push_back({Vec4{x, 1.0f - x, x * x, 1.0f - x * x}, Vec4{static_cast<float>(i % 16)}});
    }
    return in;
}

// Distance of the roots, in steps of the store.
double rootError(float value, float truth, double steps)
{
    return std::abs(std::sqrt(double(value)) - std::sqrt(double(truth))) * steps;
}
} // namespace

TEST_CASE("radii are within a fiftieth of what they were, and one that was stored stays as it is", "[gpu]")
{
    std::vector<Arguments> in;
    for (double radius = 1.0 / 16.0; radius <= 64.0; radius *= 1.001) in.push_back({Vec4{float(radius)}});
    const std::vector<Results> out = runFunction(FN_RADIUS, in);
    double worst = 0.0;
    for (size_t i = 0; i < in.size(); i++)
    {
        worst = std::max(worst, relativeError(out[i].first[1], in[i].a[0]));
        CHECK(out[i].first[0] == out[i].first[2]);
        CHECK((out[i].first[0] >= 1.0f && out[i].first[0] <= 254.0f)); // the others are flags
    }
    std::printf("FIGURE radius between SIGMA's blurs: relative error %.4f\n", worst);
    CHECK(worst < 0.0145); // half of a step
}

TEST_CASE("a radius beyond the range is its end, and no flag", "[gpu]")
{
    for (const auto& [radius, end] :
         {std::pair{1e-9f, 1.0f / 16.0f}, {0.01f, 1.0f / 16.0f}, {65.0f, 64.0f}, {9e5f, 64.0f}})
        CHECK(runFunction(FN_RADIUS, {Vec4{radius}}).first[1] == Approx(end).epsilon(1e-4));
}

TEST_CASE("the flags of a radius come back exactly", "[gpu]")
{
    for (const float flag : {kUnlitRadius, kLitRadius}) CHECK(runFunction(FN_RADIUS, {Vec4{flag}}).first[1] == flag);
    for (float code = 1.0f; code <= 254.0f; code += 1.0f)
    {
        const float radius = runFunction(FN_RADIUS, {Vec4{1.0f, code}}).first[3];
        CHECK((radius >= 0.0624f && radius <= 64.01f));
    }
}

TEST_CASE("depths of history keep 4e-4 over ten decades", "[gpu]")
{
    std::vector<Arguments> in;
    for (double depth = 6.2e-5; depth <= 1e6; depth *= 1.0007) in.push_back({Vec4{float(depth)}});
    const std::vector<Results> out = runFunction(FN_DEPTH, in);
    double worst = 0.0;
    for (size_t i = 0; i < in.size(); i++) worst = std::max(worst, relativeError(out[i].first[0], in[i].a[0]));
    std::printf("FIGURE depth in SIGMA's history: relative error %.2e\n", worst);
    CHECK(worst < 4e-4);
}

TEST_CASE("a depth beyond the range is something, and not nothing", "[gpu]")
{
    for (const float depth : {1e-30f, 1e-5f, 1e7f, 1e30f}) CHECK(runFunction(FN_DEPTH, {Vec4{depth}}).first[0] > 0.0f);
}

TEST_CASE("roots of eight bits keep light and darkness exact, and half of a step between", "[gpu]")
{
    const std::vector<Arguments> in = ramp(1000);
    const std::vector<Results> out = runFunction(FN_ROOTS, in);
    for (size_t i = 0; i < in.size(); i++)
    {
        for (size_t c = 0; c < 4; c++)
        {
            CHECK(rootError(out[i].first[c], in[i].a[c], 255.0) < 0.501);
            CHECK(out[i].second[c] == Approx(std::sqrt(in[i].a[c])).margin(1e-6));
            if (in[i].a[c] == 0.0f || in[i].a[c] == 1.0f) CHECK(out[i].first[c] == in[i].a[c]);
        }
    }
}

TEST_CASE("history keeps visibility in twelve bits, colour in ten at least, and frames", "[gpu]")
{
    const std::vector<Arguments> in = ramp(5000);
    const std::vector<Results> out = runFunction(FN_PAST, in);
    const double steps[4] = {4095.0, 2047.0, 2047.0, 1023.0};
    for (size_t i = 0; i < in.size(); i++)
    {
        CHECK(out[i].second[0] == in[i].b[0]);
        for (size_t c = 0; c < 4; c++)
        {
            CHECK(rootError(out[i].first[c], in[i].a[c], steps[c]) < 0.505);
            if (in[i].a[c] == 0.0f || in[i].a[c] == 1.0f) CHECK(out[i].first[c] == in[i].a[c]);
        }
    }
}

TEST_CASE("history holds fifteen frames at most, and never wraps round", "[gpu]")
{
    for (const float frames : {15.4f, 16.0f, 1000.0f})
        CHECK(runFunction(FN_PAST, {Vec4{0.5f, 0.5f, 0.5f, 0.5f}, Vec4{frames}}).second[0] == 15.0f);
}
