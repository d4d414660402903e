#include "function_runner.h"
#include "functions.h"
#include "validated_device.h"
#include <cstring>
#include <nrd_test_lib_shaders.h>

namespace nrdtest
{
namespace
{
std::unique_ptr<rhi::Buffer> makeBuffer(size_t byteSize, rhi::BufferMemory memory)
{
    rhi::BufferDesc desc;
    desc.size = byteSize;
    desc.usage = rhi::BufferUsage::Storage;
    desc.memory = memory;
    return test::validatedDevice().createBuffer(desc);
}

Shader hlslShaderOf(int function)
{
    if (function >= FN_FIRST_OF_SHADOW) return Shader::ShadowFunctionsHlsl;
    return function >= FN_FIRST_OF_RESOLVE ? Shader::ResolveFunctionsHlsl : Shader::FrontEndFunctionsHlsl;
}

Shader shaderOf(int function)
{
    if (function >= FN_FIRST_OF_PASSES) return Shader::PassFunctions;
    if (function >= FN_FIRST_OF_SHADOW_PACKING) return Shader::ShadowPackingFunctions;
    if (function >= FN_FIRST_OF_SHADOW) return Shader::ShadowFunctions;
    if (function >= FN_FIRST_OF_RESOLVE) return Shader::ResolveFunctions;
    return function < FN_FALLOFFS ? Shader::FrontEndFunctions : Shader::LibraryFunctions;
}

std::unique_ptr<rhi::Pipeline> makePipeline(int function, Language language)
{
    const ShaderBlob blob = shaderBlob(language == Language::Hlsl ? hlslShaderOf(function) : shaderOf(function));
    const rhi::BindingDesc bindings[] = {{0, 0, rhi::BindingType::StorageBuffer},
                                         {0, 1, rhi::BindingType::StorageBuffer},
                                         {0, 2, rhi::BindingType::StorageBuffer}};
    const rhi::SpecConstant constants[] = {{0, static_cast<uint32_t>(function)}};
    rhi::PipelineDesc desc;
    desc.spirv = {blob.words, blob.byteSize / 4};
    desc.bindings = bindings;
    desc.constants = constants;
    desc.name = blob.name;
    return test::validatedDevice().createPipeline(desc);
}
} // namespace

std::vector<Results> runFunction(int function, const std::vector<Arguments>& arguments,
                                 std::span<const nrd::shared::DenoiserConstants> frames, Language language)
{
    const size_t count = arguments.size();
    const nrd::shared::DenoiserConstants none = {};
    if (frames.empty()) frames = {&none, 1};
    const auto in = makeBuffer(count * sizeof(Arguments), rhi::BufferMemory::Upload);
    const auto out = makeBuffer(count * sizeof(Results), rhi::BufferMemory::Readback);
    const auto constants = makeBuffer(frames.size_bytes(), rhi::BufferMemory::Upload);
    std::memcpy(in->mapped(), arguments.data(), count * sizeof(Arguments));
    std::memcpy(constants->mapped(), frames.data(), frames.size_bytes());
    const auto pipeline = makePipeline(function, language);
    rhi::DescriptorPoolDesc poolDesc;
    poolDesc.sets = 1;
    poolDesc.storageBuffers = 3;
    const auto pool = test::validatedDevice().createDescriptorPool(poolDesc);
    rhi::DescriptorSet& set = pool->allocate(*pipeline, 0);
    rhi::DescriptorWrite writes[3];
    rhi::Buffer* const buffers[] = {in.get(), out.get(), constants.get()};
    for (uint32_t i = 0; i < 3; i++)
    {
        writes[i].binding = i;
        writes[i].buffer = buffers[i];
        writes[i].size = buffers[i]->desc().size;
    }
    set.write(writes);
    const auto commands = test::validatedDevice().createCommandBuffer("functions");
    commands->begin();
    commands->bindPipeline(*pipeline);
    commands->bindSet(0, set, {});
    commands->dispatch(static_cast<uint32_t>((count + 63) / 64), 1, 1);
    commands->barrier(rhi::BufferBarrier{out.get(), rhi::BufferState{rhi::Access::StorageWrite, rhi::Stage::Compute},
                                         rhi::BufferState{rhi::Access::HostRead, rhi::Stage::Host}});
    commands->end();
    test::submitAndWait(*commands);
    std::vector<Results> results(count);
    std::memcpy(results.data(), out->mapped(), count * sizeof(Results));
    test::failOnMessages();
    return results;
}

Results runFunction(int function, const Arguments& arguments)
{
    return runFunction(function, std::vector<Arguments>{arguments})[0];
}
} // namespace nrdtest
