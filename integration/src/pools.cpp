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
    uint64_t size = 0;
    uint32_t memoryTypeBits = ~0u; // 0: the textures cannot share a block
};

Placement place(rhi::Device& device, const std::vector<rhi::TextureDesc>& textures)
{
    Placement result;
    for (const rhi::TextureDesc& texture : textures)
    {
        const rhi::MemoryRequirements needs = device.textureMemoryRequirements(texture);
        result.offsets.push_back(alignUp(result.size, needs.alignment));
        result.size = result.offsets.back() + needs.size;
        result.memoryTypeBits &= needs.memoryTypeBits;
    }
    return result;
}
} // namespace

std::string memoryTag(const char* name, const char* part) { return sentence("%s %s", name, part); }

TexturePool::TexturePool(rhi::Device& device, const PoolsDesc& desc, const TextureDesc* textures, uint32_t textureCount,
                         char letter)
{
    if (textureCount == 0) return;
    const std::string tag = memoryTag(desc.name, letter == 'P' ? "permanent" : "transient");
    std::vector<std::string> names;
    for (uint32_t i = 0; i < textureCount; i++) names.push_back(sentence("%s %c(%u)", desc.name, letter, i));
    std::vector<rhi::TextureDesc> descs;
    for (uint32_t i = 0; i < textureCount; i++)
        descs.push_back(textureDesc(desc, textures[i], names[i].c_str(), tag.c_str()));

    const Placement placement = place(device, descs);
    m_byteSize = placement.size;
    if (placement.memoryTypeBits != 0)
        m_memory = device.createMemory({placement.size, placement.memoryTypeBits, tag.c_str(), tag.c_str()});
    for (uint32_t i = 0; i < textureCount; i++)
    {
        Slot slot;
        slot.texture = m_memory ? device.createPlacedTexture(descs[i], *m_memory, placement.offsets[i])
                                : device.createTexture(descs[i]);
        slot.sampled = device.createView(*slot.texture, {rhi::ViewType::Sampled, {0, 1}});
        slot.storage = device.createView(*slot.texture, {rhi::ViewType::Storage, {0, 1}});
        m_slots.push_back(std::move(slot));
    }
}

Pools::Pools(rhi::Device& device, const PoolsDesc& desc, const InstanceDesc& instance)
    : states(instance.permanentPoolSize + instance.transientPoolSize + static_cast<uint32_t>(ResourceType::MAX_NUM)),
      bufferStates(instance.buffersNum),
      m_permanent(device, desc, instance.permanentPool, instance.permanentPoolSize, 'P'),
      m_transient(device, desc, instance.transientPool, instance.transientPoolSize, 'T')
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
