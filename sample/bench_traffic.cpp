#include "bench_traffic.h"

#include <algorithm>
#include <set>
#include <tuple>

namespace sample::bench
{
namespace
{
constexpr uint32_t kTileSize = 16; // pixels, of the tiles that BufferDesc counts

uint64_t divideUp(uint32_t a, uint32_t b) { return (a + b - 1) / b; }

uint64_t byteSize(const nrd::InstanceDesc& instance, const nrd::ResourceDesc& resource, const SlotTexels& slots,
                  Extent size)
{
    if (resource.descriptorType == nrd::DescriptorType::STORAGE_BUFFER)
    {
        const nrd::BufferDesc& buffer = instance.buffers[resource.indexInPool];
        return buffer.byteSize +
               buffer.byteSizePerTile * divideUp(size.width, kTileSize) * divideUp(size.height, kTileSize);
    }
    const bool isPermanent = resource.type == nrd::ResourceType::PERMANENT_POOL;
    if (!isPermanent && resource.type != nrd::ResourceType::TRANSIENT_POOL)
    {
        const SlotTexel& slot = slots[static_cast<size_t>(resource.type)];
        return slot.byteSize * divideUp(size.width, slot.divisor) * divideUp(size.height, slot.divisor);
    }
    const nrd::TextureDesc& texture =
        (isPermanent ? instance.permanentPool : instance.transientPool)[resource.indexInPool];
    const uint32_t factor = std::max<uint32_t>(texture.downsampleFactor, 1);
    return nrd::texelByteSize(texture.format) * divideUp(size.width, factor) * divideUp(size.height, factor);
}
} // namespace

std::vector<PassTraffic> findTraffic(const nrd::InstanceDesc& instance, std::span<const nrd::DispatchDesc> dispatches,
                                     const SlotTexels& slots, Extent size)
{
    std::vector<PassTraffic> passes;
    for (const nrd::DispatchDesc& dispatch : dispatches)
    {
        const std::string name = passName(dispatch.name);
        auto pass = std::find_if(passes.begin(), passes.end(), [&](const PassTraffic& p) { return p.name == name; });
        if (pass == passes.end()) pass = passes.insert(pass, {name, 0});
        // An input that is not there is replaced by one that is bound anyhow.
        std::set<std::tuple<nrd::DescriptorType, nrd::ResourceType, uint16_t>> counted;
        for (const nrd::ResourceDesc& resource : std::span(dispatch.resources, dispatch.resourcesNum))
            if (counted.insert({resource.descriptorType, resource.type, resource.indexInPool}).second)
                pass->byteCount += byteSize(instance, resource, slots, size);
    }
    return passes;
}

std::string passName(const char* dispatchName)
{
    const std::string name = dispatchName;
    const size_t dash = name.find(" - ");
    return dash == std::string::npos ? name : name.substr(dash + 3);
}
} // namespace sample::bench
