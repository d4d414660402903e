#include "pool_planner.h"
#include <algorithm>
#include <numeric>

namespace nrd
{
// Interval colouring: in order of birth, each texture takes the first free place of its kind. Per kind the result has
// as many places as lives overlap at the busiest pass, which no plan can undercut.
PoolPlan planPool(std::span<const TransientTexture> textures, std::pmr::memory_resource* memory)
{
    PoolPlan plan(memory);
    plan.indices.resize(textures.size());
    std::pmr::vector<uint32_t> order(textures.size(), memory);
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(),
              [&](uint32_t a, uint32_t b)
              {
                  const uint32_t firstA = textures[a].firstPass, firstB = textures[b].firstPass;
                  return firstA != firstB ? firstA < firstB : a < b;
              });

    std::pmr::vector<uint32_t> lastPasses(memory); // of the present tenant of each place
    for (uint32_t i : order)
    {
        const TransientTexture& texture = textures[i];
        size_t place = 0;
        while (place < plan.pool.size() && (plan.pool[place].format != texture.format ||
                                            plan.pool[place].downsampleFactor != texture.downsampleFactor ||
                                            lastPasses[place] >= texture.firstPass))
        {
            place++;
        }
        if (place == plan.pool.size())
        {
            plan.pool.push_back({texture.format, texture.downsampleFactor});
            lastPasses.push_back(0);
        }
        lastPasses[place] = texture.lastPass;
        plan.indices[i] = static_cast<uint16_t>(place);
    }
    return plan;
}
} // namespace nrd
