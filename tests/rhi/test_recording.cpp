#include "catch.h"
#include "fixture.h"
#include "gpu.h"
#include <algorithm>
#include <rhi/recording.h>

using namespace rhi;
using namespace rhi::test;

namespace
{
constexpr BindingDesc kTextureToTexture[] = {{0, 0, BindingType::SampledTexture}, {0, 1, BindingType::StorageTexture}};

TextureDesc textureDesc(const char* name)
{
    TextureDesc desc;
    desc.format = Format::R32_UINT;
    desc.width = 64;
    desc.height = 32;
    desc.mipCount = 2;
    desc.usage = TextureUsage::Sampled | TextureUsage::Storage;
    desc.name = name;
    desc.memoryTag = "pool";
    return desc;
}

std::vector<CallType> typesOf(const RecordingDevice& device)
{
    std::vector<CallType> types;
    for (const RecordedCall& call : device.calls()) types.push_back(call.type);
    return types;
}
} // namespace

TEST_CASE("the recording device keeps what was recorded, in order and by name", "[unit]")
{
    const auto device = makeRecordingDevice();
    const auto in = device->createTexture(textureDesc("in"));
    const auto out = device->createTexture(textureDesc("out"));
    const auto inView = device->createView(*in, {ViewType::Sampled, {1, 1}});
    const auto outView = device->createView(*out, {ViewType::Storage, {0, 1}});
    const Pass pass(*device, Shader::CopyUint, kTextureToTexture, {{3, 4}}, "copy");
    const auto commands = device->createCommandBuffer("frame");
    const auto fence = device->createFence("fence");
    device->clearCalls();

    const DescriptorWrite writes[] = {viewAt(0, *inView), viewAt(1, *outView)};
    pass.set(0).write(writes);
    commands->begin();
    commands->barrier(TextureBarrier{out.get(), states::kUndefined, states::kStorageWrite, {0, 1}});
    pass.record(*commands, 8, 4);
    commands->dispatch(8, 0, 1);
    commands->end();
    CommandBuffer* const list[] = {commands.get()};
    CHECK_FALSE(fence->isSignaled());
    device->submit(list, fence.get());
    CHECK(fence->wait());

    using enum CallType;
    CHECK(typesOf(*device) ==
          std::vector<CallType>{WriteSet, Begin, Barriers, BindPipeline, BindSet, Dispatch, End, Submit});
    const std::vector<RecordedCall>& calls = device->calls();
    CHECK(calls[0].bindings.at(0).name == "in");
    CHECK(calls[0].bindings.at(0).mips.first == 1);
    CHECK(calls[0].bindings.at(0).layout == Layout::ShaderReadOnly);
    CHECK(calls[0].bindings.at(1).name == "out");
    CHECK(calls[0].bindings.at(1).layout == Layout::General);
    CHECK(calls[2].barriers.at(0).name == "out");
    CHECK(calls[2].barriers.at(0).after == states::kStorageWrite);
    CHECK(calls[3].name == "copy");
    CHECK(calls[4].handle == calls[0].handle); // the set that was written is the one bound
    CHECK(calls[5].groups[0] == 8);
    CHECK(calls[5].groups[1] == 4);
}

TEST_CASE("the recording device fails the creation it was told to, once", "[unit]")
{
    const auto device = makeRecordingDevice();
    {
        device->failCreation(2, ErrorCode::OutOfDeviceMemory);
        const auto first = device->createTexture(textureDesc("first"));
        CHECK_THROWS_WITH(device->createTexture(textureDesc("second")), containing("'second'"));
        const auto third = device->createTexture(textureDesc("third"));
        CHECK(device->objectCount() == 2);
        const std::vector<MemoryReportLine> report = device->memoryReport();
        REQUIRE(report.size() == 1);
        CHECK(report[0].allocationCount == 2);
    }
    CHECK(device->objectCount() == 0);
    CHECK(device->memoryReport().empty());
}

TEST_CASE("the recording device checks what a real one checks", "[unit]")
{
    RecordingDeviceDesc desc;
    desc.unsupportedFormats = {Format::R32_UINT};
    const auto poor = makeRecordingDevice(desc);
    CHECK_THROWS_WITH(poor->createTexture(textureDesc("t")), containing("format R32_UINT"));
    const auto device = makeRecordingDevice();
    const auto texture = device->createTexture(textureDesc("t"));
    CHECK_THROWS_WITH(device->createView(*texture, {ViewType::Storage, {0, 2}}), containing("expected exactly 1"));
    CHECK_THROWS_WITH(device->createView(*texture, {ViewType::Sampled, {1, 2}}), containing("do not exist"));
    Pass pass(*device, Shader::CopyUint, kTextureToTexture);
    const auto pool = device->createDescriptorPool({8, 0, 0, 1, 1, 0, "small"});
    pool->allocate(pass.pipeline(), 0);
    CHECK_THROWS_AS(pool->allocate(pass.pipeline(), 0), Error);
    pool->reset();
    CHECK_NOTHROW(pool->allocate(pass.pipeline(), 0));
}

TEST_CASE("upload and readback buffers of the recording device are real memory", "[unit]")
{
    const auto device = makeRecordingDevice();
    const auto buffer = makeBuffer(*device, 16, BufferUsage::Uniform, BufferMemory::Upload, "constants");
    mappedAs<uint32_t>(*buffer)[3] = 7;
    CHECK(mappedAs<uint32_t>(*buffer)[3] == 7);
    const auto remote = makeBuffer(*device, 16, BufferUsage::Uniform, BufferMemory::Device, "remote");
    CHECK(remote->mapped() == nullptr);
}
