#include "fake_images.h"
#include "convert.h"
#include <rhi/vulkan.h>

namespace test
{
void fillSlots(const nrd::NrdIntegration& integration, nrd::Identifier identifier, uint32_t width, uint32_t height,
               nrd::NrdUserPool& pool)
{
    constexpr uintptr_t kFirstHandle = 0x1000;
    const nrd::ResourceRequirement* needs = nullptr;
    uint32_t needNum = 0;
    if (nrd::GetRequiredResources(*integration.GetInstance(), identifier, needs, needNum) != nrd::Result::SUCCESS)
        return;
    for (uint32_t i = 0; i < needNum; i++)
    {
        nrd::NrdUserImage& image = pool[needs[i].type];
        image = {};
        image.image = reinterpret_cast<VkImage>(kFirstHandle + static_cast<uintptr_t>(needs[i].type));
        image.format = rhi::toVulkan(nrd::toRhi(needs[i].minFormat));
        const uint32_t divisor = needs[i].sizeDivisor;
        image.width = (width + divisor - 1) / divisor;
        image.height = (height + divisor - 1) / divisor;
    }
}
} // namespace test
