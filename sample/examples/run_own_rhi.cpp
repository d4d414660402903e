#include "run_own_rhi.h"
#include "engine/commands.h"
#include "engine/error.h"
#include "engine/transfer.h"
#include "noisy_wall.h"
#include <memory>

namespace example
{
namespace
{
void check(nrd::Result result, const nrd::Instance& instance)
{
    if (result != nrd::Result::SUCCESS) throw engine::Error(nrd::GetLastMessage(instance));
}

using UniqueInstance = std::unique_ptr<nrd::Instance, decltype(&nrd::DestroyInstance)>;

UniqueInstance createInstance()
{
    nrd::Instance* instance = nullptr;
    if (nrd::CreateInstance(instanceDesc(), instance) != nrd::Result::SUCCESS)
        throw engine::Error("cannot create the instance");
    return {instance, nrd::DestroyInstance};
}

void denoiseFrame(OwnRhi& rhi, nrd::Instance& instance, VkCommandBuffer cmd,
                  const std::map<nrd::ResourceType, engine::Image*>& userPool)
{
    for (const auto& [slot, image] : userPool) engine::transition(cmd, *image, engine::kStorage);
    const nrd::DispatchDesc* dispatches = nullptr;
    uint32_t dispatchNum = 0;
    check(nrd::GetComputeDispatches(instance, &kIdentifier, 1, dispatches, dispatchNum), instance);
    rhi.record(cmd, dispatches, dispatchNum, userPool);
}
} // namespace

std::vector<float> denoiseWall(const ShaderSource& source)
{
    engine::DeviceDesc deviceDesc;
    deviceDesc.features.shaderStorageImageWriteWithoutFormat = VK_TRUE; // what the library's shaders need
    deviceDesc.features.shaderStorageImageExtendedFormats = VK_TRUE;
    const engine::Device device(deviceDesc);
    const UniqueInstance instance = createInstance();
    OwnRhi rhi(device, nrd::GetInstanceDesc(*instance), kWidth, kHeight, source);

    std::map<nrd::ResourceType, engine::Image> images;
    std::map<nrd::ResourceType, engine::Image*> userPool;
    for (const nrd::ResourceType slot : kSlots)
    {
        images[slot] = engine::Image(device, {nrd::toString(slot), kWidth, kHeight});
        userPool[slot] = &images[slot];
    }
    for (uint32_t frame = 0; frame < kFrameNum; frame++)
    {
        for (auto& [slot, image] : images)
        {
            const std::vector<float> rgba = texels(slot, frame);
            if (isInput(slot)) engine::upload(device, image, std::as_bytes(std::span(rgba)));
        }
        check(nrd::SetCommonSettings(*instance, settings(frame)), *instance);
        engine::submitAndWait(device, [&](VkCommandBuffer cmd) { denoiseFrame(rhi, *instance, cmd, userPool); });
    }
    std::vector<float> result;
    for (auto& [slot, image] : images)
    {
        if (isInput(slot)) continue;
        const std::vector<float> rgba = engine::readBackAs<float>(device, image);
        result.insert(result.end(), rgba.begin(), rgba.end());
    }
    return result;
}
} // namespace example
