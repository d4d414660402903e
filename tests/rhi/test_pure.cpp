// The parts that need no device.
#include "catch.h"
#include "gpu.h"
#include "spirv.h"
#include "ticks.h"
#include "validation/tracker.h"
#include "vulkan/convert.h"

using namespace rhi;
using namespace rhi::test;

TEST_CASE("every format has a name, a size and a Vulkan format of its own", "[unit]")
{
    for (uint32_t i = 1; i < static_cast<uint32_t>(Format::Count); i++)
    {
        const Format format = static_cast<Format>(i);
        INFO(formatInfo(format).name);
        CHECK(formatInfo(format).texelSize > 0);
        CHECK(toVulkan(format) != VK_FORMAT_UNDEFINED);
        CHECK(fromVulkan(toVulkan(format)) == format);
    }
    CHECK(formatInfo(Format::Unknown).texelSize == 0);
    CHECK(formatInfo(static_cast<Format>(9999)).texelSize == 0);
    CHECK(fromVulkan(VK_FORMAT_BC7_SRGB_BLOCK) == Format::Unknown);
}

TEST_CASE("differences of timestamps survive one wrap-around of the valid bits", "[unit]")
{
    CHECK(tickDifference(10, 25, 64) == 15);
    CHECK(tickDifference(~uint64_t{0} - 4, 5, 64) == 10);
    CHECK(tickDifference((uint64_t{1} << 36) - 6, 4, 36) == 10);
    CHECK(tickDifference(7, 7, 36) == 0);
}

TEST_CASE("states become Vulkan's numbers and come back", "[unit]")
{
    for (const TextureState& state : {states::kSampled, states::kSampledGeneral, states::kStorageWrite,
                                      states::kTransferSrc, states::kTransferDst, states::kUndefined})
    {
        const NativeState native = toVulkan(state);
        const TextureState back = fromVulkan(static_cast<VkImageLayout>(native.layout), native.access, native.stages);
        CHECK(back.layout == state.layout);
        CHECK(hasAll(back.access, state.access));
        CHECK(back.stages == state.stages);
    }
    const TextureState attachment =
        fromVulkan(VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT,
                   VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT);
    CHECK(attachment.layout == Layout::Native);
    CHECK(toVulkan(attachment).layout == VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
    CHECK(toVulkan(attachment).stages == VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT);
    const TextureState sampledBySync2 =
        fromVulkan(VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
                   VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT);
    CHECK(sampledBySync2 == states::kSampled);
}

TEST_CASE("stages and accesses of synchronization2 become older ones that contain them", "[unit]")
{
    using vulkan::toLegacy;
    const auto none = VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT;
    CHECK(toLegacy({0, 0, 0}, none).stages == none);
    CHECK(toLegacy({VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT, 0}, none).stages ==
          VK_PIPELINE_STAGE_TRANSFER_BIT);
    const vulkan::LegacyScope shader =
        toLegacy({VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT, 0}, none);
    CHECK(shader.stages == VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT);
    CHECK(shader.access == VK_ACCESS_SHADER_READ_BIT);
    const vulkan::LegacyScope unknown =
        toLegacy({VK_PIPELINE_STAGE_2_VIDEO_DECODE_BIT_KHR, VK_ACCESS_2_VIDEO_DECODE_READ_BIT_KHR, 0}, none);
    CHECK(unknown.stages == VK_PIPELINE_STAGE_ALL_COMMANDS_BIT);
    CHECK(unknown.access == (VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT));
}

TEST_CASE("SPIR-V tells its bindings, and which of them are read only", "[unit]")
{
    const SpirvInfo info = inspectSpirv(spirvOf(Shader::Sample));
    REQUIRE(info.error == nullptr);
    CHECK(info.bindings.size() == 7);
    int readOnlyCount = 0;
    for (const SpirvBinding& binding : info.bindings)
    {
        if (!binding.isReadOnly) continue;
        readOnlyCount++;
        CHECK((binding.set == 1 && binding.binding == 1));
    }
    CHECK(readOnlyCount == 1);
    CHECK(inspectSpirv({}).error != nullptr);
}

TEST_CASE("a tracked mip demands the barrier that a use needs", "[unit]")
{
    using namespace rhi::validation;
    const auto recording = std::make_shared<Recording>();
    const Moment now = {recording, 0};
    const Use write = {Access::StorageWrite, Stage::Compute, Layout::General, true};
    const Use read = {Access::SampledRead, Stage::Compute, Layout::ShaderReadOnly, false};
    MipTracker mip;
    CHECK_FALSE(mip.findError(write, now).empty()); // still Undefined
    mip.apply(states::kStorageWrite);
    CHECK(mip.findError(write, now).empty());
    mip.apply(write, now);
    CHECK_FALSE(mip.findError(write, now).empty()); // write after write
    CHECK_FALSE(mip.findError(states::kSampled, now).empty());
    CHECK_FALSE(mip.findError(states::kUndefined, now).empty()); // would not wait for the write
    CHECK(mip.findError(states::kAliased, now).empty());
    CHECK(mip.findError(states::kStorageWrite, now).empty());
    mip.apply(states::kSampled);
    mip.apply(read, now);
    CHECK(mip.findError(read, now).empty()); // reads need no barrier between them
    CHECK_FALSE(mip.findError(write, now).empty());
    recording->submission = 3;
    CHECK(mip.findError(states::kUndefined, {recording, 3}).empty()); // done long ago
}
