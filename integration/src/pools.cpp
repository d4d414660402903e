#include "pools.h"
#include "convert.h"
#include "refusal.h"
#include <algorithm>

namespace nrd
{
namespace
{
constexpr uint32_t kTileSize = 16; // pixels, of the tiles that BufferDesc counts

uint32_t divideRoundingUp(uint32_t a, uint32_t b) { return (a + b - 1) / b; }
uint64_t alignUp(uint64_t value, uint64_t alignment) { return (value + alignment - 1) / alignment * alignment; }

rhi::TextureDesc textureDesc(const PoolsDesc& desc, const TextureDesc& texture, const char* name, const char* tag)
{
    const uint32_t factor = std::max<uint32_t>(texture.downsampleFactor, 1);
    rhi::TextureDesc result;
    result.format = toRhi(texture.format);
    result.width = divideRoundingUp(desc.width, factor);
    result.height = divideRoundingUp(desc.height, factor);
    result.usage = rhi::TextureUsage::Sampled | rhi::TextureUsage::Storage;
    result.name = name;
    result.memoryTag = tag;
    return result;
}

struct Placement
{
    std::vector<uint64_t> offsets;
    VkMemoryRequirements needs = {0, 1, ~0u}; // no type: the textures cannot share a block
};

Placement place(rhi::Device& device, const std::vector<rhi::TextureDesc>& textures)
{
    Placement result;
    for (const rhi::TextureDesc& texture : textures)
    {
        const rhi::MemoryRequirements needs = device.textureMemoryRequirements(texture);
        result.offsets.push_back(alignUp(result.needs.size, needs.alignment));
        result.needs.size = result.offsets.back() + needs.size;
        result.needs.alignment = std::max<VkDeviceSize>(result.needs.alignment, needs.alignment);
        result.needs.memoryTypeBits &= needs.memoryTypeBits;
    }
    return result;
}

// Names point into `names`, which must live as long.
std::vector<rhi::TextureDesc> textureDescs(const PoolsDesc& desc, rhi::Span<const TextureDesc> textures,
                                           const std::vector<std::string>& names, const char* tag)
{
    std::vector<rhi::TextureDesc> result;
    for (size_t i = 0; i < textures.size(); i++)
        result.push_back(textureDesc(desc, textures[i], names[i].c_str(), tag));
    return result;
}

std::vector<std::string> textureNames(const PoolsDesc& desc, size_t count, char letter)
{
    std::vector<std::string> result;
    for (size_t i = 0; i < count; i++) result.push_back(sentence("%s %c(%u)", desc.name, letter, uint32_t(i)));
    return result;
}

VkMemoryRequirements requirementsOf(rhi::Device& device, const PoolsDesc& desc, rhi::Span<const TextureDesc> textures,
                                    char letter)
{
    if (textures.empty()) return {};
    const std::vector<std::string> names = textureNames(desc, textures.size(), letter);
    return place(device, textureDescs(desc, textures, names, "")).needs;
}
} // namespace

std::string memoryTag(const char* name, const char* part) { return sentence("%s %s", name, part); }

PoolMemoryRequirements poolMemoryRequirements(rhi::Device& device, const PoolsDesc& desc, const InstanceDesc& instance)
{
    return {requirementsOf(device, desc, {instance.permanentPool, instance.permanentPoolSize}, 'P'),
            requirementsOf(device, desc, {instance.transientPool, instance.transientPoolSize}, 'T')};
}

TexturePool::TexturePool(rhi::Device& device, const PoolsDesc& desc, rhi::Span<const TextureDesc> textures, char letter,
                         const NrdMemory& lent)
{
    if (textures.empty()) return;
    const std::string tag = memoryTag(desc.name, letter == 'P' ? "permanent" : "transient");
    const std::vector<std::string> names = textureNames(desc, textures.size(), letter);
    const std::vector<rhi::TextureDesc> descs = textureDescs(desc, textures, names, tag.c_str());
    const Placement placement = place(device, descs);
    if (lent.memory != VK_NULL_HANDLE)
        m_blocks.push_back(
            lentBlock(device, lent, placement.needs, tag, sentence(" at %u x %u", desc.width, desc.height)));
    else
        allocate(device, descs, placement.needs, *desc.source, tag);
    for (size_t i = 0; i < descs.size(); i++)
    {
        const bool isShared = m_blocks.size() == 1; // also that of a pool of one texture
        const MemoryBlock& block = m_blocks[isShared ? 0 : i];
        const uint64_t offset = block.place().offset + (isShared ? placement.offsets[i] : 0);
        Slot slot;
        slot.texture = device.createPlacedTexture(descs[i], block.memory(), offset);
        slot.sampled = device.createView(*slot.texture, {rhi::ViewType::Sampled, {0, 1}});
        slot.storage = device.createView(*slot.texture, {rhi::ViewType::Storage, {0, 1}});
        m_slots.push_back(std::move(slot));
    }
}

void TexturePool::allocate(rhi::Device& device, const std::vector<rhi::TextureDesc>& descs,
                           const VkMemoryRequirements& needs, MemorySource& source, const std::string& tag)
{
    m_byteSize = needs.size;
    if (needs.memoryTypeBits != 0)
    {
        m_blocks.push_back(source.allocate(needs, tag));
        return;
    }
    for (const rhi::TextureDesc& texture : descs)
    {
        const rhi::MemoryRequirements own = device.textureMemoryRequirements(texture);
        m_blocks.push_back(source.allocate({own.size, own.alignment, own.memoryTypeBits}, tag));
    }
}

Pools::Pools(rhi::Device& device, const PoolsDesc& desc, const InstanceDesc& instance)
    : states(instance.permanentPoolSize + instance.transientPoolSize + static_cast<uint32_t>(ResourceType::MAX_NUM)),
      bufferStates(instance.buffersNum), m_width(desc.width), m_height(desc.height),
      m_permanent(device, desc, {instance.permanentPool, instance.permanentPoolSize}, 'P'),
      m_transient(std::make_unique<TexturePool>(
          device, desc, rhi::Span<const TextureDesc>(instance.transientPool, instance.transientPoolSize), 'T',
          desc.transientMemory))
{
    const uint64_t tileCount =
        uint64_t(divideRoundingUp(desc.width, kTileSize)) * divideRoundingUp(desc.height, kTileSize);
    const std::string tag = memoryTag(desc.name, "buffers");
    for (uint32_t i = 0; i < instance.buffersNum; i++)
    {
        const BufferDesc& source = instance.buffers[i];
        const std::string name = sentence("%s B(%u)", desc.name, i);
        rhi::BufferDesc buffer;
        buffer.size = source.byteSizePerTile * tileCount + source.byteSize;
        buffer.usage = rhi::BufferUsage::Storage;
        if (source.isIndirectArguments) buffer.usage |= rhi::BufferUsage::Indirect;
        buffer.name = name.c_str();
        buffer.memoryTag = tag.c_str();
        m_buffers.push_back(device.createBuffer(buffer));
    }
}
} // namespace nrd
