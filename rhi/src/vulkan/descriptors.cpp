#include "descriptors.h"
#include "buffer.h"
#include "checks.h"
#include "convert.h"
#include "pipeline.h"
#include "texture.h"
#include <algorithm>

namespace rhi::vulkan
{
namespace
{
constexpr const char* kTypeNames[] = {"dynamic uniform buffers", "samplers", "sampled textures", "storage textures",
                                      "storage buffers"};

UniqueDescriptorPool createPool(const Context& context, const DescriptorPoolDesc& desc,
                                const std::array<uint32_t, 5>& capacity)
{
    std::vector<VkDescriptorPoolSize> sizes;
    for (size_t i = 0; i < capacity.size(); i++)
        if (capacity[i] > 0) sizes.push_back({toVulkan(static_cast<BindingType>(i)), capacity[i]});
    if (sizes.empty()) sizes.push_back({VK_DESCRIPTOR_TYPE_SAMPLER, 1}); // a pool for empty sets is not allowed
    auto info = vkStruct<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
    info.maxSets = desc.sets;
    info.poolSizeCount = static_cast<uint32_t>(sizes.size());
    info.pPoolSizes = sizes.data();
    VkDescriptorPool pool = VK_NULL_HANDLE;
    check(context.fn.createDescriptorPool(context.device, &info, context.callbacks, &pool), "descriptor pool",
          desc.name);
    context.setName(VK_OBJECT_TYPE_DESCRIPTOR_POOL, pool, safeName(desc.name));
    return UniqueDescriptorPool(context, pool);
}
} // namespace

DescriptorSet::DescriptorSet(DescriptorPool& pool) : rhi::DescriptorSet(pool.name()), m_pool(pool) {}

void DescriptorSet::assign(VkDescriptorSet set, const SetLayout& layout)
{
    m_set = set;
    m_layout = &layout;
}

void DescriptorSet::write(Span<const DescriptorWrite> writes) { m_pool.writeSet(*this, writes); }

DescriptorPool::DescriptorPool(const Context& context, const DescriptorPoolDesc& desc)
    : rhi::DescriptorPool(desc.name), m_context(context),
      m_setCapacity(desc.sets), m_capacity{desc.uniformBuffersDynamic, desc.samplers, desc.sampledTextures,
                                           desc.storageTextures, desc.storageBuffers}
{
    m_pool = createPool(context, desc, m_capacity);
    m_sets.reserve(desc.sets);
}

// Counted here, for drivers are free to hand out more than a pool was made for, and some do.
void DescriptorPool::takeRoom(const SetLayout& layout)
{
    if (m_usedSets >= m_setCapacity)
        throw Error(ErrorCode::PoolExhausted,
                    sentence("descriptor pool '%s': all %u sets are in use", name(), m_setCapacity));
    for (size_t i = 0; i < m_capacity.size(); i++)
        if (layout.typeCounts[i] > m_capacity[i] - m_used[i])
            throw Error(ErrorCode::PoolExhausted,
                        sentence("descriptor pool '%s': %u of %u %s are in use, the set needs %u more", name(),
                                 m_used[i], m_capacity[i], kTypeNames[i], layout.typeCounts[i]));
}

rhi::DescriptorSet& DescriptorPool::allocate(const rhi::Pipeline& pipeline, uint32_t set)
{
    const PipelineLayout& pipelineLayout = static_cast<const Pipeline&>(pipeline).layout();
    if (set >= pipelineLayout.sets.size())
        throwInvalid(sentence("descriptor pool '%s': pipeline '%s' has no set %u", name(), pipeline.name(), set));
    const SetLayout& layout = *pipelineLayout.sets[set];
    takeRoom(layout);

    const VkDescriptorSetLayout vkLayout = layout.owner.get();
    auto info = vkStruct<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO);
    info.descriptorPool = m_pool.get();
    info.descriptorSetCount = 1;
    info.pSetLayouts = &vkLayout;
    VkDescriptorSet handle = VK_NULL_HANDLE;
    // First what the driver's set would be lost without.
    if (m_usedSets == m_sets.size()) m_sets.push_back(std::make_unique<DescriptorSet>(*this));
    check(m_context.fn.allocateDescriptorSets(m_context.device, &info, &handle), "descriptor pool", name());
    for (size_t i = 0; i < m_used.size(); i++) m_used[i] += layout.typeCounts[i];
    DescriptorSet& result = *m_sets[m_usedSets++];
    result.assign(handle, layout);
    return result;
}

void DescriptorPool::reset()
{
    check(m_context.fn.resetDescriptorPool(m_context.device, m_pool.get(), 0), "descriptor pool", name());
    m_used = {};
    m_usedSets = 0;
}

void DescriptorPool::writeSet(const DescriptorSet& set, Span<const DescriptorWrite> writes)
{
    m_writes.clear();
    m_images.clear();
    m_buffers.clear();
    m_images.reserve(writes.size()); // pointers into them must last until the update
    m_buffers.reserve(writes.size());
    const std::vector<BindingDesc>& bindings = set.layout().bindings;
    for (const DescriptorWrite& write : writes)
    {
        const auto isIt = [&](const BindingDesc& b) { return b.binding == write.binding; };
        const auto found = std::find_if(bindings.begin(), bindings.end(), isIt);
        if (found == bindings.end())
            throwInvalid(sentence("set of descriptor pool '%s': it has no binding %u", name(), write.binding));
        if (!write.view == !write.buffer)
            throwInvalid(sentence("set of descriptor pool '%s': binding %u needs either a view or a buffer", name(),
                                  write.binding));
        auto info = vkStruct<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
        info.dstSet = set.set();
        info.dstBinding = write.binding;
        info.descriptorCount = 1;
        info.descriptorType = toVulkan(found->type);
        if (write.view)
        {
            const bool isStorage = found->type == BindingType::StorageTexture;
            const VkImageLayout layout = isStorage ? VK_IMAGE_LAYOUT_GENERAL : toVulkan(write.layout);
            const VkImageView view = static_cast<const TextureView*>(write.view)->view();
            info.pImageInfo = &m_images.emplace_back(VkDescriptorImageInfo{VK_NULL_HANDLE, view, layout});
        }
        else
        {
            const VkBuffer buffer = static_cast<const Buffer*>(write.buffer)->buffer();
            info.pBufferInfo = &m_buffers.emplace_back(VkDescriptorBufferInfo{buffer, write.offset, write.size});
        }
        m_writes.push_back(info);
    }
    m_context.fn.updateDescriptorSets(m_context.device, static_cast<uint32_t>(m_writes.size()), m_writes.data(), 0,
                                      nullptr);
}
} // namespace rhi::vulkan
