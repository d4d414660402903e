// The compute pipelines of an instance, each made when a dispatch first asks for it.
#pragma once
#include <nrd/descs.h>
#include <rhi/device.h>
#include <string>
#include <vector>

namespace nrd
{
class Pipelines
{
public:
    /// What the application has in place of a shader of the library's; `find` may be null.
    struct Replacement
    {
        SPIRV (*find)(void* userArg, const char* shaderIdentifier) = nullptr;
        void* userArg = nullptr;
    };
    Pipelines(rhi::Device& device, const char* name, uint32_t pipelineCount, const Replacement& replacement);

    /// Throws rhi::Error with the shader's name. `instance` is any that was created from the same description, so that
    /// equal indices mean equal pipelines.
    const rhi::Pipeline& get(const InstanceDesc& instance, uint32_t index);
    uint32_t createdCount() const { return m_createdCount; }

private:
    rhi::Device& m_device;
    std::string m_name;
    Replacement m_replacement;
    std::vector<std::unique_ptr<rhi::Pipeline>> m_pipelines;
    uint32_t m_createdCount = 0;
};
} // namespace nrd
