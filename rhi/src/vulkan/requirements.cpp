#include <rhi/vulkan.h>

namespace rhi
{
namespace
{
struct FeatureRow
{
    const char* name;
    VkBool32 VkPhysicalDeviceFeatures::*field;
};
constexpr FeatureRow kRequired[] = {
    // Shaders write to storage images without naming a format, since users choose the formats of theirs.
    {"shaderStorageImageWriteWithoutFormat", &VkPhysicalDeviceFeatures::shaderStorageImageWriteWithoutFormat},
    // R8, RG8, R16, RG16, A2B10G10R10, B10G11R11 and their like as storage images.
    {"shaderStorageImageExtendedFormats", &VkPhysicalDeviceFeatures::shaderStorageImageExtendedFormats},
};
} // namespace

VulkanRequirements requiredVulkanFeatures()
{
    VulkanRequirements requirements;
    for (const FeatureRow& row : kRequired) requirements.features.*row.field = VK_TRUE;
    return requirements;
}

const char* findMissingVulkanFeature(const VkPhysicalDeviceFeatures& enabled)
{
    for (const FeatureRow& row : kRequired)
        if (!(enabled.*row.field)) return row.name;
    return nullptr;
}
} // namespace rhi
