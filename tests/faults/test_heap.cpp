// Every allocation is made to fail, one at a time: of an instance through its callbacks, of an integration through
// operator new.
#include "allocations.h"
#include "catch.h"
#include "injection.h"
#include "sweep.h"
#include "validated_device.h"
#include <cstdio>
#include <cstdlib>
#include <map>

using namespace faults;

namespace
{
// The heap of an instance, of which the k-th allocation fails.
struct Heap
{
    std::map<void*, size_t> blocks;
    size_t calls = 0;
    size_t failAt = 0; // 1 = the first
    size_t foreignFrees = 0;

    static void* allocate(void* self, size_t byteSize, size_t alignment)
    {
        Heap& heap = *static_cast<Heap*>(self);
        if (++heap.calls == heap.failAt) return nullptr;
        void* const memory = std::aligned_alloc(alignment, (byteSize + alignment - 1) / alignment * alignment);
        heap.blocks[memory] = byteSize;
        return memory;
    }
    static void* reallocate(void*, void*, size_t, size_t) { return nullptr; }
    static void release(void* self, void* memory)
    {
        Heap& heap = *static_cast<Heap*>(self);
        if (heap.blocks.erase(memory) == 0) heap.foreignFrees++;
        std::free(memory);
    }
};

void keepMessage(void* text, nrd::Result, const char* message) { *static_cast<std::string*>(text) = message; }

// The allocation that creation failed at, or 0 once it succeeds.
size_t failCreation(std::span<const nrd::Denoiser> denoisers, size_t allocation)
{
    Heap heap;
    heap.failAt = allocation;
    std::string message;
    std::vector<nrd::DenoiserDesc> descs;
    for (const nrd::Denoiser denoiser : denoisers)
        descs.push_back({static_cast<nrd::Identifier>(descs.size()), denoiser});
    nrd::InstanceCreationDesc desc;
    desc.allocationCallbacks = {Heap::allocate, Heap::reallocate, Heap::release, &heap};
    desc.messageSink = {keepMessage, &message};
    desc.denoisers = descs.data();
    desc.denoisersNum = static_cast<uint32_t>(descs.size());
    nrd::Instance* instance = nullptr;
    const nrd::Result result = nrd::CreateInstance(desc, instance);
    const bool hasFailed = heap.calls >= allocation;
    INFO("allocation " << allocation << " of " << nrd::toString(denoisers[0]) << ": " << message);
    CHECK((result == nrd::Result::FAILURE) == hasFailed);
    CHECK((instance == nullptr) == hasFailed);
    if (hasFailed) CHECK_THAT(message, containing("memory"));
    nrd::DestroyInstance(instance);
    CHECK(heap.blocks.empty());
    CHECK(heap.foreignFrees == 0);
    return hasFailed ? allocation : 0;
}

size_t failEveryAllocation(std::span<const nrd::Denoiser> denoisers)
{
    size_t allocation = 1;
    while (failCreation(denoisers, allocation) != 0) allocation++;
    CHECK(allocation > 1);
    return allocation - 1;
}

class HeapInjector final : public Injector
{
public:
    void failNth(size_t n) override { m_left = n; }
    void stop() override { m_left = 0; }
    void attach(Session& session) override
    {
        session.make = [this, &session](const char* name, const Session::Call& call)
        {
            if (isFailing(session, name, call)) REQUIRE_FALSE(isFailing(session, name, call));
        };
    }

private:
    bool isFailing(Session& session, const char* name, const Session::Call& call)
    {
        nrd::Result result = nrd::Result::SUCCESS;
        size_t count = 0;
        {
            const test::AllocationWatch watch(m_left);
            result = call();
            count = watch.count();
        }
        const bool hasFailed = m_left != 0 && count >= m_left;
        m_left = hasFailed || m_left == 0 ? 0 : m_left - count;
        m_faultNum += hasFailed;
        INFO(name << ", allocation " << count << ": " << session.message());
        // Files of a dump are written by the way: what fails there is told, and the dump ends.
        const bool isByTheWay = hasFailed && result == nrd::Result::SUCCESS && name == std::string("NewFrame");
        REQUIRE((result != nrd::Result::SUCCESS) == (hasFailed && !isByTheWay));
        if (isByTheWay) CHECK_THAT(session.message(), containing("DumpInputs(): out of host memory"));
        if (!hasFailed || isByTheWay) return false;
        CHECK_THAT(session.message(), containing("memory"));
        return true;
    }

    size_t m_left = 0; // allocations until the one that fails; 0 = none does
};

size_t faultsIn(void (*sweep)(Injector&, const SessionDesc&), const SessionDesc& desc)
{
    HeapInjector injector;
    const ptrdiff_t before = test::liveAllocations();
    sweep(injector, desc);
    CHECK(test::liveAllocations() == before);
    const Census alive = census();
    INFO(toString(alive));
    CHECK(alive.alive.empty());
    CHECK(alive.foreign == 0);
    test::failOnMessages();
    return injector.faultNum();
}
} // namespace

TEST_CASE("an instance of any denoiser survives the failure of any of its allocations", "[unit]")
{
    size_t faultNum = 0;
    for (const nrd::Denoiser& denoiser : options::allDenoisers()) faultNum += failEveryAllocation({&denoiser, 1});
    faultNum += failEveryAllocation(options::allDenoisers());
    std::printf("FIGURE Failed allocations of instances: %zu survived and reported\n", faultNum);
}

TEST_CASE("an integration survives the failure of any allocation of its calls", "[gpu]")
{
    size_t created = 0, resized = 0, framed = 0;
    for (const SessionDesc& desc : allSets())
    {
        created += faultsIn(sweepCreation, desc);
        resized += faultsIn(sweepResizing, desc);
        framed += faultsIn(sweepFrames, desc);
    }
    SessionDesc reference = smallSet();
    reference.denoisers = {nrd::Denoiser::REFERENCE}; // its pipelines are few and small
    framed += faultsIn(sweepFirstFrame, reference);
    const size_t diagnosed = faultsIn(sweepDiagnosis, reblurAlone());
    const size_t dumped = faultsIn(sweepDump, reblurAlone());
    std::printf("FIGURE Failed allocations of integrations: %zu in Create, %zu in Resize, %zu in frames, %zu in "
                "diagnoses, %zu in dumps, survived and reported\n",
                created, resized, framed, diagnosed, dumped);
}
