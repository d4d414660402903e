// GPU times between marks written into a command buffer.
#pragma once
#include "engine/device.h"
#include "engine/unique.h"

namespace engine
{
class Timestamps
{
public:
    /// `capacity` marks, > 0. On a queue without timestamps the differences are 0.
    Timestamps(const Device& device, uint32_t capacity);

    /// Forgets all marks; recorded before the first mark of a command buffer.
    void reset(VkCommandBuffer cmd);
    /// Records a mark after all commands before it; marks beyond the capacity are dropped.
    void mark(VkCommandBuffer cmd);
    /// Milliseconds between each mark and the one before it; waits until they are there.
    std::vector<double> read() const;

private:
    UniqueQueryPool m_pool;
    uint32_t m_capacity = 0;
    uint32_t m_count = 0;
    double m_msPerTick = 0.0;
    uint64_t m_validMask = 0; // 0: the queue has no timestamps
};
} // namespace engine
