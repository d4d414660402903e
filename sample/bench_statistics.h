// Order statistics of measured times.
#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

namespace sample::bench
{
// The value below which the share `q` in [0; 1] of `values` lies, between two of them interpolated; not empty.
inline double quantile(std::vector<double> values, double q)
{
    std::sort(values.begin(), values.end());
    const double at = q * static_cast<double>(values.size() - 1);
    const size_t low = static_cast<size_t>(at), high = std::min(low + 1, values.size() - 1);
    return values[low] + (at - static_cast<double>(low)) * (values[high] - values[low]);
}
} // namespace sample::bench
