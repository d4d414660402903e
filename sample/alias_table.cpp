#include "alias_table.h"

#include <numeric>

namespace sample
{
std::vector<AliasEntry> buildAliasTable(std::span<const double> weights)
{
    const size_t count = weights.size();
    std::vector<AliasEntry> table(count);
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    std::vector<double> scaled(count, 1.0); // probability * count
    for (size_t i = 0; i < count && sum > 0.0; ++i) scaled[i] = weights[i] / sum * double(count);
    std::vector<uint32_t> small, large;
    for (size_t i = 0; i < count; ++i)
    {
        table[i].probability = static_cast<float>(scaled[i] / double(count));
        table[i].alias = static_cast<uint32_t>(i);
        (scaled[i] < 1.0 ? small : large).push_back(static_cast<uint32_t>(i));
    }
    while (!small.empty() && !large.empty())
    {
        const uint32_t s = small.back(), l = large.back();
        small.pop_back();
        table[s].threshold = static_cast<float>(scaled[s]);
        table[s].alias = l;
        scaled[l] -= 1.0 - scaled[s];
        if (scaled[l] >= 1.0) continue;
        large.pop_back();
        small.push_back(l);
    }
    return table; // what is left over has threshold 1: rounding only
}
} // namespace sample
