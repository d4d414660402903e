// The plug-in over recording devices, one for each denoiser, since a device serves one thread at a time.
#pragma once
#include "../common/catch.h"
#include "../integration/spy_device.h"
#include "plugin_frames.h"
#include <deque>
#include <memory>
#include <nrd/plugin.h>
#include <rhi/recording.h>
#include <string>
#include <vector>

namespace test
{
struct RecordedDevice
{
    std::unique_ptr<rhi::RecordingDevice> device = rhi::makeRecordingDevice();
    SpyDevice spy{*device};

    /// Every call as text, and what the constants' buffers hold at the end.
    std::vector<std::string> calls() const;
    std::vector<std::string> uploads() const;
};

class RecordingPlugin
{
public:
    RecordingPlugin();
    ~RecordingPlugin(); // releases everything

    static NrdPluginDevice deviceDesc();
    static NrdPluginImage image(uintptr_t number, Size size = {});
    /// One image for each entry; those that may be missing are, unless asked for.
    static std::vector<NrdPluginImage> images(uint32_t denoiser, bool isAll = false, Size size = {});
    static NrdPluginResult initialize(uint32_t denoiser, Size size = {});

    /// In the order of creation; the first is the probe of NrdPluginSetDevice().
    std::deque<RecordedDevice> devices;
};

inline void requireSuccess(NrdPluginResult result)
{
    INFO(NrdPluginGetLastMessage());
    REQUIRE(result == NRD_PLUGIN_SUCCESS);
}
inline void requireRefusal(NrdPluginResult result, const std::string& sentence)
{
    CHECK(result == NRD_PLUGIN_INVALID_ARGUMENT);
    REQUIRE(NrdPluginGetLastMessage() == sentence);
}
} // namespace test
