#include "recording_fixture.h"
#include <algorithm>

namespace test
{
VkCommandBuffer fakeCommandBuffer() { return reinterpret_cast<VkCommandBuffer>(uintptr_t(0xC0DE)); }
VkImage fakeImage(uintptr_t number) { return reinterpret_cast<VkImage>(number); }

RecordingFixture::RecordingFixture(std::vector<nrd::DenoiserDesc> list) : denoisers(std::move(list))
{
    desc.resourceWidth = kWidth;
    desc.resourceHeight = kHeight;
    instanceDesc.denoisers = denoisers.data();
    instanceDesc.denoisersNum = static_cast<uint32_t>(denoisers.size());
    pool[nrd::ResourceType::IN_SIGNAL] = image(0x100);
    pool[nrd::ResourceType::OUT_SIGNAL] = image(0x200);
}

nrd::Result RecordingFixture::create() { return nrd::IntegrationAccess::Create(integration, spy, desc, instanceDesc); }

void RecordingFixture::beginFrame()
{
    require(integration.NewFrame(), integration);
    settings = stillCamera(width, height, frameIndex++);
    const uint16_t last[] = {lastWidth ? lastWidth : width, lastHeight ? lastHeight : height};
    std::copy_n(last, 2, settings.resourceSizePrev);
    std::copy_n(last, 2, settings.rectSizePrev);
    require(integration.SetCommonSettings(settings), integration);
    lastWidth = width;
    lastHeight = height;
}

nrd::Result RecordingFixture::denoise(std::vector<nrd::Identifier> identifiers, const nrd::DenoiseOptions& options)
{
    return integration.Denoise(fakeCommandBuffer(), identifiers.data(), static_cast<uint32_t>(identifiers.size()), pool,
                               options);
}

nrd::NrdUserImage RecordingFixture::image(uintptr_t handle, VkFormat format) const
{
    nrd::NrdUserImage result;
    result.image = fakeImage(handle);
    result.format = format;
    result.width = width;
    result.height = height;
    return result;
}

void RecordingFixture::fillReblurSlots()
{
    pool[nrd::ResourceType::IN_MV] = image(0x301);
    pool[nrd::ResourceType::IN_NORMAL_ROUGHNESS] = image(0x302, VK_FORMAT_A2B10G10R10_UNORM_PACK32);
    pool[nrd::ResourceType::IN_VIEWZ] = image(0x303, VK_FORMAT_R32_SFLOAT);
    pool[nrd::ResourceType::IN_DIFF_RADIANCE_HITDIST] = image(0x304);
    pool[nrd::ResourceType::IN_SPEC_RADIANCE_HITDIST] = image(0x305);
    pool[nrd::ResourceType::OUT_DIFF_RADIANCE_HITDIST] = image(0x306);
    pool[nrd::ResourceType::OUT_SPEC_RADIANCE_HITDIST] = image(0x307);
}

std::vector<rhi::RecordedCall> RecordingFixture::calls(rhi::CallType type) const
{
    std::vector<rhi::RecordedCall> result;
    for (const rhi::RecordedCall& call : device->calls())
        if (call.type == type) result.push_back(call);
    return result;
}

std::vector<rhi::RecordedBarrier> RecordingFixture::barriersOf(const std::string& texture) const
{
    std::vector<rhi::RecordedBarrier> result;
    for (const rhi::RecordedCall& call : calls(rhi::CallType::Barriers))
        for (const rhi::RecordedBarrier& barrier : call.barriers)
            if (barrier.name == texture) result.push_back(barrier);
    return result;
}
} // namespace test
