// Walker's alias method: draws index i with a given probability in constant time.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace sample
{
struct AliasEntry
{
    float threshold = 1.0f; // below it (for a uniform number in [0; 1)) the entry itself, else `alias`
    uint32_t alias = 0;
    float probability = 0.0f; // of drawing this index; all sum to 1
};

/// A table over non-negative finite weights; when all are 0 every index is equally likely. Empty for no weights.
std::vector<AliasEntry> buildAliasTable(std::span<const double> weights);
} // namespace sample
