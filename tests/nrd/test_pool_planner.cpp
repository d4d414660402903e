#include "catch.h"
#include "pool_planner.h"
#include <map>
#include <random>

using namespace nrd;

namespace
{
bool overlap(const TransientTexture& a, const TransientTexture& b)
{
    return a.firstPass <= b.lastPass && b.firstPass <= a.lastPass;
}

PoolPlan plan(const std::vector<TransientTexture>& textures)
{
    return planPool(textures, std::pmr::new_delete_resource());
}

// Per kind of texture: how many are alive at the busiest pass. No pool can be smaller.
size_t lowerBound(const std::vector<TransientTexture>& textures)
{
    std::map<std::pair<Format, uint16_t>, size_t> busiest;
    for (const TransientTexture& at : textures)
    {
        size_t alive = 0;
        for (const TransientTexture& t : textures)
        {
            const bool isSameKind = t.format == at.format && t.downsampleFactor == at.downsampleFactor;
            alive += isSameKind && t.firstPass <= at.firstPass && at.firstPass <= t.lastPass ? 1 : 0;
        }
        size_t& most = busiest[{at.format, at.downsampleFactor}];
        most = std::max(most, alive);
    }
    size_t sum = 0;
    for (const auto& [kind, num] : busiest) sum += num;
    return sum;
}

struct Random
{
    std::mt19937 engine;
    uint32_t operator()() { return static_cast<uint32_t>(engine()); }
};

std::vector<TransientTexture> makeRandom(Random& random)
{
    const Format formats[] = {Format::R8_UNORM, Format::RG16_SFLOAT, Format::RGBA16_SFLOAT};
    std::vector<TransientTexture> textures(random() % 24);
    for (TransientTexture& t : textures)
    {
        t.format = formats[random() % 3];
        t.downsampleFactor = random() % 4 == 0 ? 16 : 1;
        t.firstPass = random() % 12;
        t.lastPass = t.firstPass + random() % 5;
    }
    return textures;
}
} // namespace

TEST_CASE("textures whose lives touch in one pass do not share", "[unit]")
{
    const PoolPlan touching = plan({{Format::R8_UNORM, 1, 0, 2}, {Format::R8_UNORM, 1, 2, 3}});
    CHECK(touching.pool.size() == 2);
    const PoolPlan apart = plan({{Format::R8_UNORM, 1, 0, 2}, {Format::R8_UNORM, 1, 3, 3}});
    CHECK(apart.pool.size() == 1);
    const PoolPlan otherFactor = plan({{Format::R8_UNORM, 1, 0, 2}, {Format::R8_UNORM, 16, 3, 3}});
    CHECK(otherFactor.pool.size() == 2);
}

TEST_CASE("the pool is valid and the smallest possible on random inputs", "[unit]")
{
    Random random = {std::mt19937(7)};
    for (int round = 0; round < 2000; round++)
    {
        const std::vector<TransientTexture> textures = makeRandom(random);
        const PoolPlan result = plan(textures);
        REQUIRE(result.indices.size() == textures.size());
        REQUIRE(result.pool.size() == lowerBound(textures));
        for (size_t i = 0; i < textures.size(); i++)
        {
            REQUIRE(result.indices[i] < result.pool.size());
            const TextureDesc& place = result.pool[result.indices[i]];
            REQUIRE(place.format == textures[i].format);
            REQUIRE(place.downsampleFactor == textures[i].downsampleFactor);
            for (size_t j = 0; j < i; j++)
            {
                if (result.indices[i] == result.indices[j]) REQUIRE_FALSE(overlap(textures[i], textures[j]));
            }
        }
    }
}
