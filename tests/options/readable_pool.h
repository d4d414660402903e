// The textures in which an integration keeps its histories, as the host sees them.
#pragma once
#include <forwarding_device.h>
#include <string>
#include <test_image.h>

namespace nrd
{
class Pools;
}

namespace options
{
// The application's device, as an integration wraps it; its textures can be copied from.
class ReadableDevice final : public test::ForwardingDevice
{
public:
    ReadableDevice();
    std::unique_ptr<rhi::Texture> createTexture(const rhi::TextureDesc& desc) override;
    rhi::MemoryRequirements textureMemoryRequirements(const rhi::TextureDesc& desc) override;
    std::unique_ptr<rhi::Texture> createPlacedTexture(const rhi::TextureDesc& desc, rhi::Memory& memory,
                                                      uint64_t offset) override;

private:
    explicit ReadableDevice(std::unique_ptr<rhi::Device> wrapped);
    std::unique_ptr<rhi::Device> m_wrapped;
};

// Permanent textures of floats, of an integration over a ReadableDevice that is idle.
std::vector<std::pair<std::string, test::Plane>> readPool(nrd::Pools& pools);
} // namespace options
