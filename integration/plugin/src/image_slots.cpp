#include "image_slots.h"
#include "format_class.h"
#include "refusal.h"
#include "user_pool.h"
#include <rhi/vulkan.h>

namespace nrd::plugin
{
namespace
{
constexpr uint32_t kMaxSize = 65535; // pixels

// Before and after an event anything may have been done with an image, by any stage.
constexpr VkAccessFlags kAnyAccess = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;

NrdUserImage toUserImage(const NrdPluginImage& image, ResourceType slot, uint64_t generation)
{
    NrdUserImage result;
    if (image.image == VK_NULL_HANDLE) return result;
    if (image.layout == VK_IMAGE_LAYOUT_UNDEFINED || image.layout == VK_IMAGE_LAYOUT_PREINITIALIZED)
        throw Refusal(Result::INVALID_ARGUMENT, sentence("%s: VkImageLayout %d is none that an image can be left in",
                                                         toString(slot), int(image.layout)));
    result.image = image.image;
    result.format = image.format;
    result.width = image.width;
    result.height = image.height;
    result.generation = generation;
    result.state = {image.layout, kAnyAccess, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT};
    return result;
}

NormalEncoding encodingOf(const NrdUserImage& normals)
{
    const rhi::Format format = rhi::fromVulkan(normals.format);
    for (uint32_t i = 0; i < static_cast<uint32_t>(NormalEncoding::MAX_NUM); i++)
        if (suits(format, static_cast<NormalEncoding>(i))) return static_cast<NormalEncoding>(i);
    return NormalEncoding::R10_G10_B10_A2_UNORM; // the check of formats finds it
}

bool has(const NrdUserPool& pool, ResourceType slot) { return pool[slot].image != VK_NULL_HANDLE; }

// A still camera, and what the images tell.
CommonSettings settingsOf(const NrdUserPool& pool, const NrdUserImage& sizing)
{
    CommonSettings result;
    for (float* matrix : {result.worldToViewMatrix, result.worldToViewMatrixPrev})
        for (int i = 0; i < 4; i++) matrix[i * 5] = 1.0f;
    for (float* matrix : {result.viewToClipMatrix, result.viewToClipMatrixPrev})
    {
        matrix[0] = matrix[5] = matrix[11] = 1.0f;
        matrix[14] = 0.1f;
    }
    for (uint16_t* size : {result.resourceSize, result.resourceSizePrev, result.rectSize, result.rectSizePrev})
    {
        size[0] = static_cast<uint16_t>(sizing.width);
        size[1] = static_cast<uint16_t>(sizing.height);
    }
    result.isHistoryConfidenceAvailable =
        has(pool, ResourceType::IN_DIFF_CONFIDENCE) || has(pool, ResourceType::IN_SPEC_CONFIDENCE);
    result.isDisocclusionThresholdMixAvailable = has(pool, ResourceType::IN_DISOCCLUSION_THRESHOLD_MIX);
    result.isSpecularMotionAvailable = has(pool, ResourceType::IN_SPEC_MV);
    result.enableValidation = has(pool, ResourceType::OUT_VALIDATION);
    return result;
}

void checkImages(Denoiser denoiser, const SlottedImages& images)
{
    const UniqueInstance instance = makeInstance(denoiser, images.normalEncoding);
    check(*instance, SetCommonSettings(*instance, images.common)); // what is optional may be required now
    const ResourceRequirement* needs = nullptr;
    uint32_t needNum = 0;
    check(*instance, GetRequiredResources(*instance, kIdentifier, needs, needNum));
    const SlotRules rules = {images.common.resourceSize[0], images.common.resourceSize[1], images.normalEncoding};
    std::string error = findStateConflict(images.pool);
    for (uint32_t i = 0; i < needNum && error.empty(); i++)
        error = findError(images.pool[needs[i].type], needs[i], rules, toString(denoiser));
    if (!error.empty()) throw Refusal(Result::INVALID_ARGUMENT, error);
}

// The image that says how large all are: the first that must be there.
const NrdUserImage& sizingImage(Denoiser denoiser, const NrdUserPool& pool, rhi::Span<const ResourceRequirement> slots)
{
    for (const ResourceRequirement& slot : slots)
    {
        if (!slot.isRequired) continue;
        const NrdUserImage& image = pool[slot.type];
        if (image.image == VK_NULL_HANDLE)
            throw Refusal(Result::INVALID_ARGUMENT,
                          sentence("%s: the image is null, but %s needs it", toString(slot.type), toString(denoiser)));
        if (image.width == 0 || image.width > kMaxSize || image.height == 0 || image.height > kMaxSize)
            throw Refusal(Result::INVALID_ARGUMENT,
                          sentence("%s: the image is %u x %u, must be at least 1 x 1 and at most %u x %u",
                                   toString(slot.type), image.width, image.height, kMaxSize, kMaxSize));
        return image;
    }
    throw Refusal(Result::FAILURE, "a denoiser without images"); // none is
}
} // namespace

UniqueInstance makeInstance(Denoiser denoiser, NormalEncoding normalEncoding)
{
    const DenoiserDesc denoiserDesc = {kIdentifier, denoiser};
    InstanceCreationDesc desc;
    desc.denoisers = &denoiserDesc;
    desc.denoisersNum = 1;
    desc.normalEncoding = normalEncoding;
    Instance* instance = nullptr;
    const Result result = CreateInstance(desc, instance);
    if (result != Result::SUCCESS) throw Refusal(result, "out of host memory"); // the description is sound
    return UniqueInstance(instance);
}

void check(const Instance& instance, Result result)
{
    if (result != Result::SUCCESS) throw Refusal(result, GetLastMessage(instance));
}

std::vector<ResourceRequirement> imageSlots(Denoiser denoiser)
{
    const UniqueInstance instance = makeInstance(denoiser);
    const ResourceRequirement* needs = nullptr;
    uint32_t needNum = 0;
    check(*instance, GetRequiredResources(*instance, kIdentifier, needs, needNum));
    return std::vector<ResourceRequirement>(needs, needs + needNum);
}

SlottedImages slotted(Denoiser denoiser, Images images, uint64_t generation)
{
    const std::vector<ResourceRequirement> slots = imageSlots(denoiser);
    if (images.data() == nullptr || images.size() != slots.size())
        throw Refusal(Result::INVALID_ARGUMENT,
                      sentence("%s takes an array of %u images, given are %u%s", toString(denoiser),
                               static_cast<uint32_t>(slots.size()), static_cast<uint32_t>(images.size()),
                               images.data() ? "" : " at a null pointer"));
    SlottedImages result;
    for (size_t i = 0; i < slots.size(); i++)
        result.pool[slots[i].type] = toUserImage(images[i], slots[i].type, generation);
    result.common = settingsOf(result.pool, sizingImage(denoiser, result.pool, {slots.data(), slots.size()}));
    if (has(result.pool, ResourceType::IN_NORMAL_ROUGHNESS))
        result.normalEncoding = encodingOf(result.pool[ResourceType::IN_NORMAL_ROUGHNESS]);
    checkImages(denoiser, result);
    return result;
}
} // namespace nrd::plugin
