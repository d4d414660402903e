#include "catch.h"
#include "format_class.h"
#include "user_pool.h"

using nrd::DescriptorType;
using nrd::NrdUserImage;
using nrd::ResourceRequirement;
using nrd::ResourceType;

namespace
{
constexpr nrd::SlotRules kRules = {64, 32, nrd::NormalEncoding::R10_G10_B10_A2_UNORM};

VkImage fakeImage(uintptr_t number) { return reinterpret_cast<VkImage>(number); }

NrdUserImage goodImage()
{
    NrdUserImage image;
    image.image = fakeImage(1);
    image.format = VK_FORMAT_R16G16B16A16_SFLOAT;
    image.width = kRules.width;
    image.height = kRules.height;
    image.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_STORAGE_BIT;
    return image;
}

constexpr ResourceRequirement kRadiance = {ResourceType::IN_DIFF_RADIANCE_HITDIST, DescriptorType::TEXTURE, true, false,
                                           nrd::Format::RGBA16_SFLOAT};
constexpr ResourceRequirement kOutput = {ResourceType::OUT_SIGNAL, DescriptorType::STORAGE_TEXTURE, true, false,
                                         nrd::Format::R8_UNORM};

std::string errorOf(const NrdUserImage& image, const ResourceRequirement& need)
{
    return nrd::findError(image, need, kRules, "REFERENCE");
}
} // namespace

TEST_CASE("a good image is accepted, with known and with unknown usage", "[unit]")
{
    NrdUserImage image = goodImage();
    CHECK(errorOf(image, kRadiance) == "");
    image.usage = 0;
    CHECK(errorOf(image, kRadiance) == "");
    CHECK(errorOf(image, kOutput) == "");
}

TEST_CASE("an empty slot is an error, with its name, only where it is needed", "[unit]")
{
    CHECK(errorOf({}, kOutput) == "OUT_SIGNAL: the slot is empty, but REFERENCE needs it");
    ResourceRequirement optional = kOutput;
    optional.isRequired = false;
    CHECK(errorOf({}, optional) == "");
}

TEST_CASE("an image without the usage of its slot is refused by name", "[unit]")
{
    NrdUserImage image = goodImage();
    image.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    CHECK(errorOf(image, kRadiance) == "");
    CHECK(errorOf(image, kOutput) ==
          "OUT_SIGNAL: the image was created without VK_IMAGE_USAGE_STORAGE_BIT, which this slot needs");
    image.usage = VK_IMAGE_USAGE_STORAGE_BIT;
    CHECK(errorOf(image, kRadiance) == "IN_DIFF_RADIANCE_HITDIST: the image was created without "
                                       "VK_IMAGE_USAGE_SAMPLED_BIT, which this slot needs");
    ResourceRequirement readBack = kOutput;
    readBack.isReadBack = true;
    CHECK(errorOf(image, readBack) ==
          "OUT_SIGNAL: the image was created without VK_IMAGE_USAGE_SAMPLED_BIT, which this slot needs");
}

TEST_CASE("an output that holds steps on the way can't be an input as well", "[unit]")
{
    nrd::NrdUserPool pool;
    pool[kRadiance.type] = pool[kOutput.type] = goodImage();
    ResourceRequirement needs[] = {kRadiance, kOutput};
    CHECK(nrd::findOverlap(pool, needs) == "");
    needs[1].isReadBack = true;
    CHECK(nrd::findOverlap(pool, needs) == "OUT_SIGNAL and IN_DIFF_RADIANCE_HITDIST: one image, but the output holds "
                                           "steps on the way while the other is in use");
}

TEST_CASE("an image of another size is refused by name, but confidences may be small", "[unit]")
{
    NrdUserImage image = goodImage();
    image.height = 31;
    CHECK(errorOf(image, kOutput) == "OUT_SIGNAL: the image is 64 x 31, but the resource size is 64 x 32");
    ResourceRequirement confidence = kOutput;
    confidence.type = ResourceType::IN_SPEC_CONFIDENCE;
    CHECK_THAT(errorOf(image, confidence), containing("IN_SPEC_CONFIDENCE: the image is 64 x 31")); // as it is made
    confidence.descriptorType = DescriptorType::TEXTURE;
    CHECK(errorOf(image, confidence) == "");
    image.width = 0;
    CHECK(errorOf(image, confidence) == "IN_SPEC_CONFIDENCE: the image's width or height is 0");
}

TEST_CASE("a format that keeps less than the slot carries is refused by name", "[unit]")
{
    NrdUserImage image = goodImage();
    for (const VkFormat format : {VK_FORMAT_R16G16_SFLOAT, VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_R16G16B16A16_UNORM,
                                  VK_FORMAT_R32G32B32A32_UINT, VK_FORMAT_B10G11R11_UFLOAT_PACK32})
    {
        image.format = format;
        INFO("VkFormat " << format);
        CHECK(errorOf(image, kRadiance).find("IN_DIFF_RADIANCE_HITDIST: the format is ") == 0);
    }
    image.format = VK_FORMAT_R32G32B32A32_SFLOAT;
    CHECK(errorOf(image, kRadiance) == "");
    image.format = VK_FORMAT_BC7_UNORM_BLOCK;
    CHECK(errorOf(image, kRadiance).find("IN_DIFF_RADIANCE_HITDIST: VkFormat 145 ") == 0);
}

TEST_CASE("formats are compared by channels, range and bits", "[unit]")
{
    using F = rhi::Format;
    CHECK(nrd::isAtLeast(F::R32_SFLOAT, F::R16_SFLOAT));
    CHECK(nrd::isAtLeast(F::RGBA16_SFLOAT, F::B10G11R11_UFLOAT_PACK32));
    CHECK(nrd::isAtLeast(F::RGBA8_SNORM, F::R8_UNORM));
    CHECK(nrd::isAtLeast(F::RGBA32_UINT, F::R8_UINT));
    CHECK_FALSE(nrd::isAtLeast(F::R8_UNORM, F::R8_SNORM));
    CHECK_FALSE(nrd::isAtLeast(F::B10G11R11_UFLOAT_PACK32, F::R16_SFLOAT));
    CHECK_FALSE(nrd::isAtLeast(F::A2B10G10R10_UNORM_PACK32, F::RGBA8_UNORM)); // two bits of alpha
    CHECK_FALSE(nrd::isAtLeast(F::R8_UINT, F::R8_UNORM));
    CHECK_FALSE(nrd::isAtLeast(F::R32_SFLOAT, F::R8_UINT));
    CHECK_FALSE(nrd::isAtLeast(F::Unknown, F::R8_UNORM));
}

TEST_CASE("the guide's format must be the one of the normal encoding", "[unit]")
{
    const ResourceRequirement need = {ResourceType::IN_NORMAL_ROUGHNESS, DescriptorType::TEXTURE, true, false,
                                      nrd::Format::A2B10G10R10_UNORM_PACK32};
    NrdUserImage image = goodImage();
    CHECK(errorOf(image, need) == "IN_NORMAL_ROUGHNESS: the format is RGBA16_SFLOAT, but the instance's normal "
                                  "encoding asks for A2B10G10R10_UNORM_PACK32 (or A2R10G10B10)");
    image.format = VK_FORMAT_A2B10G10R10_UNORM_PACK32;
    CHECK(errorOf(image, need) == "");
    for (uint32_t i = 0; i < static_cast<uint32_t>(nrd::NormalEncoding::MAX_NUM); i++)
    {
        const auto encoding = static_cast<nrd::NormalEncoding>(i);
        uint32_t suitable = 0;
        for (uint32_t f = 0; f < static_cast<uint32_t>(rhi::Format::Count); f++)
            suitable += nrd::suits(static_cast<rhi::Format>(f), encoding);
        CHECK(suitable >= 1);
        CHECK(suitable <= 3);
    }
}

TEST_CASE("one image in two slots has one state", "[unit]")
{
    nrd::NrdUserPool pool;
    pool[ResourceType::IN_SIGNAL] = goodImage();
    pool[ResourceType::OUT_SIGNAL] = goodImage();
    CHECK(nrd::findStateConflict(pool) == "");
    pool[ResourceType::OUT_SIGNAL].state.layout = VK_IMAGE_LAYOUT_GENERAL;
    CHECK(nrd::findStateConflict(pool) ==
          "IN_SIGNAL and OUT_SIGNAL: one image in two states (layout, access or stages differ)");
    pool[ResourceType::OUT_SIGNAL].image = fakeImage(2);
    CHECK(nrd::findStateConflict(pool) == "");
}

TEST_CASE("a slot outside the user pool is never read", "[unit]")
{
    nrd::NrdUserPool pool;
    pool[ResourceType::PERMANENT_POOL] = goodImage();
    pool[ResourceType::MAX_NUM].width = 7;
    for (uint32_t i = 0; i < nrd::NrdUserPool::kSlotsNum; i++)
        CHECK(pool[static_cast<ResourceType>(i)].image == VK_NULL_HANDLE);
}
