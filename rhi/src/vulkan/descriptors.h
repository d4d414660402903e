#pragma once
#include "layouts.h"

namespace rhi::vulkan
{
class DescriptorPool;

class DescriptorSet final : public rhi::DescriptorSet
{
public:
    explicit DescriptorSet(DescriptorPool& pool);
    void write(Span<const DescriptorWrite> writes) override;
    uint64_t nativeHandle() const override { return rhi::detail::toHandle(m_set); }
    VkDescriptorSet set() const { return m_set; }
    const SetLayout& layout() const { return *m_layout; }
    void assign(VkDescriptorSet set, const SetLayout& layout);

private:
    DescriptorPool& m_pool;
    VkDescriptorSet m_set = VK_NULL_HANDLE;
    const SetLayout* m_layout = nullptr;
};

class DescriptorPool final : public rhi::DescriptorPool
{
public:
    DescriptorPool(const Context& context, const DescriptorPoolDesc& desc);
    rhi::DescriptorSet& allocate(const rhi::Pipeline& pipeline, uint32_t set) override;
    void reset() override;
    uint64_t nativeHandle() const override { return rhi::detail::toHandle(m_pool.get()); }
    void writeSet(const DescriptorSet& set, Span<const DescriptorWrite> writes);

private:
    void takeRoom(const SetLayout& layout);

    const Context& m_context;
    UniqueDescriptorPool m_pool;
    uint32_t m_setCapacity;
    std::array<uint32_t, 5> m_capacity; // by BindingType
    std::array<uint32_t, 5> m_used = {};
    size_t m_usedSets = 0;
    std::vector<std::unique_ptr<DescriptorSet>> m_sets; // kept over resets, handed out again
    std::vector<VkWriteDescriptorSet> m_writes;         // the three are kept to keep their memory
    std::vector<VkDescriptorImageInfo> m_images;
    std::vector<VkDescriptorBufferInfo> m_buffers;
};
} // namespace rhi::vulkan
