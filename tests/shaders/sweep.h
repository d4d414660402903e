// Millions of random arguments to a function on the device: its largest error against a reference in double precision.
#pragma once
#include "function_runner.h"
#include "packing.h"
#include "random.h"
#include <functional>

namespace nrdtest
{
struct Sweep
{
    const char* what;
    const char* unit;
    double bound;
    const char* reason; // of the bound
    int function;
    std::function<Arguments(Random&)> draw;
    std::function<double(const Arguments&, const Results&)> error; // NaN is a failure
};

// Prints the figure. frames: of functions that take the constants of a frame.
void check(const Sweep& sweep, std::span<const nrd::shared::DenoiserConstants> frames = {});

// In units in the last place of floats as large as `magnitude`: of the result, or of what it is a difference of. Below
// the smallest normal float is none: devices may flush it to zero. What is beyond the largest is infinite.
double ulps(double value, double expected, double magnitude);
inline double ulps(double value, double expected) { return ulps(value, expected, expected); }

// The largest over some components of a result.
double ulps(const Vec4& value, const Vec4d& expected, double magnitude, int components);
} // namespace nrdtest
