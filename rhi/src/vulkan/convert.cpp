#include "convert.h"

namespace rhi::vulkan
{
VkImageUsageFlags toVulkan(TextureUsage usage)
{
    VkImageUsageFlags flags = 0;
    if (hasAny(usage, TextureUsage::Sampled)) flags |= VK_IMAGE_USAGE_SAMPLED_BIT;
    if (hasAny(usage, TextureUsage::Storage)) flags |= VK_IMAGE_USAGE_STORAGE_BIT;
    if (hasAny(usage, TextureUsage::TransferSrc)) flags |= VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    if (hasAny(usage, TextureUsage::TransferDst)) flags |= VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    return flags;
}

VkBufferUsageFlags toVulkan(BufferUsage usage)
{
    VkBufferUsageFlags flags = 0;
    if (hasAny(usage, BufferUsage::Uniform)) flags |= VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT;
    if (hasAny(usage, BufferUsage::Storage)) flags |= VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    if (hasAny(usage, BufferUsage::Indirect)) flags |= VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT;
    if (hasAny(usage, BufferUsage::TransferSrc)) flags |= VK_BUFFER_USAGE_TRANSFER_SRC_BIT;
    if (hasAny(usage, BufferUsage::TransferDst)) flags |= VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    return flags;
}

VkDescriptorType toVulkan(BindingType type)
{
    switch (type)
    {
    case BindingType::UniformBufferDynamic:
        return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC;
    case BindingType::Sampler:
        return VK_DESCRIPTOR_TYPE_SAMPLER;
    case BindingType::SampledTexture:
        return VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE;
    case BindingType::StorageTexture:
        return VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
    case BindingType::StorageBuffer:
        return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    }
    return VK_DESCRIPTOR_TYPE_MAX_ENUM;
}

VkImageLayout toVulkan(Layout layout)
{
    switch (layout)
    {
    case Layout::General:
        return VK_IMAGE_LAYOUT_GENERAL;
    case Layout::ShaderReadOnly:
        return VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    case Layout::TransferSrc:
        return VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    case Layout::TransferDst:
        return VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    case Layout::Undefined:
    case Layout::Native:
        break;
    }
    return VK_IMAGE_LAYOUT_UNDEFINED;
}

FormatSupport toFormatSupport(VkFormatFeatureFlags features)
{
    FormatSupport support = FormatSupport::None;
    if (features & VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT) support |= FormatSupport::Sampled;
    if (features & VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT) support |= FormatSupport::SampledLinear;
    if (features & VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT) support |= FormatSupport::Storage;
    if (features & VK_FORMAT_FEATURE_TRANSFER_SRC_BIT) support |= FormatSupport::TransferSrc;
    if (features & VK_FORMAT_FEATURE_TRANSFER_DST_BIT) support |= FormatSupport::TransferDst;
    return support;
}

VkImageAspectFlags aspectOf(Format format)
{
    const bool isDepth = formatInfo(format).formatClass == FormatClass::Depth;
    return isDepth ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

namespace
{
struct AccessRow
{
    Access access;
    VkAccessFlags2 flags; // bits that exist in Vulkan 1.0 as well
};
constexpr AccessRow kAccessRows[] = {
    {Access::UniformRead, VK_ACCESS_2_UNIFORM_READ_BIT},
    {Access::SampledRead, VK_ACCESS_2_SHADER_READ_BIT},
    {Access::StorageRead, VK_ACCESS_2_SHADER_READ_BIT},
    {Access::StorageWrite, VK_ACCESS_2_SHADER_WRITE_BIT},
    {Access::IndirectRead, VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT},
    {Access::TransferRead, VK_ACCESS_2_TRANSFER_READ_BIT},
    {Access::TransferWrite, VK_ACCESS_2_TRANSFER_WRITE_BIT},
    {Access::HostRead, VK_ACCESS_2_HOST_READ_BIT},
    {Access::HostWrite, VK_ACCESS_2_HOST_WRITE_BIT},
    {Access::MemoryRead, VK_ACCESS_2_MEMORY_READ_BIT},
    {Access::MemoryWrite, VK_ACCESS_2_MEMORY_WRITE_BIT},
};

struct StageRow
{
    Stage stage;
    VkPipelineStageFlags2 flags;
};
constexpr StageRow kStageRows[] = {
    {Stage::Compute, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT},   {Stage::Transfer, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT},
    {Stage::Indirect, VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT},   {Stage::Host, VK_PIPELINE_STAGE_2_HOST_BIT},
    {Stage::AllCommands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT},
};

constexpr VkPipelineStageFlags2 kTransferStages2 = VK_PIPELINE_STAGE_2_COPY_BIT | VK_PIPELINE_STAGE_2_RESOLVE_BIT |
                                                   VK_PIPELINE_STAGE_2_BLIT_BIT | VK_PIPELINE_STAGE_2_CLEAR_BIT;
constexpr VkPipelineStageFlags2 kVertexStages2 =
    VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT | VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT;
constexpr VkAccessFlags2 kShaderReads2 = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_READ_BIT;
constexpr uint64_t kLegacyBits = 0x7fffffff;
} // namespace

NativeState toVulkan(const BufferState& state)
{
    NativeState native;
    for (const AccessRow& row : kAccessRows)
        if (hasAny(state.access, row.access)) native.access |= row.flags;
    for (const StageRow& row : kStageRows)
        if (hasAny(state.stages, row.stage)) native.stages |= row.flags;
    return native;
}

NativeState toVulkan(const MemoryState& state)
{
    return state.isNative ? state.native : toVulkan(BufferState{state.access, state.stages});
}

LegacyScope toLegacy(const NativeState& state, VkPipelineStageFlags noStage)
{
    uint64_t stages = state.stages;
    if (stages & kTransferStages2) stages |= VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
    if (stages & kVertexStages2) stages |= VK_PIPELINE_STAGE_2_VERTEX_INPUT_BIT;
    stages &= ~(kTransferStages2 | kVertexStages2);
    if (stages & ~kLegacyBits) stages = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;

    uint64_t access = state.access;
    if (access & kShaderReads2) access |= VK_ACCESS_2_SHADER_READ_BIT;
    if (access & VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT) access |= VK_ACCESS_2_SHADER_WRITE_BIT;
    access &= ~(kShaderReads2 | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
    if (access & ~kLegacyBits)
    {
        access = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
        stages = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    }
    const auto legacyStages = static_cast<VkPipelineStageFlags>(stages);
    return {legacyStages ? legacyStages : noStage, static_cast<VkAccessFlags>(access)};
}
} // namespace rhi::vulkan

namespace rhi
{
NativeState toVulkan(const TextureState& state)
{
    if (state.layout == Layout::Native) return state.native;
    NativeState native = vulkan::toVulkan(BufferState{state.access, state.stages});
    native.layout = static_cast<uint32_t>(vulkan::toVulkan(state.layout));
    return native;
}

namespace
{
bool findLayout(VkImageLayout vkLayout, Layout& layout)
{
    for (const Layout candidate :
         {Layout::Undefined, Layout::General, Layout::ShaderReadOnly, Layout::TransferSrc, Layout::TransferDst})
    {
        layout = candidate;
        if (vulkan::toVulkan(candidate) == vkLayout) return true;
    }
    return false;
}

uint64_t readAccess(VkAccessFlags2 flags, Layout layout, Access& access)
{
    if (flags & vulkan::kShaderReads2) flags = (flags & ~vulkan::kShaderReads2) | VK_ACCESS_2_SHADER_READ_BIT;
    if (flags & VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT)
        flags = (flags & ~VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT) | VK_ACCESS_2_SHADER_WRITE_BIT;
    for (const vulkan::AccessRow& row : vulkan::kAccessRows)
        if (flags & row.flags) access |= row.access;
    if (layout == Layout::ShaderReadOnly && hasAny(access, Access::StorageRead))
        access = static_cast<Access>(static_cast<uint32_t>(access) & ~static_cast<uint32_t>(Access::StorageRead));
    for (const vulkan::AccessRow& row : vulkan::kAccessRows) flags &= ~row.flags;
    return flags; // what has no name here
}

uint64_t readStages(VkPipelineStageFlags2 flags, Stage& stages)
{
    if (flags & vulkan::kTransferStages2)
        flags = (flags & ~vulkan::kTransferStages2) | VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
    for (const vulkan::StageRow& row : vulkan::kStageRows)
    {
        if (flags & row.flags) stages |= row.stage;
        flags &= ~row.flags;
    }
    return flags;
}
} // namespace

TextureState fromVulkan(VkImageLayout layout, VkAccessFlags2 access, VkPipelineStageFlags2 stages)
{
    TextureState state;
    const bool isKnown = findLayout(layout, state.layout) && readAccess(access, state.layout, state.access) == 0 &&
                         readStages(stages, state.stages) == 0;
    if (isKnown) return state;
    return {Access::None, Layout::Native, Stage::None, {stages, access, static_cast<uint32_t>(layout)}};
}
} // namespace rhi
