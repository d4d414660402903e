// The device: makes everything else, submits, and reports what it can do and how much memory it has given away.
// Factories may be called from several threads at once; they throw rhi::Error. An object outlives neither its device
// nor the objects it was made from, except that a pipeline needs nothing of its description afterwards.
#pragma once
#include <cstdint>
#include <memory>
#include <rhi/commands.h>
#include <rhi/error.h>
#include <rhi/pipeline.h>
#include <rhi/resources.h>
#include <string>
#include <vector>

namespace rhi
{
struct DeviceLimits
{
    uint32_t maxTextureSize = 0;         // texels in one dimension
    uint32_t maxGroupCount[3] = {};      // workgroups per dispatch and dimension
    uint32_t maxSampledTextures = 0;     // per pipeline
    uint32_t maxStorageTextures = 0;     // per pipeline
    uint32_t uniformOffsetAlignment = 0; // bytes, a power of two
    uint32_t storageOffsetAlignment = 0; // bytes, a power of two
    uint32_t maxUniformSize = 0;         // bytes a shader sees of one uniform buffer
    uint32_t subgroupSize = 0;           // invocations
    uint32_t timestampValidBits = 0;     // 0 = no timestamps
    double timestampPeriod = 0.0;        // nanoseconds per tick
};

struct DeviceInfo
{
    std::string name;
    DeviceLimits limits;
    bool isSoftware = false; // no GPU: it runs on the CPU
    bool hasSynchronization2 = false;
    bool hasDebugLabels = false;
    bool hasFloat16 = false; // 16-bit floats in arithmetic and in storage buffers are enabled
};

/// One line of the memory report: what the objects with this tag hold now.
struct MemoryReportLine
{
    std::string tag;
    uint64_t byteSize = 0;
    uint32_t allocationCount = 0;
};

class Fence : public Object
{
public:
    virtual bool isSignaled() const = 0;
    /// False if `timeout` (nanoseconds) passed first.
    virtual bool wait(uint64_t timeout = ~0ull) = 0;
    /// Before the fence is submitted again; it must not be pending.
    virtual void reset() = 0;

protected:
    using Object::Object;
};

class Device
{
public:
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;
    virtual ~Device() = default;

    virtual const DeviceInfo& info() const = 0;
    const DeviceLimits& limits() const { return info().limits; }
    virtual FormatSupport formatSupport(Format format) const = 0;
    /// Sorted by tag. Placed textures count through their memory; wrapped objects not at all.
    virtual std::vector<MemoryReportLine> memoryReport() const = 0;

    virtual std::unique_ptr<Texture> createTexture(const TextureDesc& desc) = 0;
    virtual MemoryRequirements textureMemoryRequirements(const TextureDesc& desc) = 0;
    virtual std::unique_ptr<Memory> createMemory(const MemoryDesc& desc) = 0;
    /// `offset` in bytes, a multiple of the texture's required alignment.
    virtual std::unique_ptr<Texture> createPlacedTexture(const TextureDesc& desc, Memory& memory, uint64_t offset) = 0;
    virtual std::unique_ptr<TextureView> createView(const Texture& texture, const TextureViewDesc& desc) = 0;
    virtual std::unique_ptr<Buffer> createBuffer(const BufferDesc& desc) = 0;
    virtual std::unique_ptr<Pipeline> createPipeline(const PipelineDesc& desc) = 0;
    virtual std::unique_ptr<DescriptorPool> createDescriptorPool(const DescriptorPoolDesc& desc) = 0;
    virtual std::unique_ptr<QueryPool> createQueryPool(const QueryPoolDesc& desc) = 0;
    virtual std::unique_ptr<CommandBuffer> createCommandBuffer(const char* name) = 0;
    virtual std::unique_ptr<Fence> createFence(const char* name) = 0;

    /// Wraps an object of the engine (VkImage, VkBuffer, VkDeviceMemory, VkCommandBuffer), which stays the engine's.
    /// The description must be true: it cannot be checked. See rhi/vulkan.h for the typed forms.
    virtual std::unique_ptr<Texture> wrapTexture(uint64_t handle, const TextureDesc& desc) = 0;
    virtual std::unique_ptr<Buffer> wrapBuffer(uint64_t handle, const BufferDesc& desc) = 0;
    /// `desc.memoryTypeBits` is the one bit of its type; `desc.memoryTag` is not read.
    virtual std::unique_ptr<Memory> wrapMemory(uint64_t handle, const MemoryDesc& desc) = 0;
    virtual std::unique_ptr<CommandBuffer> wrapCommandBuffer(uint64_t handle, const char* name) = 0;

    /// Submits recorded command buffers in order; `fence` (may be null) signals when all of them are done. Throws
    /// Unsupported on a wrapped device without a queue. One thread at a time.
    virtual void submit(Span<CommandBuffer* const> commandBuffers, Fence* fence) = 0;
    /// Waits for everything submitted; the only call that does.
    virtual void waitIdle() = 0;

    /// The device underneath all decorators, or this one.
    virtual const Device& backend() const { return *this; }

protected:
    Device() = default;
};
} // namespace rhi
