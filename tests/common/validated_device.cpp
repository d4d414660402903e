#include "validated_device.h"
#include "catch.h"
#include <cstdlib>
#include <mutex>
#include <rhi/vulkan.h>
#include <string>
#include <vector>

namespace test
{
namespace
{
// Layer messages arrive on any thread, so they are kept and looked at by the test's own.
struct Messages
{
    std::mutex mutex;
    std::vector<std::string> texts;
};

Messages& messages()
{
    static Messages instance;
    return instance;
}

std::unique_ptr<rhi::Device> makeDevice()
{
    rhi::VulkanDeviceDesc desc;
    if (const char* name = std::getenv("NRD_TEST_DEVICE")) desc.adapter = name;
    desc.isValidationEnabled = std::getenv("NRD_TEST_NO_VALIDATION") == nullptr;
    desc.isSyncValidationEnabled = desc.isValidationEnabled;
    desc.messageCallback = [](rhi::MessageSeverity severity, const std::string& text)
    {
        if (severity == rhi::MessageSeverity::Info) return;
        std::lock_guard lock(messages().mutex);
        messages().texts.push_back(text);
    };
    return rhi::makeVulkanDevice(desc);
}
} // namespace

rhi::Device& validatedDevice()
{
    static const std::unique_ptr<rhi::Device> instance = makeDevice();
    return *instance;
}

void submitAndWait(rhi::CommandBuffer& commands)
{
    const auto fence = validatedDevice().createFence("test");
    rhi::CommandBuffer* const list[] = {&commands};
    validatedDevice().submit(list, fence.get());
    fence->wait();
}

void failOnMessages()
{
    std::lock_guard lock(messages().mutex);
    for (const std::string& text : messages().texts) FAIL_CHECK(text);
    messages().texts.clear();
}
} // namespace test
