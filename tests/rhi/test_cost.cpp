// What recording costs: no allocation once a command buffer has seen its largest batch, and microseconds.
#include "catch.h"
#include "fixture.h"
#include "gpu.h"
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <new>
#include <rhi/vulkan.h>

using namespace rhi;
using namespace rhi::test;

namespace
{
std::atomic<uint64_t> gAllocationCount = 0;
}

// Replaces the allocation functions of the whole program, so that every allocation by C++ code is counted; all forms
// but the aligned ones, since those that a sanitizer brings would not fit to these.
void* operator new(std::size_t size)
{
    gAllocationCount++;
    if (void* memory = std::malloc(size)) return memory;
    throw std::bad_alloc();
}
void* operator new[](std::size_t size) { return operator new(size); }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept
{
    try
    {
        return operator new(size);
    }
    catch (const std::bad_alloc&)
    {
        return nullptr;
    }
}
void* operator new[](std::size_t size, const std::nothrow_t& tag) noexcept { return operator new(size, tag); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

namespace
{
constexpr BindingDesc kTextureToTexture[] = {{0, 0, BindingType::SampledTexture}, {0, 1, BindingType::StorageTexture}};

std::unique_ptr<Device> makeUnvalidated(bool isSynchronization2Allowed)
{
    VulkanDeviceDesc desc; // without layers, which allocate
    if (const char* wanted = std::getenv("NRD_TEST_DEVICE")) desc.adapter = wanted;
    desc.isSynchronization2Allowed = isSynchronization2Allowed;
    return makeVulkanDevice(desc);
}

void recordFrame(CommandBuffer& commands, const Pass& pass, const Texture& a, const Texture& b)
{
    for (int i = 0; i < 10; i++)
    {
        const TextureBarrier barriers[] = {{&a, states::kUndefined, states::kSampled, {}},
                                           {&b, states::kUndefined, states::kStorageWrite, {}}};
        commands.barriers(barriers, {});
        pass.record(commands, 2, 2);
    }
}
} // namespace

TEST_CASE("recording ten dispatches with barriers allocates nothing and takes microseconds", "[gpu]")
{
    const DeviceFactory factories[] = {
        {"Vulkan without layers", [](Messages&, Messages&) { return makeUnvalidated(true); }},
        {"Vulkan without layers, barriers of 1.0", [](Messages&, Messages&) { return makeUnvalidated(false); }}};
    forEach({std::begin(factories), std::end(factories)},
            [](TestDevice& device)
            {
                TextureDesc desc;
                desc.format = Format::R32_UINT;
                desc.width = desc.height = 16;
                desc.usage = TextureUsage::Sampled | TextureUsage::Storage;
                const auto a = device->createTexture(desc);
                const auto b = device->createTexture(desc);
                const auto aView = device->createView(*a, {ViewType::Sampled, {}});
                const auto bView = device->createView(*b, {ViewType::Storage, {}});
                Pass pass(*device, Shader::CopyUint, kTextureToTexture);
                pass.write(0, {viewAt(0, *aView), viewAt(1, *bView)});
                const auto commands = device->createCommandBuffer("cost");
                double best = 1e9;
                uint64_t allocationCount = 0;
                for (int frame = 0; frame < 20; frame++)
                {
                    commands->begin();
                    const uint64_t before = gAllocationCount;
                    const auto start = std::chrono::steady_clock::now();
                    recordFrame(*commands, pass, *a, *b);
                    const std::chrono::duration<double, std::micro> elapsed = std::chrono::steady_clock::now() - start;
                    allocationCount = gAllocationCount - before;
                    best = std::min(best, elapsed.count());
                    commands->end();
                }
                REQUIRE(gAllocationCount > 0); // the counter counts
                CHECK(allocationCount == 0);
                CHECK(best < 200.0); // tens of microseconds on any machine, with room for a busy one
            });
}
