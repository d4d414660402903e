// The pools' device memory from an application's allocator.
#include "application_allocator.h"
#include "recording_fixture.h"

using test::Allocator;
using test::RecordingFixture;
using test::require;
using test::requireRefusal;

TEST_CASE("an application's allocator gives the pools their memory, and gets it back when the GPU is done", "[unit]")
{
    RecordingFixture f({{3, nrd::Denoiser::REBLUR_DIFFUSE_SPECULAR}});
    f.desc.framesInFlight = 2;
    f.fillReblurSlots();
    Allocator allocator(*f.device);
    f.desc.deviceMemory = allocator.callbacks();
    f.requireCreated();
    CHECK(allocator.names == std::vector<std::string>{"NRD permanent", "NRD transient"});
    const nrd::MemoryStatistics memory = f.integration.GetMemoryStatistics();
    CHECK(memory.permanent + memory.transient == allocator.byteSize);
    CHECK(memory.total > allocator.byteSize); // with the constants
    f.beginFrame();
    require(f.denoise({3}), f.integration);
    f.width = f.height = 32;
    f.fillReblurSlots();
    allocator.isExhausted = true;
    CHECK(f.integration.Resize(32, 32) == nrd::Result::FAILURE);
    CHECK(std::string(f.integration.GetLastMessage()).find("deviceMemory.allocate() has no ") == 0);
    CHECK(allocator.given.size() == 2);
    allocator.isExhausted = false;
    require(f.integration.Resize(32, 32), f.integration);
    CHECK(allocator.given.size() == 4);
    for (uint32_t frame = 0; frame < 3; frame++)
    {
        CHECK(allocator.given.size() == (frame < 2 ? 4 : 3)); // scratch goes before history, which moves in the first
        f.beginFrame();
        require(f.denoise({3}), f.integration);
    }
    CHECK(allocator.given.size() == 2);
    f.integration.Destroy();
    CHECK(allocator.given.empty());
    CHECK(allocator.byteSize == 0);
}

TEST_CASE("an allocator that is half there, or gives what does not serve, is refused with its name", "[unit]")
{
    RecordingFixture f({{3, nrd::Denoiser::REBLUR_DIFFUSE_SPECULAR}});
    Allocator allocator(*f.device);
    f.desc.deviceMemory = allocator.callbacks();
    f.desc.deviceMemory.free = nullptr;
    requireRefusal(f.create(), f.integration, "deviceMemory.free is null, but deviceMemory.allocate is not");
    f.desc.deviceMemory = {nullptr, Allocator::free, &allocator};
    requireRefusal(f.create(), f.integration, "deviceMemory.allocate is null, but deviceMemory.free is not");
    static uint32_t freed = 0;
    freed = 0;
    f.desc.deviceMemory.free = [](void*, const nrd::NrdMemory&) { freed++; };
    f.desc.deviceMemory.allocate = [](void*, const VkMemoryRequirements&, const char*, nrd::NrdMemory&)
    { return true; };
    requireRefusal(f.create(), f.integration, "deviceMemory.allocate() returned true, but memory is null");
    f.desc.deviceMemory.allocate = [](void*, const VkMemoryRequirements& needs, const char*, nrd::NrdMemory& memory)
    {
        memory = {reinterpret_cast<VkDeviceMemory>(uintptr_t(0xABC)), 0, needs.size - 1, 0};
        return true;
    };
    CHECK(f.create() == nrd::Result::INVALID_ARGUMENT);
    CHECK(std::string(f.integration.GetLastMessage()).find("deviceMemory.allocate(): memory.size is ") == 0);
    CHECK(freed == 2);
    CHECK(f.device->objectCount() == 0);
}
