#include "arbitrary_integration.h"

namespace fuzz
{
using namespace nrd;

IntegrationCreationDesc arbitraryDesc(ByteReader& reader, uint32_t smallSize)
{
    IntegrationCreationDesc desc;
    const bool isWild = reader.below(8) == 0;
    const bool isSmall = reader.below(8) != 0;
    desc.name = reader.below(8) == 0 ? nullptr : reader.below(8) == 0 ? "%s%n" : "name";
    desc.resourceWidth = static_cast<uint16_t>(isSmall ? 1 + reader.below(smallSize) : reader.value<uint16_t>());
    desc.resourceHeight = static_cast<uint16_t>(isSmall ? 1 + reader.below(smallSize) : reader.value<uint16_t>());
    // Large numbers that are allowed only take memory: the ring of constants is real.
    desc.framesInFlight = isWild ? reader.value<uint32_t>() : reader.below(5);
    desc.maxDenoiseCallsPerFrame = isWild ? 1025 + reader.value<uint32_t>() % 0x80000000u : reader.below(4);
    desc.layoutPolicy = isWild ? reader.value<LayoutPolicy>() : static_cast<LayoutPolicy>(reader.below(2));
    desc.isGpuTimingEnabled = reader.flag();
    desc.createDefaultPipelines = reader.below(16) == 0;
    desc.isTransientMemoryShared = reader.below(4) == 0;
    desc.transientMemory = arbitraryMemory(reader);
    return desc;
}

NrdMemory arbitraryMemory(ByteReader& reader)
{
    if (reader.below(4) != 0) return {};
    NrdMemory memory = {reinterpret_cast<VkDeviceMemory>(uintptr_t{1 + reader.below(4)}), 0, 1u << 30, 0};
    if (reader.below(4) == 0) memory.offset = reader.flag() ? reader.below(4096) : reader.value<uint64_t>();
    if (reader.below(4) == 0) memory.size = reader.value<uint64_t>();
    if (reader.below(4) == 0) memory.memoryTypeIndex = reader.value<uint32_t>();
    return memory;
}

void changeImage(ByteReader& reader, NrdUserImage& image)
{
    constexpr uint32_t kEnumBits = 0x7FFFFFFF; // what Vulkan's enumerations can hold
    switch (reader.below(8))
    {
    case 0:
        image.image = reinterpret_cast<VkImage>(uintptr_t{reader.below(4)});
        break;
    case 1:
        image.format = static_cast<VkFormat>(reader.flag() ? reader.below(200) : reader.value<uint32_t>() & kEnumBits);
        break;
    case 2:
        image.width = reader.value<uint32_t>();
        break;
    case 3:
        image.height = reader.below(2);
        break;
    case 4:
        image.usage = reader.value<VkImageUsageFlags>();
        break;
    case 5:
        image.generation = reader.below(3);
        break;
    case 6:
        image.state.layout = static_cast<VkImageLayout>(reader.value<uint32_t>() & kEnumBits);
        break;
    default:
        image.state.access = reader.value<VkAccessFlags>();
        image.state.stages = reader.value<VkPipelineStageFlags>();
    }
}

void damagePool(ByteReader& reader, NrdUserPool& pool)
{
    for (uint32_t changes = reader.below(4); changes > 0; changes--)
        changeImage(reader, pool[static_cast<ResourceType>(reader.below(NrdUserPool::kSlotsNum + 2))]);
}
} // namespace fuzz
