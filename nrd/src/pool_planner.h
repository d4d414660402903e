// Transient textures -> the smallest pool. Textures of equal format and factor whose lives do not overlap share one.
#pragma once
#include <cstdint>
#include <memory_resource>
#include <nrd/descs.h>
#include <span>
#include <vector>

namespace nrd
{
// Life in passes, both ends included. Denoisers of an instance run one after another, so their passes are numbered on.
struct TransientTexture
{
    Format format;
    uint16_t downsampleFactor;
    uint32_t firstPass;
    uint32_t lastPass;
};

struct PoolPlan
{
    explicit PoolPlan(std::pmr::memory_resource* memory) : pool(memory), indices(memory) {}

    std::pmr::vector<TextureDesc> pool;
    std::pmr::vector<uint16_t> indices; // indices[i] = place of textures[i] in the pool
};

// Throws std::bad_alloc.
PoolPlan planPool(std::span<const TransientTexture> textures, std::pmr::memory_resource* memory);
} // namespace nrd
