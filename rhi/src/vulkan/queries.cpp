#include "queries.h"
#include "checks.h"
#include "ticks.h"

namespace rhi::vulkan
{
QueryPool::QueryPool(const Context& context, const QueryPoolDesc& desc) : rhi::QueryPool(desc), m_context(context)
{
    auto info = vkStruct<VkQueryPoolCreateInfo>(VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO);
    info.queryType = VK_QUERY_TYPE_TIMESTAMP;
    info.queryCount = desc.count;
    VkQueryPool pool = VK_NULL_HANDLE;
    check(context.fn.createQueryPool(context.device, &info, context.callbacks, &pool), "query pool", name());
    m_pool = UniqueQueryPool(context, pool);
    context.setName(VK_OBJECT_TYPE_QUERY_POOL, pool, name());
}

bool QueryPool::read(uint32_t first, Span<uint64_t> ticks) const
{
    if (first > count() || ticks.size() > count() - first)
        throwInvalid(sentence("query pool '%s': queries [%u; %u + %zu) do not exist, it has %u", name(), first, first,
                              ticks.size(), count()));
    if (ticks.empty()) return true;
    const VkResult result = m_context.fn.getQueryPoolResults(
        m_context.device, m_pool.get(), first, static_cast<uint32_t>(ticks.size()), ticks.size() * sizeof(uint64_t),
        ticks.data(), sizeof(uint64_t), VK_QUERY_RESULT_64_BIT);
    if (result == VK_NOT_READY) return false;
    check(result, "query pool", name());
    return true;
}

double QueryPool::nanoseconds(uint64_t begin, uint64_t end) const
{
    const DeviceLimits& limits = m_context.info.limits;
    return static_cast<double>(tickDifference(begin, end, limits.timestampValidBits)) * limits.timestampPeriod;
}

Fence::Fence(const Context& context, const char* name) : rhi::Fence(name), m_context(context)
{
    const auto info = vkStruct<VkFenceCreateInfo>(VK_STRUCTURE_TYPE_FENCE_CREATE_INFO);
    VkFence fence = VK_NULL_HANDLE;
    check(context.fn.createFence(context.device, &info, context.callbacks, &fence), "fence", name);
    m_fence = UniqueFence(context, fence);
    context.setName(VK_OBJECT_TYPE_FENCE, fence, this->name());
}

bool Fence::isSignaled() const
{
    const VkResult result = m_context.fn.getFenceStatus(m_context.device, m_fence.get());
    check(result, "fence", name());
    return result == VK_SUCCESS;
}

bool Fence::wait(uint64_t timeout)
{
    const VkFence fence = m_fence.get();
    const VkResult result = m_context.fn.waitForFences(m_context.device, 1, &fence, VK_TRUE, timeout);
    check(result, "fence", name());
    return result == VK_SUCCESS;
}

void Fence::reset()
{
    const VkFence fence = m_fence.get();
    check(m_context.fn.resetFences(m_context.device, 1, &fence), "fence", name());
}
} // namespace rhi::vulkan
