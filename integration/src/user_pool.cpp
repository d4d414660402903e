#include "user_pool.h"
#include "convert.h"
#include "format_class.h"
#include "refusal.h"
#include <rhi/vulkan.h>

namespace nrd
{
namespace
{
// These three are read with filtering over [0; 1]^2, so that they may be smaller than the resource.
bool hasFreeSize(const ResourceRequirement& need)
{
    const ResourceType slot = need.type;
    if (need.descriptorType != DescriptorType::TEXTURE) return false;
    return slot == ResourceType::IN_DIFF_CONFIDENCE || slot == ResourceType::IN_SPEC_CONFIDENCE ||
           slot == ResourceType::IN_DISOCCLUSION_THRESHOLD_MIX;
}

std::string findUsageError(const NrdUserImage& image, const ResourceRequirement& need)
{
    if (image.usage == 0) return {};
    const bool isStorage = need.descriptorType == DescriptorType::STORAGE_TEXTURE;
    const char* missing = nullptr;
    if ((!isStorage || need.isReadBack) && !(image.usage & VK_IMAGE_USAGE_SAMPLED_BIT))
        missing = "VK_IMAGE_USAGE_SAMPLED_BIT";
    if (isStorage && !(image.usage & VK_IMAGE_USAGE_STORAGE_BIT)) missing = "VK_IMAGE_USAGE_STORAGE_BIT";
    if (!missing) return {};
    return sentence("%s: the image was created without %s, which this slot needs", toString(need.type), missing);
}

std::string findFormatError(const NrdUserImage& image, const ResourceRequirement& need, const SlotRules& rules)
{
    const char* const slot = toString(need.type);
    const rhi::Format format = rhi::fromVulkan(image.format);
    if (format == rhi::Format::Unknown)
        return sentence("%s: VkFormat %d is not one that can be used here", slot, int(image.format));
    const char* const given = rhi::formatInfo(format).name;
    if (need.type == ResourceType::IN_NORMAL_ROUGHNESS || need.type == ResourceType::IN_STORED_NORMAL_ROUGHNESS)
    {
        if (suits(format, rules.normalEncoding)) return {};
        return sentence("%s: the format is %s, but the instance's normal encoding asks for %s", slot, given,
                        expectedFormat(rules.normalEncoding));
    }
    if (isAtLeast(format, toRhi(need.minFormat))) return {};
    return sentence("%s: the format is %s, which keeps less than %s, the least that serves", slot, given,
                    toString(need.minFormat));
}
} // namespace

std::string findError(const NrdUserImage& image, const ResourceRequirement& need, const SlotRules& rules,
                      const char* denoiser)
{
    const char* const slot = toString(need.type);
    if (image.image == VK_NULL_HANDLE)
        return need.isRequired ? sentence("%s: the slot is empty, but %s needs it", slot, denoiser) : std::string();
    std::string error = findUsageError(image, need);
    if (error.empty()) error = findFormatError(image, need, rules);
    if (!error.empty()) return error;
    if (image.width == 0 || image.height == 0) return sentence("%s: the image's width or height is 0", slot);
    if (hasFreeSize(need) || (image.width == rules.width && image.height == rules.height)) return {};
    return sentence("%s: the image is %u x %u, but the resource size is %u x %u", slot, image.width, image.height,
                    rules.width, rules.height);
}

std::string findOverlap(const NrdUserPool& pool, rhi::Span<const ResourceRequirement> needs)
{
    for (const ResourceRequirement& output : needs)
    {
        if (!output.isReadBack || pool[output.type].image == VK_NULL_HANDLE) continue;
        for (const ResourceRequirement& other : needs)
        {
            if (other.type == output.type || pool[other.type].image != pool[output.type].image) continue;
            return sentence("%s and %s: one image, but the output holds steps on the way while the other is in use",
                            toString(output.type), toString(other.type));
        }
    }
    return {};
}

std::string findStateConflict(const NrdUserPool& pool)
{
    for (uint32_t i = 0; i < NrdUserPool::kSlotsNum; i++)
    {
        const NrdUserImage& a = pool[static_cast<ResourceType>(i)];
        if (a.image == VK_NULL_HANDLE) continue;
        for (uint32_t j = i + 1; j < NrdUserPool::kSlotsNum; j++)
        {
            const NrdUserImage& b = pool[static_cast<ResourceType>(j)];
            if (a.image != b.image || a.state == b.state) continue;
            return sentence("%s and %s: one image in two states (layout, access or stages differ)",
                            toString(static_cast<ResourceType>(i)), toString(static_cast<ResourceType>(j)));
        }
    }
    return {};
}
} // namespace nrd
