#include "fixture.h"
#include "catch.h"
#include <algorithm>
#include <cstdlib>
#include <rhi/recording.h>
#include <rhi/validation.h>
#include <rhi/vulkan.h>

namespace rhi::test
{
namespace
{
std::vector<std::string>& skippedTexts()
{
    static std::vector<std::string> texts;
    return texts;
}

VulkanDeviceDesc plainDesc()
{
    VulkanDeviceDesc desc;
    if (const char* wanted = std::getenv("NRD_TEST_DEVICE")) desc.adapter = wanted;
    return desc;
}

struct KeptDevice
{
    std::unique_ptr<Device> device; // null where there is no Vulkan
    bool isValidated = false;       // the validation layer is installed
};

/// A device that lives as long as the program: some drivers cannot be unloaded and loaded more than some thirty times.
const KeptDevice& keptDevice()
{
    static const KeptDevice kept = []
    {
        for (const bool isValidated : {true, false})
        {
            VulkanDeviceDesc desc = plainDesc();
            desc.isSyncValidationEnabled = isValidated;
            try
            {
                return KeptDevice{makeVulkanDevice(desc), isValidated};
            }
            catch (const Error& error)
            {
                skip(std::string(isValidated ? "validation by the layers: " : "Vulkan: ") + error.what());
            }
        }
        return KeptDevice{};
    }();
    return kept;
}

std::unique_ptr<Device> makeVulkan(Messages& api, bool isSynchronization2Allowed)
{
    VulkanDeviceDesc desc = plainDesc();
    desc.isValidationEnabled = desc.isSyncValidationEnabled = hasApiValidation();
    desc.isSynchronization2Allowed = isSynchronization2Allowed;
    desc.messageCallback = [&api](MessageSeverity, const std::string& text) { api.add(text); };
    return makeVulkanDevice(desc);
}

std::unique_ptr<Device> decorate(std::unique_ptr<Device> device, Messages& misuse)
{
    return makeValidatingDevice(std::move(device), [&misuse](const std::string& text) { misuse.add(text); });
}

DeviceFactory decoratedVulkan()
{
    return {"decorated Vulkan", [](Messages& api, Messages& misuse) { return decorate(makeVulkan(api, true), misuse); },
            true};
}
} // namespace

void Messages::add(const std::string& text)
{
    const std::lock_guard lock(m_mutex);
    m_texts.push_back(text);
}

std::vector<std::string> Messages::take()
{
    const std::lock_guard lock(m_mutex);
    return std::exchange(m_texts, {});
}

TestDevice::TestDevice(const DeviceFactory& factory)
    : m_isDecorated(factory.isDecorated), m_device(factory.make(m_api, m_misuse))
{
}

TestDevice::~TestDevice()
{
    m_device.reset();
    const std::vector<std::string> none;
    CHECK(m_api.take() == none);
    CHECK(m_misuse.take() == none);
}

const std::vector<DeviceFactory>& deviceFactories()
{
    static const std::vector<DeviceFactory> factories = {
        {"Vulkan", [](Messages& api, Messages&) { return makeVulkan(api, true); }},
        {"Vulkan with barriers of 1.0", [](Messages& api, Messages&) { return makeVulkan(api, false); }},
        decoratedVulkan(),
    };
    return factories;
}

const std::vector<DeviceFactory>& decoratedFactories()
{
    static const std::vector<DeviceFactory> factories = {
        {"decorated recording device",
         [](Messages&, Messages& misuse) { return decorate(makeRecordingDevice(), misuse); }, true},
        decoratedVulkan(),
    };
    return factories;
}

void forEach(const std::vector<DeviceFactory>& factories, const std::function<void(TestDevice&)>& body)
{
    const bool isExpected = hasVulkan() || std::getenv("NRD_TEST_DEVICE");
    for (const DeviceFactory& factory : factories)
    {
        INFO("on " << factory.name);
        std::unique_ptr<TestDevice> device;
        try
        {
            device = std::make_unique<TestDevice>(factory);
        }
        catch (const Error& error)
        {
            // A device that was asked for by name, or that was there a moment ago, has to be there.
            if (error.code() != ErrorCode::Unsupported || isExpected) throw;
            skip(std::string(factory.name) + ": " + error.what());
            continue;
        }
        body(*device);
        device.reset(); // while INFO still says which one it was
    }
}

bool hasApiValidation() { return keptDevice().isValidated; }

bool hasVulkan() { return keptDevice().device != nullptr; }

void skip(const std::string& text)
{
    std::vector<std::string>& texts = skippedTexts();
    if (std::find(texts.begin(), texts.end(), text) == texts.end()) texts.push_back(text);
}

const std::vector<std::string>& skipped() { return skippedTexts(); }
} // namespace rhi::test
