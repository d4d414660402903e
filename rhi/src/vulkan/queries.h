// Timestamps and fences: what the host waits for.
#pragma once
#include "context.h"

namespace rhi::vulkan
{
class QueryPool final : public rhi::QueryPool
{
public:
    QueryPool(const Context& context, const QueryPoolDesc& desc);
    bool read(uint32_t first, Span<uint64_t> ticks) const override;
    double nanoseconds(uint64_t begin, uint64_t end) const override;
    uint64_t nativeHandle() const override { return rhi::detail::toHandle(m_pool.get()); }
    VkQueryPool pool() const { return m_pool.get(); }

private:
    const Context& m_context;
    UniqueQueryPool m_pool;
};

class Fence final : public rhi::Fence
{
public:
    Fence(const Context& context, const char* name);
    bool isSignaled() const override;
    bool wait(uint64_t timeout) override;
    void reset() override;
    uint64_t nativeHandle() const override { return rhi::detail::toHandle(m_fence.get()); }
    VkFence fence() const { return m_fence.get(); }

private:
    const Context& m_context;
    UniqueFence m_fence;
};
} // namespace rhi::vulkan
