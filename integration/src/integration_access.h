// For tests: creation over a given RHI device (a recording one needs no GPU and takes any number for a handle), and the
// pools, to look at histories.
#pragma once
#include <nrd/integration.h>
#include <rhi/device.h>

namespace nrd
{
class Pools;

struct IntegrationAccess
{
    /// As NrdIntegration::Create(), but over `device`, which must outlive the integration; desc.native is not read.
    static Result Create(NrdIntegration& integration, rhi::Device& device, const IntegrationCreationDesc& desc,
                         const InstanceCreationDesc& instanceDesc);

    /// As NrdIntegration::GetMemoryRequirements(), of `device`.
    static Result GetMemoryRequirements(rhi::Device& device, const IntegrationCreationDesc& desc,
                                        const InstanceCreationDesc& instanceDesc, PoolMemoryRequirements& requirements);

    /// Of a created integration; they live until the next Resize().
    static Pools& GetPools(NrdIntegration& integration);
};
} // namespace nrd
