// The devices the suite runs on. A third back end is held against it by adding a factory to deviceFactories().
#pragma once
#include <functional>
#include <memory>
#include <mutex>
#include <rhi/rhi.h>
#include <string>
#include <vector>

namespace rhi::test
{
/// What was reported, by the validation layers of the API and by the decorator. Filled from any thread.
class Messages
{
public:
    void add(const std::string& text);
    std::vector<std::string> take();

private:
    std::mutex m_mutex;
    std::vector<std::string> m_texts;
};

struct DeviceFactory
{
    const char* name;
    std::function<std::unique_ptr<Device>(Messages& api, Messages& misuse)> make;
    bool isDecorated = false;
};

/// A device, and the expectation that nobody complains about it: what is left untaken fails the test.
class TestDevice
{
public:
    explicit TestDevice(const DeviceFactory& factory);
    TestDevice(const TestDevice&) = delete;
    TestDevice& operator=(const TestDevice&) = delete;
    ~TestDevice();

    Device& operator*() const { return *m_device; }
    Device* operator->() const { return m_device.get(); }
    bool isDecorated() const { return m_isDecorated; }
    std::vector<std::string> takeApiMessages() { return m_api.take(); }
    std::vector<std::string> takeMisuses() { return m_misuse.take(); }

private:
    Messages m_api; // before the device: it reports while it goes
    Messages m_misuse;
    bool m_isDecorated;
    std::unique_ptr<Device> m_device;
};

/// Plain Vulkan, Vulkan with the barriers of 1.0, and the decorator over Vulkan.
const std::vector<DeviceFactory>& deviceFactories();
/// The decorator over the recording device, and over Vulkan where there is one.
const std::vector<DeviceFactory>& decoratedFactories();

/// Runs `body` on a new device of every factory; where there is no such device, that is noted as skipped.
void forEach(const std::vector<DeviceFactory>& factories, const std::function<void(TestDevice&)>& body);
inline void forEachDevice(const std::function<void(TestDevice&)>& body) { forEach(deviceFactories(), body); }

/// False where the validation layer is not installed: hazards then go unreported.
bool hasApiValidation();
bool hasVulkan();

void skip(const std::string& text); // notes it once
const std::vector<std::string>& skipped();
} // namespace rhi::test
