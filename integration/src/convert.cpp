#include "convert.h"
#include <rhi/vulkan.h>

namespace nrd
{
namespace
{
constexpr rhi::Access kComputeReads = rhi::Access::SampledRead | rhi::Access::StorageRead;
} // namespace

rhi::Format toRhi(Format format)
{
    switch (format)
    {
    case Format::R8_UNORM:
        return rhi::Format::R8_UNORM;
    case Format::R8_SNORM:
        return rhi::Format::R8_SNORM;
    case Format::R8_UINT:
        return rhi::Format::R8_UINT;
    case Format::RG8_UNORM:
        return rhi::Format::RG8_UNORM;
    case Format::RG8_UINT:
        return rhi::Format::RG8_UINT;
    case Format::RGBA8_UNORM:
        return rhi::Format::RGBA8_UNORM;
    case Format::RGBA8_SNORM:
        return rhi::Format::RGBA8_SNORM;
    case Format::R16_UNORM:
        return rhi::Format::R16_UNORM;
    case Format::R16_UINT:
        return rhi::Format::R16_UINT;
    case Format::R16_SFLOAT:
        return rhi::Format::R16_SFLOAT;
    case Format::RG16_UNORM:
        return rhi::Format::RG16_UNORM;
    case Format::RG16_SFLOAT:
        return rhi::Format::RG16_SFLOAT;
    case Format::RGBA16_UNORM:
        return rhi::Format::RGBA16_UNORM;
    case Format::RGBA16_SNORM:
        return rhi::Format::RGBA16_SNORM;
    case Format::RGBA16_SFLOAT:
        return rhi::Format::RGBA16_SFLOAT;
    case Format::R32_UINT:
        return rhi::Format::R32_UINT;
    case Format::R32_SFLOAT:
        return rhi::Format::R32_SFLOAT;
    case Format::RG32_UINT:
        return rhi::Format::RG32_UINT;
    case Format::RG32_SFLOAT:
        return rhi::Format::RG32_SFLOAT;
    case Format::RGBA32_SFLOAT:
        return rhi::Format::RGBA32_SFLOAT;
    case Format::A2B10G10R10_UNORM_PACK32:
        return rhi::Format::A2B10G10R10_UNORM_PACK32;
    case Format::B10G11R11_UFLOAT_PACK32:
        return rhi::Format::B10G11R11_UFLOAT_PACK32;
    case Format::E5B9G9R9_UFLOAT_PACK32:
        return rhi::Format::E5B9G9R9_UFLOAT_PACK32;
    case Format::MAX_NUM:
        break;
    }
    return rhi::Format::Unknown;
}

rhi::SamplerKind toRhi(Sampler sampler)
{
    switch (sampler)
    {
    case Sampler::NEAREST_CLAMP:
        return rhi::SamplerKind::NearestClamp;
    case Sampler::LINEAR_CLAMP:
        return rhi::SamplerKind::LinearClamp;
    case Sampler::MAX_NUM:
        break;
    }
    return rhi::SamplerKind::NearestClamp;
}

Result toResult(rhi::ErrorCode code)
{
    switch (code)
    {
    case rhi::ErrorCode::InvalidArgument:
        return Result::INVALID_ARGUMENT;
    case rhi::ErrorCode::Unsupported:
        return Result::UNSUPPORTED;
    case rhi::ErrorCode::Failure:
    case rhi::ErrorCode::OutOfHostMemory:
    case rhi::ErrorCode::OutOfDeviceMemory:
    case rhi::ErrorCode::PoolExhausted:
    case rhi::ErrorCode::InvalidShader:
    case rhi::ErrorCode::DeviceLost:
        break;
    }
    return Result::FAILURE;
}

rhi::TextureState toRhi(ResourceState state, LayoutPolicy policy)
{
    switch (state)
    {
    case ResourceState::SAMPLED:
        return policy == LayoutPolicy::GENERAL ? rhi::states::kSampledGeneral : rhi::states::kSampled;
    case ResourceState::STORAGE:
        return rhi::states::kStorageReadWrite; // atomics read what they write
    case ResourceState::SAMPLED_AND_STORAGE:
        return {rhi::Access::SampledRead | rhi::Access::StorageWrite, rhi::Layout::General, rhi::Stage::Compute};
    case ResourceState::INDIRECT_ARGUMENTS:
    case ResourceState::MAX_NUM:
        break;
    }
    return rhi::states::kUndefined;
}

rhi::BufferState toBufferState(ResourceState state)
{
    switch (state)
    {
    case ResourceState::SAMPLED:
        return {rhi::Access::StorageRead, rhi::Stage::Compute};
    case ResourceState::STORAGE: // atomics read what they write
    case ResourceState::SAMPLED_AND_STORAGE:
        return {rhi::Access::StorageRead | rhi::Access::StorageWrite, rhi::Stage::Compute};
    case ResourceState::INDIRECT_ARGUMENTS:
        return {rhi::Access::IndirectRead, rhi::Stage::Indirect};
    case ResourceState::MAX_NUM:
        break;
    }
    return {};
}

rhi::MemoryState toRhi(const NrdMemoryUse& use)
{
    rhi::MemoryState result;
    result.isNative = true;
    result.native = {use.stages, use.access, 0};
    return result;
}

rhi::TextureState toRhi(const NrdImageState& state)
{
    constexpr VkAccessFlags kKnown = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT;
    const bool isCompute = state.stages == VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT;
    if (state.layout == VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL && isCompute &&
        state.access == VK_ACCESS_SHADER_READ_BIT)
        return rhi::states::kSampled;
    if (state.layout == VK_IMAGE_LAYOUT_GENERAL && isCompute && state.access != 0 && (state.access & ~kKnown) == 0)
    {
        rhi::TextureState result = {rhi::Access::None, rhi::Layout::General, rhi::Stage::Compute};
        if (state.access & VK_ACCESS_SHADER_READ_BIT) result.access |= kComputeReads;
        if (state.access & VK_ACCESS_SHADER_WRITE_BIT) result.access |= rhi::Access::StorageWrite;
        return result;
    }
    if (state == NrdImageState{}) return rhi::states::kUndefined;
    rhi::TextureState result;
    result.layout = rhi::Layout::Native;
    result.native = {state.stages, state.access, static_cast<uint32_t>(state.layout)};
    return result;
}

NrdImageState toImageState(const rhi::TextureState& state)
{
    if (state.layout == rhi::Layout::Native)
        return {static_cast<VkImageLayout>(state.native.layout), static_cast<VkAccessFlags>(state.native.access),
                static_cast<VkPipelineStageFlags>(state.native.stages)};
    NrdImageState result;
    if (state.layout == rhi::Layout::General) result.layout = VK_IMAGE_LAYOUT_GENERAL;
    if (state.layout == rhi::Layout::ShaderReadOnly) result.layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    if (rhi::hasAny(state.access, kComputeReads)) result.access |= VK_ACCESS_SHADER_READ_BIT;
    if (rhi::hasAny(state.access, rhi::Access::StorageWrite)) result.access |= VK_ACCESS_SHADER_WRITE_BIT;
    if (rhi::hasAny(state.stages, rhi::Stage::Compute)) result.stages |= VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT;
    return result;
}
} // namespace nrd
