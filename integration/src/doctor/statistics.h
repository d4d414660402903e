// Robust numbers from many samples. Values that are not finite are left out by those who add them.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace nrd::doctor
{
/// NaN if there are no values.
inline double quantile(std::vector<double> values, double q)
{
    if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
    const size_t n = std::min(values.size() - 1, static_cast<size_t>(q * static_cast<double>(values.size())));
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(n), values.end());
    return values[n];
}

inline double median(std::vector<double> values) { return quantile(std::move(values), 0.5); }

struct Share
{
    uint64_t count = 0;
    uint64_t total = 0;
    void add(bool isCounted)
    {
        count += isCounted;
        total++;
    }
    double value() const { return total == 0 ? 0.0 : static_cast<double>(count) / static_cast<double>(total); }
};
} // namespace nrd::doctor
