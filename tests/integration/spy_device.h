// A device that remembers the mapped buffers it made, so that tests can read constants.
#pragma once
#include "forwarding_device.h"

namespace test
{
class SpyDevice final : public ForwardingDevice
{
public:
    using ForwardingDevice::ForwardingDevice;

    const std::vector<const rhi::Buffer*>& uploadBuffers() const { return m_uploadBuffers; } // alive or not

    std::unique_ptr<rhi::Buffer> createBuffer(const rhi::BufferDesc& desc) override
    {
        std::unique_ptr<rhi::Buffer> buffer = ForwardingDevice::createBuffer(desc);
        if (desc.memory == rhi::BufferMemory::Upload) m_uploadBuffers.push_back(buffer.get());
        return buffer;
    }

private:
    std::vector<const rhi::Buffer*> m_uploadBuffers;
};
} // namespace test
