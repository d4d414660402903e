#include "allocation_counter.h"
#include "fixture.h"
#include <chrono>
#include <cstdlib>
#include <map>

using namespace test;

namespace
{
// Counts, checks sizes on release, and fails at the k-th call.
struct Heap
{
    std::map<void*, size_t> blocks;
    size_t callNum = 0;
    size_t failAt = ~size_t{0};
    size_t badAlignments = 0;
    size_t foreignFrees = 0;

    static void* allocate(void* userArg, size_t byteSize, size_t alignment)
    {
        Heap& heap = *static_cast<Heap*>(userArg);
        if (heap.callNum++ == heap.failAt) return nullptr;
        if (alignment == 0 || (alignment & (alignment - 1)) != 0) heap.badAlignments++;
        void* memory = std::aligned_alloc(alignment, (byteSize + alignment - 1) / alignment * alignment);
        heap.blocks[memory] = byteSize;
        return memory;
    }
    static void* reallocate(void*, void*, size_t, size_t) { return nullptr; }
    static void release(void* userArg, void* memory)
    {
        Heap& heap = *static_cast<Heap*>(userArg);
        if (heap.blocks.erase(memory) == 0) heap.foreignFrees++;
        std::free(memory);
    }
    AllocationCallbacks callbacks() { return {allocate, reallocate, release, this}; }
};

const std::vector<Denoiser> kFour = {kReblurBoth, Denoiser::REFERENCE, kReblurBoth, Denoiser::REFERENCE};
const std::vector<Identifier> kFourIdentifiers = {0, 1, 2, 3};

InstanceCreationDesc withCallbacks(Heap& heap)
{
    InstanceCreationDesc desc;
    desc.allocationCallbacks = heap.callbacks();
    return desc;
}
} // namespace

TEST_CASE("all memory of an instance goes through the callbacks and is given back", "[unit]")
{
    Heap heap;
    InstancePtr instance = makeInstance(kFour, withCallbacks(heap));
    CHECK(heap.blocks.size() > 0);
    instance.reset();
    CHECK(heap.blocks.empty());
    CHECK(heap.badAlignments == 0);
    CHECK(heap.foreignFrees == 0);

    const std::vector<DenoiserDesc> descs = {{0, kReblurBoth}, {1, Denoiser::REFERENCE}};
    InstanceCreationDesc desc = withCallbacks(heap);
    desc.denoisers = descs.data();
    desc.denoisersNum = 2;
    Instance* raw = nullptr;
    const size_t before = allocationNum();
    const Result result = CreateInstance(desc, raw);
    const size_t after = allocationNum();
    const size_t blockNum = heap.blocks.size();
    DestroyInstance(raw);
    CHECK(result == Result::SUCCESS);
    // The map of the counting heap takes one node per block from the global heap; the library takes nothing.
    CHECK(after - before <= blockNum + heap.callNum);
    CHECK(heap.blocks.empty());
}

TEST_CASE("an allocation that fails at any call gives FAILURE, no instance and no leak", "[unit]")
{
    Heap probe;
    makeInstance(kFour, withCallbacks(probe)).reset();
    REQUIRE(probe.callNum > 5);
    for (size_t k = 0; k < probe.callNum; k++)
    {
        INFO("call " << k);
        Heap heap;
        heap.failAt = k;
        Messages messages;
        const std::vector<DenoiserDesc> descs = {{0, kFour[0]}, {1, kFour[1]}, {2, kFour[2]}, {3, kFour[3]}};
        InstanceCreationDesc desc = withCallbacks(heap);
        desc.messageSink = messages.sink();
        desc.denoisers = descs.data();
        desc.denoisersNum = 4;
        Instance* instance = reinterpret_cast<Instance*>(&heap); // must be overwritten
        CHECK(CreateInstance(desc, instance) == Result::FAILURE);
        CHECK(instance == nullptr);
        CHECK(heap.blocks.empty());
        CHECK(heap.foreignFrees == 0);
        REQUIRE(messages.texts.size() == 1);
        CHECK_THAT(messages.texts[0], containing("memory"));
    }
}

TEST_CASE("settings and dispatches allocate nothing", "[unit]")
{
    Heap heap;
    const InstancePtr instance = makeInstance(kFour, withCallbacks(heap));
    CommonSettings common = makeCommon();
    ReblurSettings reblur;
    ReferenceSettings reference;
    const DispatchDesc* dispatches = nullptr;
    const ResourceRequirement* requirements = nullptr;
    uint32_t num = 0;
    const size_t callsBefore = heap.callNum;
    const size_t newsBefore = allocationNum();
    bool isFine = true;
    for (uint32_t frame = 0; frame < 8; frame++)
    {
        common.frameIndex = frame;
        common.splitScreen = frame == 5 ? 0.5f : 0.0f;
        common.isHistoryConfidenceAvailable = frame > 3;
        common.accumulationMode = frame == 6 ? AccumulationMode::CLEAR_AND_RESTART : AccumulationMode::CONTINUE;
        reblur.maxStabilizedFrameNum = frame % 2 == 0 ? 0 : 63;
        isFine = isFine && SetCommonSettings(*instance, common) == Result::SUCCESS;
        isFine = isFine && SetDenoiserSettings(*instance, 0, reblur) == Result::SUCCESS;
        isFine = isFine && SetDenoiserSettings(*instance, 1, reference) == Result::SUCCESS;
        isFine = isFine && GetRequiredResources(*instance, 0, requirements, num) == Result::SUCCESS;
        isFine =
            isFine && GetComputeDispatches(*instance, kFourIdentifiers.data(), 4, dispatches, num) == Result::SUCCESS;
        isFine = isFine && GetComputeDispatches(*instance, kFourIdentifiers.data(), 4, dispatches, num) ==
                               Result::INVALID_ARGUMENT; // refusals do not allocate either
    }
    const size_t newsAfter = allocationNum();
    CHECK(isFine);
    CHECK(heap.callNum == callsBefore);
    CHECK(newsAfter == newsBefore);
}

TEST_CASE("what is reserved is enough for every denoiser with everything on", "[unit]")
{
    const InstancePtr instance = makeInstance(kFour);
    const DescriptorPoolDesc& totals = GetInstanceDesc(*instance).descriptorPoolDesc;
    CommonSettings common = makeCommon();
    common.splitScreen = 0.5f;
    common.isHistoryConfidenceAvailable = common.isDisocclusionThresholdMixAvailable = true;
    common.isSpecularMotionAvailable = true;
    common.enableValidation = true;
    ReblurSettings reblur;
    reblur.prePassMode = PrePassMode::SIMPLE;
    for (Identifier i : kFourIdentifiers)
        if (kFour[i] != Denoiser::REFERENCE) REQUIRE(SetDenoiserSettings(*instance, i, reblur) == Result::SUCCESS);
    const std::vector<DispatchDesc> dispatches = requestFrame(*instance, common, kFourIdentifiers);

    DescriptorPoolDesc used = {};
    for (const DispatchDesc& dispatch : dispatches)
    {
        const PipelineDesc& pipeline = GetInstanceDesc(*instance).pipelines[dispatch.pipelineIndex];
        used.setsMaxNum += pipeline.hasConstantData ? 2 : 1;
        used.constantBuffersMaxNum += pipeline.hasConstantData ? 1 : 0;
        used.samplersMaxNum += pipeline.hasConstantData ? GetInstanceDesc(*instance).samplersNum : 0;
        used.texturesMaxNum += pipeline.texturesNum;
        used.storageTexturesMaxNum += pipeline.storageTexturesNum;
        CHECK(dispatch.resourcesNum == pipeline.texturesNum + pipeline.storageTexturesNum);
    }
    CHECK(used.setsMaxNum == totals.setsMaxNum);
    CHECK(used.constantBuffersMaxNum == totals.constantBuffersMaxNum);
    CHECK(used.samplersMaxNum == totals.samplersMaxNum);
    CHECK(used.texturesMaxNum == totals.texturesMaxNum);
    CHECK(used.storageTexturesMaxNum == totals.storageTexturesMaxNum);
    CHECK(totals.storageBuffersMaxNum == 0);
}

TEST_CASE("a frame of dispatches takes microseconds", "[unit]")
{
    const InstancePtr instance = makeInstance({kReblurBoth});
    CommonSettings common = makeCommon();
    const Identifier identifier = 0;
    const DispatchDesc* dispatches = nullptr;
    uint32_t num = 0;
    constexpr uint32_t kFrameNum = 2000;
    std::chrono::duration<double, std::micro> settings{}, emission{};
    bool isFine = true;
    for (uint32_t frame = 0; frame < kFrameNum; frame++)
    {
        common.frameIndex = frame;
        const auto start = std::chrono::steady_clock::now();
        isFine = isFine && SetCommonSettings(*instance, common) == Result::SUCCESS;
        const auto middle = std::chrono::steady_clock::now();
        isFine = isFine && GetComputeDispatches(*instance, &identifier, 1, dispatches, num) == Result::SUCCESS;
        const auto end = std::chrono::steady_clock::now();
        settings += middle - start;
        emission += end - middle;
    }
    CHECK(isFine);
    CHECK(num == 5);
    WARN("SetCommonSettings " << settings.count() / kFrameNum << " us, GetComputeDispatches "
                              << emission.count() / kFrameNum << " us (" << num << " dispatches)");
}
