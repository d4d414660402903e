// Every misuse of the C interface is refused with one sentence, and changes nothing.
#include "plugin_frames.h"
#include "recording_plugin.h"
#include <cmath>
#include <limits>
#include <stdexcept>

using namespace test;

namespace
{
constexpr uint32_t kReblur = NRD_PLUGIN_REBLUR_DIFFUSE;

int eventId(uint32_t denoiser, uint32_t frame) { return NrdPluginGetEventId(denoiser, kFirstFrame + frame); }

void setFrame(uint32_t frame)
{
    const NrdPluginFrame description = pluginFrame(frame);
    requireSuccess(NrdPluginSetFrame(&description));
}
} // namespace

TEST_CASE("nothing works before there is a device, and there is one at a time", "[unit]")
{
    const NrdPluginFrame frame = pluginFrame(0);
    const std::string sentence = "NrdPluginSetDevice() must succeed first";
    const std::vector<NrdPluginImage> images = RecordingPlugin::images(kReblur);
    requireRefusal(NrdPluginInitialize(kReblur, images.data(), static_cast<uint32_t>(images.size())), sentence);
    requireRefusal(NrdPluginSetFrame(&frame), sentence);
    requireRefusal(NrdPluginExecute(eventId(kReblur, 0)), sentence);
    requireRefusal(NrdPluginSetDevice(nullptr), "device is null");
    NrdPluginDevice device = RecordingPlugin::deviceDesc();
    requireRefusal(NrdPluginSetDevice(&device), "native.instance is null");
    device.getCommandBuffer = nullptr;
    requireRefusal(NrdPluginSetDevice(&device), "getCommandBuffer is null");
    device.structSize = 8;
    requireRefusal(NrdPluginSetDevice(&device),
                   "device.structSize is 8, must be sizeof = " + std::to_string(sizeof(NrdPluginDevice)));
    RecordingPlugin plugin;
    device = RecordingPlugin::deviceDesc();
    requireRefusal(NrdPluginSetDevice(&device),
                   "the device is set already: NrdPluginReleaseAll() must come in between");
    requireSuccess(NrdPluginReleaseAll());
    device.framesInFlight = 17;
    requireRefusal(NrdPluginSetDevice(&device), "framesInFlight is 17, must be in [1; 16]");
    device.framesInFlight = 16;
    requireSuccess(NrdPluginSetDevice(&device));
}

TEST_CASE("event ids that mean nothing are refused", "[unit]")
{
    RecordingPlugin plugin;
    requireSuccess(plugin.initialize(kReblur));
    requireRefusal(NrdPluginExecute(eventId(kReblur, 0)), "event id 0x300: no frame was set in ring slot 3");
    setFrame(0);
    requireRefusal(NrdPluginExecute(0x400 | eventId(kReblur, 0)), "event id 0x700 has bits above 9, which must be 0");
    requireRefusal(NrdPluginExecute(-1), "event id 0xFFFFFFFF has bits above 9, which must be 0");
    CHECK(NrdPluginGetEventId(19, 0) == -1);
    CHECK(NrdPluginGetEventId(18, 6) == (18 | 2 << 8));
    requireRefusal(NrdPluginExecute(19), "there is no denoiser 19, the last is 18");
    requireRefusal(NrdPluginExecute(eventId(1, 0)),
                   "event id 0x301: REBLUR_DIFFUSE_OCCLUSION was not initialised when frame 7 was set");
    requireSuccess(NrdPluginExecute(eventId(kReblur, 0)));
    requireRefusal(NrdPluginExecute(eventId(kReblur, 0)), "REBLUR_DIFFUSE is executed twice in frame 7");
    setFrame(1);
    requireSuccess(NrdPluginExecute(eventId(kReblur, 1)));
}

TEST_CASE("images that are missing or do not suit are named", "[unit]")
{
    RecordingPlugin plugin;
    std::vector<NrdPluginImage> images = RecordingPlugin::images(kReblur);
    const auto initialize = [&]
    { return NrdPluginInitialize(kReblur, images.data(), static_cast<uint32_t>(images.size())); };
    const std::string num = std::to_string(images.size());
    requireRefusal(NrdPluginInitialize(kReblur, images.data(), 3),
                   "REBLUR_DIFFUSE takes an array of " + num + " images, given are 3");
    requireRefusal(NrdPluginInitialize(kReblur, nullptr, static_cast<uint32_t>(images.size())),
                   "REBLUR_DIFFUSE takes an array of " + num + " images, given are " + num + " at a null pointer");
    requireRefusal(NrdPluginInitialize(19, images.data(), 1), "there is no denoiser 19, the last is 18");

    const NrdPluginImage motion = images[0];
    images[0] = {};
    requireRefusal(initialize(), "IN_MV: the image is null, but REBLUR_DIFFUSE needs it");
    images[0] = motion;
    images[0].layout = VK_IMAGE_LAYOUT_UNDEFINED;
    requireRefusal(initialize(), "IN_MV: VkImageLayout 0 is none that an image can be left in");
    images[0] = motion;
    images[0].format = VK_FORMAT_R8_UNORM;
    requireRefusal(initialize(),
                   "IN_MV: the format is R8_UNORM, which keeps less than RG16_SFLOAT, the least that serves");
    images[0] = motion;
    images[0].width = 0;
    requireRefusal(initialize(), "IN_MV: the image is 0 x 24, must be at least 1 x 1 and at most 65535 x 65535");
    images[0] = motion;
    images[2].height = 9;
    requireRefusal(initialize(), "IN_VIEWZ: the image is 40 x 9, but the resource size is 40 x 24");
    images[2].height = kHeight;
    images[2].image = images[0].image;
    images[2].layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    requireRefusal(initialize(), "IN_MV and IN_VIEWZ: one image in two states (layout, access or stages differ)");
    images[2] = RecordingPlugin::image(0x77);
    requireSuccess(initialize());
    requireSuccess(NrdPluginRelease(kReblur));
    requireRefusal(NrdPluginRelease(kReblur), "REBLUR_DIFFUSE is not initialised");
}

TEST_CASE("optional images are used when they are there, both confidences or none", "[unit]")
{
    RecordingPlugin plugin;
    const uint32_t denoiser = NRD_PLUGIN_REBLUR_DIFFUSE_SPECULAR;
    std::vector<NrdPluginImage> images = RecordingPlugin::images(denoiser, true);
    requireSuccess(NrdPluginInitialize(denoiser, images.data(), static_cast<uint32_t>(images.size())));
    setFrame(0);
    requireSuccess(NrdPluginExecute(eventId(denoiser, 0)));
    images[4] = {};
    requireRefusal(NrdPluginInitialize(denoiser, images.data(), static_cast<uint32_t>(images.size())),
                   "IN_SPEC_CONFIDENCE: the slot is empty, but REBLUR_DIFFUSE_SPECULAR needs it");
}

TEST_CASE("frames with impossible fields are refused on the thread that sets them", "[unit]")
{
    RecordingPlugin plugin;
    requireSuccess(plugin.initialize(kReblur));
    requireRefusal(NrdPluginSetFrame(nullptr), "frame is null");
    NrdPluginFrame frame = pluginFrame(0);
    frame.structSize = 0;
    CHECK(NrdPluginSetFrame(&frame) == NRD_PLUGIN_INVALID_ARGUMENT);
    frame = pluginFrame(0);
    frame.deltaTime = -0.5f;
    CHECK(NrdPluginSetFrame(&frame) == NRD_PLUGIN_INVALID_ARGUMENT);
    CHECK_THAT(NrdPluginGetLastMessage(), containing("deltaTime is -0.5 seconds"));
    frame = pluginFrame(0);
    frame.worldToViewMatrix[3] = std::numeric_limits<float>::quiet_NaN();
    CHECK(NrdPluginSetFrame(&frame) == NRD_PLUGIN_INVALID_ARGUMENT);
    CHECK_THAT(NrdPluginGetLastMessage(), containing("worldToViewMatrix[3]"));
    frame = pluginFrame(0);
    frame.lightDirection[1] = std::numeric_limits<float>::infinity();
    CHECK(NrdPluginSetFrame(&frame) == NRD_PLUGIN_INVALID_ARGUMENT);
    CHECK_THAT(NrdPluginGetLastMessage(), containing("lightDirection[1]"));
    frame = pluginFrame(0);
    frame.rectSize[0] = 65536 + kWidth; // would fit if it were cut off at 16 bits
    requireRefusal(NrdPluginSetFrame(&frame), "rectSize[0] is 65576, must be at most 65535");
    CHECK(NrdPluginExecute(eventId(kReblur, 0)) == NRD_PLUGIN_INVALID_ARGUMENT); // nothing was set
    frame.rectSize[0] = kWidth + 1; // too large for these images only, so the event finds it
    requireSuccess(NrdPluginSetFrame(&frame));
    CHECK(NrdPluginExecute(eventId(kReblur, 0)) == NRD_PLUGIN_INVALID_ARGUMENT);
    CHECK_THAT(NrdPluginGetLastMessage(), containing("rectSize[0]"));
    frame.rectSize[0] = kWidth - 1;
    requireSuccess(NrdPluginSetFrame(&frame)); // the same frame again
    requireSuccess(NrdPluginExecute(eventId(kReblur, 0)));
}

TEST_CASE("a provider without a command buffer and a device out of memory refuse the event alone", "[unit]")
{
    RecordingPlugin plugin;
    requireSuccess(NrdPluginReleaseAll());
    static bool isThere = false;
    NrdPluginDevice device = RecordingPlugin::deviceDesc();
    device.getCommandBuffer = [](void*) { return isThere ? reinterpret_cast<VkCommandBuffer>(uintptr_t(1)) : nullptr; };
    requireSuccess(NrdPluginSetDevice(&device));
    requireSuccess(plugin.initialize(kReblur));
    setFrame(0);
    requireRefusal(NrdPluginExecute(eventId(kReblur, 0)), "getCommandBuffer returned null");
    isThere = true;
    plugin.devices.back().device->failCreation(1);
    CHECK(NrdPluginExecute(eventId(kReblur, 0)) == NRD_PLUGIN_FAILURE);
    CHECK(*NrdPluginGetLastMessage() != 0);
    requireSuccess(NrdPluginExecute(eventId(kReblur, 0)));
}

TEST_CASE("what the engine's own callbacks throw does not leave", "[unit]")
{
    RecordingPlugin plugin;
    requireSuccess(NrdPluginSetMessageCallback(
        [](void*, NrdPluginResult, const char*) { throw std::runtime_error("of the engine"); }, nullptr));
    CHECK(NrdPluginSetFrame(nullptr) == NRD_PLUGIN_FAILURE);
}

TEST_CASE("questions about images are refused by index, and answered without a device", "[unit]")
{
    uint32_t imageNum = 0;
    NrdPluginImageInfo info = {};
    info.structSize = sizeof(info);
    requireRefusal(NrdPluginGetImageNum(0, nullptr), "imageNum is null");
    requireRefusal(NrdPluginGetImageNum(255, &imageNum), "there is no denoiser 255, the last is 18");
    requireSuccess(NrdPluginGetImageNum(NRD_PLUGIN_REFERENCE, &imageNum));
    REQUIRE(imageNum == 2);
    requireRefusal(NrdPluginGetImageInfo(NRD_PLUGIN_REFERENCE, 2, &info), "index is 2, REFERENCE takes 2 images");
    requireRefusal(NrdPluginGetImageInfo(NRD_PLUGIN_REFERENCE, 0, nullptr), "info is null");
    requireSuccess(NrdPluginGetImageInfo(NRD_PLUGIN_REFERENCE, 1, &info));
    CHECK(info.name == std::string("OUT_SIGNAL"));
    CHECK(info.isRequired == 1);
    CHECK(info.isOutput == 1);
    CHECK(info.minFormat == VK_FORMAT_R8_UNORM);
    requireRefusal(NrdPluginGetEventCallback(nullptr), "callback is null");
}
