#include "dispatch_promises.h"
#include "fuzz.h"

namespace fuzz
{
namespace
{
void checkResource(const nrd::InstanceDesc& instance, const nrd::ResourceDesc& resource)
{
    require(resource.type < nrd::ResourceType::MAX_NUM, "a resource has a type");
    require(resource.descriptorType < nrd::DescriptorType::MAX_NUM, "a resource has a descriptor type");
    if (resource.descriptorType == nrd::DescriptorType::STORAGE_BUFFER)
        require(resource.indexInPool < instance.buffersNum, "a buffer exists");
    else if (resource.type == nrd::ResourceType::TRANSIENT_POOL)
        require(resource.indexInPool < instance.transientPoolSize, "a transient texture exists");
    else if (resource.type == nrd::ResourceType::PERMANENT_POOL)
        require(resource.indexInPool < instance.permanentPoolSize, "a permanent texture exists");
}
} // namespace

void checkDispatch(const nrd::InstanceDesc& instance, const nrd::DispatchDesc& dispatch)
{
    require(dispatch.name && *dispatch.name, "a dispatch has a name");
    require(dispatch.gridWidth > 0 && dispatch.gridHeight > 0, "a dispatch has groups");
    require(dispatch.pipelineIndex < instance.pipelinesNum, "a pipeline exists");
    const nrd::PipelineDesc& pipeline = instance.pipelines[dispatch.pipelineIndex];
    require(dispatch.resourcesNum == pipeline.texturesNum + pipeline.storageTexturesNum + pipeline.storageBuffersNum,
            "a dispatch binds what its pipeline declares");
    for (uint32_t i = 0; i < dispatch.resourcesNum; i++) checkResource(instance, dispatch.resources[i]);
    require(pipeline.hasConstantData == (dispatch.constantBufferData != nullptr), "constants are there if used");
    require(dispatch.constantBufferDataSize <= instance.constantBufferMaxDataSize, "constants fit the buffer");
    volatile uint8_t last = 0; // read, so that AddressSanitizer sees the whole of them
    for (uint32_t i = 0; i < dispatch.constantBufferDataSize; i++) last = dispatch.constantBufferData[i];
    (void)last;
    if (dispatch.indirectBufferIndex == nrd::kNoBuffer) return;
    require(dispatch.indirectBufferIndex < instance.buffersNum, "an indirect buffer exists");
    require(instance.buffers[dispatch.indirectBufferIndex].isIndirectArguments, "an indirect buffer is one");
}
} // namespace fuzz
