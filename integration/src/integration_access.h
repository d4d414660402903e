// Creation over a given RHI device, for tests: a recording device needs no GPU and takes any number for a handle.
#pragma once
#include <nrd/integration.h>
#include <rhi/device.h>

namespace nrd
{
struct IntegrationAccess
{
    /// As NrdIntegration::Create(), but over `device`, which must outlive the integration; desc.native is not read.
    static Result Create(NrdIntegration& integration, rhi::Device& device, const IntegrationCreationDesc& desc,
                         const InstanceCreationDesc& instanceDesc);
};
} // namespace nrd
