#include "function_runner.h"
#include "catch.h"
#include "functions.h"
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <nrd_test_lib_shaders.h>
#include <rhi/rhi.h>
#include <rhi/vulkan.h>

namespace nrdtest
{
namespace
{
// Layer messages arrive on any thread, so they are kept and looked at by the test's own.
struct Messages
{
    std::mutex mutex;
    std::vector<std::string> texts;
};

Messages& messages()
{
    static Messages instance;
    return instance;
}

std::unique_ptr<rhi::Device> makeDevice()
{
    rhi::VulkanDeviceDesc desc;
    if (const char* name = std::getenv("NRD_TEST_DEVICE")) desc.adapter = name;
    desc.isValidationEnabled = std::getenv("NRD_TEST_NO_VALIDATION") == nullptr;
    desc.isSyncValidationEnabled = desc.isValidationEnabled;
    desc.messageCallback = [](rhi::MessageSeverity severity, const std::string& text)
    {
        if (severity == rhi::MessageSeverity::Info) return;
        std::lock_guard lock(messages().mutex);
        messages().texts.push_back(text);
    };
    return rhi::makeVulkanDevice(desc);
}

rhi::Device& device()
{
    static std::unique_ptr<rhi::Device> instance = makeDevice();
    return *instance;
}

std::unique_ptr<rhi::Buffer> makeBuffer(size_t byteSize, rhi::BufferMemory memory)
{
    rhi::BufferDesc desc;
    desc.size = byteSize;
    desc.usage = rhi::BufferUsage::Storage;
    desc.memory = memory;
    return device().createBuffer(desc);
}

std::unique_ptr<rhi::Pipeline> makePipeline(int function)
{
    const ShaderBlob blob = shaderBlob(function < FN_FALLOFFS ? Shader::FrontEndFunctions : Shader::LibraryFunctions);
    const rhi::BindingDesc bindings[] = {{0, 0, rhi::BindingType::StorageBuffer},
                                         {0, 1, rhi::BindingType::StorageBuffer}};
    const rhi::SpecConstant constants[] = {{0, static_cast<uint32_t>(function)}};
    rhi::PipelineDesc desc;
    desc.spirv = {blob.words, blob.byteSize / 4};
    desc.bindings = bindings;
    desc.constants = constants;
    desc.name = blob.name;
    return device().createPipeline(desc);
}

void submitAndWait(rhi::CommandBuffer& commands)
{
    const auto fence = device().createFence("functions");
    rhi::CommandBuffer* const list[] = {&commands};
    device().submit(list, fence.get());
    fence->wait();
}
} // namespace

std::vector<Results> runFunction(int function, const std::vector<Arguments>& arguments)
{
    const size_t count = arguments.size();
    const auto in = makeBuffer(count * sizeof(Arguments), rhi::BufferMemory::Upload);
    const auto out = makeBuffer(count * sizeof(Results), rhi::BufferMemory::Readback);
    std::memcpy(in->mapped(), arguments.data(), count * sizeof(Arguments));
    const auto pipeline = makePipeline(function);
    rhi::DescriptorPoolDesc poolDesc;
    poolDesc.sets = 1;
    poolDesc.storageBuffers = 2;
    const auto pool = device().createDescriptorPool(poolDesc);
    rhi::DescriptorSet& set = pool->allocate(*pipeline, 0);
    rhi::DescriptorWrite writes[2];
    writes[0].buffer = in.get();
    writes[0].size = in->desc().size;
    writes[1].binding = 1;
    writes[1].buffer = out.get();
    writes[1].size = out->desc().size;
    set.write(writes);
    const auto commands = device().createCommandBuffer("functions");
    commands->begin();
    commands->bindPipeline(*pipeline);
    commands->bindSet(0, set, {});
    commands->dispatch(static_cast<uint32_t>((count + 63) / 64), 1, 1);
    commands->barrier(rhi::BufferBarrier{out.get(), rhi::BufferState{rhi::Access::StorageWrite, rhi::Stage::Compute},
                                         rhi::BufferState{rhi::Access::HostRead, rhi::Stage::Host}});
    commands->end();
    submitAndWait(*commands);
    std::vector<Results> results(count);
    std::memcpy(results.data(), out->mapped(), count * sizeof(Results));
    std::lock_guard lock(messages().mutex);
    for (const std::string& text : messages().texts) FAIL_CHECK(text);
    messages().texts.clear();
    return results;
}

Results runFunction(int function, const Arguments& arguments)
{
    return runFunction(function, std::vector<Arguments>{arguments})[0];
}
} // namespace nrdtest
