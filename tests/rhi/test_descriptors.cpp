#include "catch.h"
#include "fixture.h"
#include "gpu.h"
#include <rhi/vulkan.h>

using namespace rhi;
using namespace rhi::test;

namespace
{
constexpr BindingDesc kOneBuffer[] = {{0, 0, BindingType::StorageBuffer}};

std::unique_ptr<Pipeline> makePipeline(Device& device)
{
    PipelineDesc desc;
    desc.spirv = spirvOf(Shader::Step);
    desc.bindings = kOneBuffer;
    desc.name = "step";
    return device.createPipeline(desc);
}

ErrorCode codeOf(const std::function<void()>& body)
{
    try
    {
        body();
    }
    catch (const Error& error)
    {
        CHECK(std::string(error.what()).find('\'') != std::string::npos); // it names an object
        return error.code();
    }
    FAIL("nothing was thrown");
    return ErrorCode::Failure;
}
} // namespace

TEST_CASE("a pool without sets or without descriptors left says so and stays usable", "[gpu]")
{
    forEachDevice(
        [](TestDevice& device)
        {
            const auto pipeline = makePipeline(*device);
            const auto data = makeBuffer(*device, 1024, BufferUsage::Storage, BufferMemory::Device, "data");
            DescriptorPoolDesc fewSets;
            fewSets.sets = 2;
            fewSets.storageBuffers = 9;
            fewSets.name = "few sets";
            DescriptorPoolDesc fewBuffers;
            fewBuffers.sets = 9;
            fewBuffers.storageBuffers = 2;
            fewBuffers.name = "few buffers";
            for (const DescriptorPoolDesc& desc : {fewSets, fewBuffers})
            {
                INFO(desc.name);
                const auto pool = device->createDescriptorPool(desc);
                for (int round = 0; round < 3; round++)
                {
                    DescriptorSet& first = pool->allocate(*pipeline, 0);
                    DescriptorSet& second = pool->allocate(*pipeline, 0);
                    CHECK(&first != &second);
                    CHECK(codeOf([&] { pool->allocate(*pipeline, 0); }) == ErrorCode::PoolExhausted);
                    const DescriptorWrite writes[] = {bufferAt(0, *data)};
                    second.write(writes); // the failure left what there was intact
                    run(*device,
                        [&](CommandBuffer& commands)
                        {
                            commands.bindPipeline(*pipeline);
                            commands.bindSet(0, second, {});
                            commands.dispatch(1, 1, 1);
                            commands.barrier(
                                BufferBarrier{data.get(),
                                              {Access::StorageRead | Access::StorageWrite, Stage::Compute},
                                              {Access::StorageRead | Access::StorageWrite, Stage::Compute}});
                        });
                    pool->reset();
                }
            }
        });
}

TEST_CASE("pipelines with equal bindings share a layout, so that one set serves both", "[gpu]")
{
    forEachDevice(
        [](TestDevice& device)
        {
            const auto a = makePipeline(*device);
            const auto b = makePipeline(*device);
            const auto data = makeBuffer(*device, 256, BufferUsage::Storage, BufferMemory::Readback, "data");
            mappedAs<uint32_t>(*data)[0] = 4;
            const auto pool = device->createDescriptorPool({1, 0, 0, 0, 0, 1, "one set"});
            DescriptorSet& set = pool->allocate(*a, 0);
            const DescriptorWrite writes[] = {bufferAt(0, *data)};
            set.write(writes);
            const BufferState storage = {Access::StorageRead | Access::StorageWrite, Stage::Compute};
            run(*device,
                [&](CommandBuffer& commands)
                {
                    commands.bindPipeline(*a);
                    commands.bindSet(0, set, {});
                    commands.dispatch(1, 1, 1);
                    commands.barrier(BufferBarrier{data.get(), storage, storage});
                    commands.bindPipeline(*b); // the set stays bound
                    commands.dispatch(1, 1, 1);
                    commands.barrier(BufferBarrier{data.get(), storage, {Access::HostRead, Stage::Host}});
                });
            CHECK(mappedAs<uint32_t>(*data)[0] == (4 * 3 + 1) * 3 + 1);
        });
}

TEST_CASE("a shader that cannot become a pipeline is refused with its name", "[gpu]")
{
    forEachDevice(
        [](TestDevice& device)
        {
            const auto refuse = [&](Span<const uint32_t> words)
            {
                PipelineDesc desc;
                desc.spirv = words;
                desc.bindings = kOneBuffer;
                desc.name = "bad";
                const ErrorCode code = codeOf([&] { device->createPipeline(desc); });
                CHECK(device.takeMisuses().size() == (device.isDecorated() ? 1 : 0));
                return code;
            };
            const uint32_t garbage[] = {1, 2, 3, 4, 5, 6};
            CHECK(refuse({}) == ErrorCode::InvalidShader);
            CHECK(refuse(garbage) == ErrorCode::InvalidShader);
            const Span<const uint32_t> good = spirvOf(Shader::Step);
            CHECK(refuse({good.data(), good.size() - 1}) == ErrorCode::InvalidShader);
            CHECK(refuse({good.data(), 5}) == ErrorCode::InvalidShader);             // no entry point
            CHECK(refuse(spirvOf(Shader::CopyFloat)) == ErrorCode::InvalidArgument); // binding 1 is missing
        });
}
