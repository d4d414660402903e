#include "sweep.h"
#include "catch.h"
#include "long_form.h"
#include <cstdio>
#include <sstream>

namespace nrdtest
{
namespace
{
constexpr size_t kBatch = 200000;

std::string text(const Arguments& in, const Results& out)
{
    std::ostringstream stream;
    stream.precision(9);
    const auto add = [&](char name, const Vec4& v)
    { stream << name << " = " << v[0] << ", " << v[1] << ", " << v[2] << ", " << v[3] << "\n"; };
    const Vec4* arguments = &in.a;
    for (int i = 0; i < 8; i++) add(static_cast<char>('a' + i), arguments[i]);
    add('1', out.first);
    add('2', out.second);
    return stream.str();
}

// A device may take numbers below the normal ones for 0.
Arguments flushed(Arguments arguments)
{
    Vec4* vectors = &arguments.a;
    for (int i = 0; i < 8; i++)
        for (int j = 0; j < 4; j++)
            if (std::fpclassify(vectors[i][j]) == FP_SUBNORMAL) vectors[i][j] = 0.0f;
    return arguments;
}

double errorOf(const Sweep& sweep, const Arguments& in, const Results& out)
{
    const double exact = sweep.error(in, out), coarse = sweep.error(flushed(in), out);
    if (std::isnan(exact) || std::isnan(coarse)) return std::numeric_limits<double>::infinity();
    return std::min(exact, coarse);
}
} // namespace

void check(const Sweep& sweep, std::span<const nrd::shared::DenoiserConstants> frames)
{
    const size_t batches = test::isLong() ? 30 : 1;
    Random random(static_cast<uint64_t>(sweep.function) + 1);
    double worst = -1.0;
    std::string at;
    for (size_t batch = 0; batch < batches; batch++)
    {
        std::vector<Arguments> in(kBatch);
        for (Arguments& arguments : in) arguments = sweep.draw(random);
        const std::vector<Results> out = runFunction(sweep.function, in, frames);
        for (size_t i = 0; i < in.size(); i++)
        {
            const double error = errorOf(sweep, in[i], out[i]);
            if (error <= worst) continue;
            worst = error;
            at = text(in[i], out[i]);
        }
    }
    std::printf("FIGURE %s: %.3g %s at worst over %.1f million (bound %.3g: %s)\n", sweep.what, worst, sweep.unit,
                static_cast<double>(batches * kBatch) * 1e-6, sweep.bound, sweep.reason);
    INFO(sweep.what << ", worst at\n" << at);
    CHECK(worst <= sweep.bound);
}

double ulps(double value, double expected, double magnitude)
{
    constexpr double kMax = std::numeric_limits<float>::max(), kMin = std::numeric_limits<float>::min();
    const double got = std::clamp(value, -kMax, kMax), wanted = std::clamp(expected, -kMax, kMax);
    const double difference = std::abs(got - wanted);
    if (difference <= kMin) return 0.0;
    const double size = std::abs(magnitude) > kMin ? std::min(std::abs(magnitude), kMax) : kMin; // NaN: the smallest
    return std::ldexp(difference, 23 - std::ilogb(size));
}

double ulps(const Vec4& value, const Vec4d& expected, double magnitude, int components)
{
    double worst = 0.0;
    for (int i = 0; i < components; i++)
    {
        const double error = ulps(double{value[i]}, expected[i], magnitude);
        if (!(error <= worst)) worst = error; // NaN stays
    }
    return worst;
}
} // namespace nrdtest
