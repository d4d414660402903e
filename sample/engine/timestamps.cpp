#include "engine/timestamps.h"

namespace engine
{
Timestamps::Timestamps(const Device& device, uint32_t capacity)
    : m_capacity(capacity), m_msPerTick(double(device.properties().limits.timestampPeriod) * 1e-6)
{
    uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(device.physical(), &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(device.physical(), &count, families.data());
    const uint32_t bits = families[device.queueFamily()].timestampValidBits;
    m_validMask = bits == 0 ? 0 : ~uint64_t(0) >> (64 - bits);
    auto info = describe<VkQueryPoolCreateInfo>(VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO);
    info.queryType = VK_QUERY_TYPE_TIMESTAMP;
    info.queryCount = capacity;
    VkQueryPool pool = VK_NULL_HANDLE;
    check(vkCreateQueryPool(device.handle(), &info, nullptr, &pool), "create a timestamp pool");
    m_pool = {device.handle(), pool};
}

void Timestamps::reset(VkCommandBuffer cmd)
{
    vkCmdResetQueryPool(cmd, m_pool.get(), 0, m_capacity);
    m_count = 0;
}

void Timestamps::mark(VkCommandBuffer cmd)
{
    if (m_count == m_capacity || m_validMask == 0) return;
    vkCmdWriteTimestamp(cmd, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, m_pool.get(), m_count++);
}

std::vector<double> Timestamps::read() const
{
    if (m_count == 0) return {};
    std::vector<uint64_t> ticks(m_count);
    check(vkGetQueryPoolResults(m_pool.device(), m_pool.get(), 0, m_count, ticks.size() * sizeof(uint64_t),
                                ticks.data(), sizeof(uint64_t), VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
          "read timestamps");
    std::vector<double> times;
    for (size_t i = 1; i < ticks.size(); ++i)
        times.push_back(double((ticks[i] - ticks[i - 1]) & m_validMask) * m_msPerTick);
    return times;
}
} // namespace engine
