// Every function of the plug-in's C interface in any order over recording devices, with arbitrary structs, numbers and
// null wherever a pointer is taken.
#include "fuzz.h"
#include "integration_access.h"
#include "plugin_access.h"
#include <cstring>

#include <deque>
#include <nrd/plugin.h>
#include <rhi/recording.h>
#include <vector>

namespace
{
using fuzz::ByteReader;
using fuzz::require;

constexpr uint32_t kDenoiserNum = static_cast<uint32_t>(nrd::Denoiser::MAX_NUM);
constexpr uint32_t kSize = 32; // pixels, of images that suit

NrdPluginDevice goodDevice()
{
    NrdPluginDevice result = {};
    result.structSize = sizeof(result);
    result.getCommandBuffer = [](void*) { return reinterpret_cast<VkCommandBuffer>(uintptr_t(1)); };
    return result;
}

NrdPluginImage goodImage(uint32_t number, uint32_t width = kSize)
{
    return {reinterpret_cast<VkImage>(uintptr_t(1 + number)), VK_FORMAT_R32G32B32A32_SFLOAT, width, kSize,
            VK_IMAGE_LAYOUT_GENERAL};
}

NrdPluginFrame goodFrame(uint32_t frameIndex)
{
    NrdPluginFrame result = {};
    result.structSize = sizeof(result);
    result.frameIndex = frameIndex;
    for (int i = 0; i < 4; i++) result.worldToViewMatrix[i * 5] = 1.0f;
    result.viewToClipMatrix[0] = result.viewToClipMatrix[5] = result.viewToClipMatrix[11] = 1.0f;
    result.viewToClipMatrix[14] = 0.1f;
    return result;
}

// A good struct with one of its 32-bit words changed, or now and then all of them.
template <class T> T damagedStruct(T value, ByteReader& reader)
{
    uint32_t words[sizeof(T) / sizeof(uint32_t)];
    std::memcpy(words, &value, sizeof(words));
    if (reader.below(16) == 0)
        for (uint32_t& word : words) word = reader.value<uint32_t>();
    else if (reader.flag())
        words[reader.below(static_cast<uint32_t>(std::size(words)))] =
            reader.flag() ? reader.value<uint32_t>() : reader.below(64);
    std::memcpy(&value, words, sizeof(words));
    return value;
}

class Calls
{
public:
    explicit Calls(ByteReader& reader);
    ~Calls();
    Calls(const Calls&) = delete;
    Calls& operator=(const Calls&) = delete;

    void callSomething();
    void expectUsable(); // after whatever was refused

private:
    void check(NrdPluginResult result);
    void setDevice();
    void initialize();
    void setFrame();
    void execute();
    void ask();
    uint32_t denoiser();

    ByteReader& m_reader;
    std::deque<std::unique_ptr<rhi::RecordingDevice>> m_devices; // one for each integration, as made
    uint32_t m_reportNum = 0;
    uint32_t m_frameIndex = 0;
};

Calls::Calls(ByteReader& reader) : m_reader(reader)
{
    nrd::plugin::PluginAccess::SetCreator(
        [this](nrd::NrdIntegration& integration, const nrd::IntegrationCreationDesc& desc,
               const nrd::InstanceCreationDesc& instance)
        {
            rhi::Device& device = *m_devices.emplace_back(rhi::makeRecordingDevice());
            return nrd::IntegrationAccess::Create(integration, device, desc, instance);
        });
    check(NrdPluginSetMessageCallback(
        [](void* userArg, NrdPluginResult result, const char* text)
        {
            require(result != NRD_PLUGIN_SUCCESS && text && *text, "a report is a sentence about a refusal");
            ++*static_cast<uint32_t*>(userArg);
        },
        &m_reportNum));
    const NrdPluginDevice device = goodDevice();
    check(NrdPluginSetDevice(&device));
}

Calls::~Calls()
{
    check(NrdPluginReleaseAll());
    for (const auto& device : m_devices) require(device->objectCount() == 0, "everything is given back");
    (void)NrdPluginSetMessageCallback(nullptr, nullptr);
    nrd::plugin::PluginAccess::SetCreator({});
}

void Calls::check(NrdPluginResult result)
{
    fuzz::countCall();
    const bool isRefused = result != NRD_PLUGIN_SUCCESS;
    require(result == NRD_PLUGIN_SUCCESS || result == NRD_PLUGIN_INVALID_ARGUMENT || result == NRD_PLUGIN_UNSUPPORTED,
            "a result is one of the enumeration, and nothing fails over a recording device");
    require(isRefused == (m_reportNum == 1), "one sentence for a refused call, else none");
    if (isRefused) require(*NrdPluginGetLastMessage() != 0, "a refused call is explained");
    m_reportNum = 0;
}

// Mostly one of a few, so that events find what was initialised.
uint32_t Calls::denoiser()
{
    if (m_reader.below(16) == 0) return m_reader.value<uint32_t>();
    return m_reader.flag() ? m_reader.below(kDenoiserNum) : m_reader.below(4) * 6;
}

void Calls::setDevice()
{
    if (m_reader.flag()) check(NrdPluginReleaseAll());
    NrdPluginDevice device = damagedStruct(goodDevice(), m_reader);
    if (device.getCommandBuffer) device.getCommandBuffer = goodDevice().getCommandBuffer; // it is called
    check(NrdPluginSetDevice(m_reader.below(16) == 0 ? nullptr : &device));
}

void Calls::initialize()
{
    const uint32_t index = denoiser();
    uint32_t imageNum = 0;
    check(NrdPluginGetImageNum(index, &imageNum));
    std::vector<NrdPluginImage> images;
    const uint32_t width = kSize * (1 + m_reader.below(2));
    for (uint32_t i = 0; i < imageNum; i++) images.push_back(goodImage(i, width));
    for (uint32_t changes = m_reader.below(3); changes > 0 && imageNum > 0; changes--)
    {
        NrdPluginImage& image = images[m_reader.below(imageNum)];
        image = m_reader.flag() ? NrdPluginImage{} : damagedStruct(image, m_reader);
        // What no variable of the enumerations can hold is the caller's fault in C as well.
        uint32_t words[2];
        std::memcpy(&words[0], &image.format, 4);
        std::memcpy(&words[1], &image.layout, 4);
        image.format = static_cast<VkFormat>(words[0] & 0x7FFFFFFFu);
        image.layout = static_cast<VkImageLayout>(words[1] & 0x7FFFFFFFu);
    }
    if (m_reader.below(16) == 0) images.resize(m_reader.below(32));
    const bool isNull = m_reader.below(32) == 0;
    check(NrdPluginInitialize(index, isNull ? nullptr : images.data(), static_cast<uint32_t>(images.size())));
}

void Calls::setFrame()
{
    if (m_reader.below(8) != 0) m_frameIndex++;
    const NrdPluginFrame frame = damagedStruct(goodFrame(m_frameIndex), m_reader);
    check(NrdPluginSetFrame(m_reader.below(32) == 0 ? nullptr : &frame));
}

void Calls::execute()
{
    const bool isWild = m_reader.below(8) == 0;
    check(NrdPluginExecute(isWild ? m_reader.value<int>() : NrdPluginGetEventId(denoiser(), m_frameIndex)));
}

void Calls::ask()
{
    uint32_t imageNum = 0;
    const uint32_t index = denoiser();
    const NrdPluginResult result = NrdPluginGetImageNum(index, m_reader.below(8) == 0 ? nullptr : &imageNum);
    check(result);
    require(result == NRD_PLUGIN_SUCCESS || imageNum == 0, "a refused call changes nothing");
    NrdPluginImageInfo info = damagedStruct(NrdPluginImageInfo{sizeof(info), 0, 0, VK_FORMAT_UNDEFINED, ""}, m_reader);
    const NrdPluginResult described =
        NrdPluginGetImageInfo(index, m_reader.below(24), m_reader.below(8) == 0 ? nullptr : &info);
    check(described);
    if (described == NRD_PLUGIN_SUCCESS) require(*info.name != 0 && info.minFormat != 0, "an image has a meaning");
    NrdPluginEventCallback callback = nullptr;
    check(NrdPluginGetEventCallback(m_reader.flag() ? nullptr : &callback));
}

void Calls::callSomething()
{
    const uint32_t call = m_reader.below(32);
    if (call == 0)
        setDevice();
    else if (call < 6)
        initialize();
    else if (call < 15)
        setFrame();
    else if (call < 27)
        execute();
    else if (call < 29)
        check(NrdPluginRelease(denoiser()));
    else
        ask();
}

void Calls::expectUsable()
{
    check(NrdPluginReleaseAll());
    const NrdPluginDevice device = goodDevice();
    const NrdPluginFrame frame = goodFrame(m_frameIndex);
    const uint32_t index = m_reader.below(kDenoiserNum);
    uint32_t imageNum = 0;
    require(NrdPluginSetDevice(&device) == NRD_PLUGIN_SUCCESS &&
                NrdPluginGetImageNum(index, &imageNum) == NRD_PLUGIN_SUCCESS,
            "a refused call leaves a plug-in that takes a device");
    std::vector<NrdPluginImage> images;
    for (uint32_t i = 0; i < imageNum; i++) images.push_back(goodImage(i));
    require(NrdPluginInitialize(index, images.data(), imageNum) == NRD_PLUGIN_SUCCESS &&
                NrdPluginSetFrame(&frame) == NRD_PLUGIN_SUCCESS &&
                NrdPluginExecute(NrdPluginGetEventId(index, m_frameIndex)) == NRD_PLUGIN_SUCCESS,
            "a refused call leaves a plug-in that denoises");
}
} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size)
{
    ByteReader reader(bytes, size);
    Calls calls(reader);
    while (!reader.isEmpty()) calls.callSomething();
    calls.expectUsable();
    return 0;
}
