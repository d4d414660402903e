#include "readable_pool.h"
#include "validated_device.h"
#include <pools.h>
#include <rhi/vulkan.h>

namespace options
{
namespace
{
std::unique_ptr<rhi::Device> wrapDevice()
{
    const rhi::VulkanHandles handles = rhi::vulkanHandles(test::validatedDevice());
    rhi::VulkanNativeDevice native;
    native.instance = handles.instance;
    native.physicalDevice = handles.physicalDevice;
    native.device = handles.device;
    native.queueFamilyIndex = handles.queueFamilyIndex;
    native.getInstanceProcAddr = handles.getInstanceProcAddr;
    native.getDeviceProcAddr = handles.getDeviceProcAddr;
    return rhi::wrapVulkanDevice(native);
}

rhi::TextureDesc readable(rhi::TextureDesc desc)
{
    desc.usage |= rhi::TextureUsage::TransferSrc;
    return desc;
}

bool isOfFloats(rhi::Format format)
{
    return std::string(rhi::formatInfo(format).name).find("FLOAT") != std::string::npos;
}

struct Readback
{
    const rhi::Texture* texture;
    std::unique_ptr<rhi::Buffer> buffer;
};

Readback record(rhi::CommandBuffer& commands, const rhi::Texture& texture)
{
    rhi::BufferDesc desc;
    desc.size = texture.mipByteSize(0);
    desc.usage = rhi::BufferUsage::TransferDst;
    desc.memory = rhi::BufferMemory::Readback;
    Readback readback = {&texture, test::validatedDevice().createBuffer(desc)};
    commands.copyTextureToBuffer({&texture, 0, readback.buffer.get(), 0});
    commands.barrier(rhi::BufferBarrier{readback.buffer.get(),
                                        {rhi::Access::TransferWrite, rhi::Stage::Transfer},
                                        {rhi::Access::HostRead, rhi::Stage::Host}});
    return readback;
}

test::Plane decode(const Readback& readback)
{
    const rhi::TextureDesc& desc = readback.texture->desc();
    const size_t texelSize = rhi::formatInfo(desc.format).texelSize;
    test::Plane texels(size_t(desc.width) * desc.height);
    const auto* in = static_cast<const uint8_t*>(readback.buffer->mapped());
    for (size_t i = 0; i < texels.size(); i++) texels[i] = test::decodeTexel(desc.format, in + i * texelSize);
    return texels;
}
} // namespace

ReadableDevice::ReadableDevice() : ReadableDevice(wrapDevice()) {}

ReadableDevice::ReadableDevice(std::unique_ptr<rhi::Device> wrapped)
    : ForwardingDevice(*wrapped), m_wrapped(std::move(wrapped))
{
}

std::unique_ptr<rhi::Texture> ReadableDevice::createTexture(const rhi::TextureDesc& desc)
{
    return ForwardingDevice::createTexture(readable(desc));
}

rhi::MemoryRequirements ReadableDevice::textureMemoryRequirements(const rhi::TextureDesc& desc)
{
    return ForwardingDevice::textureMemoryRequirements(readable(desc));
}

std::unique_ptr<rhi::Texture> ReadableDevice::createPlacedTexture(const rhi::TextureDesc& desc, rhi::Memory& memory,
                                                                  uint64_t offset)
{
    return ForwardingDevice::createPlacedTexture(readable(desc), memory, offset);
}

std::vector<std::pair<std::string, test::Plane>> readPool(nrd::Pools& pools)
{
    const auto commands = test::validatedDevice().createCommandBuffer("read pool");
    std::vector<std::unique_ptr<rhi::Texture>> textures;
    std::vector<Readback> readbacks;
    commands->begin();
    for (uint32_t i = 0; i < pools.permanent().size(); i++)
    {
        const rhi::Texture& texture = pools.permanent().texture(i);
        const rhi::TextureState before = pools.states.state(i);
        if (!isOfFloats(texture.desc().format) || before.layout == rhi::Layout::Undefined) continue;
        textures.push_back(test::validatedDevice().wrapTexture(texture.nativeHandle(), texture.desc()));
        commands->barrier(rhi::TextureBarrier{textures.back().get(), before, rhi::states::kTransferSrc});
        pools.states.setState(i, rhi::states::kTransferSrc);
        readbacks.push_back(record(*commands, *textures.back()));
    }
    commands->end();
    test::submitAndWait(*commands);
    std::vector<std::pair<std::string, test::Plane>> pool;
    for (const Readback& readback : readbacks) pool.emplace_back(readback.texture->name(), decode(readback));
    return pool;
}
} // namespace options
