// Settings of the denoisers through the C interface, by name.
#include "plugin_frames.h"
#include "recording_plugin.h"
#include <set>

using namespace test;

namespace
{
constexpr uint32_t kReblur = NRD_PLUGIN_REBLUR_DIFFUSE;

void setFrame(uint32_t frame)
{
    const NrdPluginFrame description = pluginFrame(frame);
    requireSuccess(NrdPluginSetFrame(&description));
}

NrdPluginSettingInfo info(uint32_t denoiser, uint32_t index)
{
    NrdPluginSettingInfo result = {};
    result.structSize = sizeof(result);
    requireSuccess(NrdPluginGetSettingInfo(denoiser, index, &result));
    return result;
}

NrdPluginSettingInfo info(uint32_t denoiser, const std::string& name)
{
    uint32_t num = 0;
    requireSuccess(NrdPluginGetSettingNum(denoiser, &num));
    for (uint32_t i = 0; i < num; i++)
        if (info(denoiser, i).name == name) return info(denoiser, i);
    FAIL("no setting " << name);
    return {};
}

// Of the denoiser that was initialised first.
bool hasPrePass(RecordingPlugin& plugin, uint32_t frame)
{
    rhi::RecordingDevice& device = *plugin.devices.at(1).device;
    device.clearCalls();
    requireSuccess(NrdPluginExecute(NrdPluginGetEventId(kReblur, kFirstFrame + frame)));
    for (const rhi::RecordedCall& call : device.calls())
        if (call.type == rhi::CallType::BeginLabel && call.name.find("Pre-pass") != std::string::npos) return true;
    return false;
}
} // namespace

TEST_CASE("every denoiser lists its settings with valid defaults, which can be set as they are", "[unit]")
{
    RecordingPlugin plugin;
    for (uint32_t denoiser = 0; denoiser <= NRD_PLUGIN_REFERENCE; denoiser++)
    {
        uint32_t num = 0;
        requireSuccess(NrdPluginGetSettingNum(denoiser, &num));
        CHECK(num >= (denoiser < NRD_PLUGIN_SIGMA_SHADOW ? 30 : denoiser == NRD_PLUGIN_REFERENCE ? 1 : 5));
        std::set<std::string> names;
        for (uint32_t i = 0; i < num; i++)
        {
            const NrdPluginSettingInfo setting = info(denoiser, i);
            INFO(setting.name);
            CHECK(names.insert(setting.name).second);
            requireSuccess(NrdPluginSetSetting(denoiser, setting.name, setting.value));
            if (setting.low == setting.high) continue;
            CHECK((setting.isLowExcluded ? setting.value > setting.low : setting.value >= setting.low));
            CHECK(setting.value <= setting.high + 1e-6);
        }
        CHECK(names.count("lightDirection[0]") == 0); // the frame's
    }
    CHECK(info(kReblur, "maxAccumulatedFrameNum").value == 40.0);
    CHECK(info(kReblur, "maxAccumulatedFrameNum").high == 63.0);
    CHECK(info(NRD_PLUGIN_SIGMA_SHADOW, "lightPosition[2]").value == 0.0);
}

TEST_CASE("a setting holds for frames that are set after it, and no longer than everything", "[unit]")
{
    RecordingPlugin plugin;
    requireSuccess(plugin.initialize(kReblur));
    setFrame(0);
    requireSuccess(NrdPluginSetSetting(kReblur, "hitDistanceReconstructionMode", 1.0));
    setFrame(1);
    CHECK_FALSE(hasPrePass(plugin, 0));
    CHECK(hasPrePass(plugin, 1));
    CHECK(info(kReblur, "hitDistanceReconstructionMode").value == 1.0);
    CHECK(info(NRD_PLUGIN_REBLUR_SPECULAR, "hitDistanceReconstructionMode").value == 0.0); // each has its own
    requireSuccess(NrdPluginRelease(kReblur));
    CHECK(info(kReblur, "hitDistanceReconstructionMode").value == 1.0);
    requireSuccess(NrdPluginReleaseAll());
    CHECK(info(kReblur, "hitDistanceReconstructionMode").value == 0.0);
}

TEST_CASE("settings that cannot be are refused with their name, and change nothing", "[unit]")
{
    requireRefusal(NrdPluginSetSetting(kReblur, "maxBlurRadius", 1.0), "NrdPluginSetDevice() must succeed first");
    RecordingPlugin plugin;
    requireRefusal(NrdPluginSetSetting(kReblur, nullptr, 1.0), "name is null");
    requireRefusal(NrdPluginSetSetting(kReblur, "atrousIterationNum", 1.0),
                   "REBLUR_DIFFUSE has no setting 'atrousIterationNum'");
    requireRefusal(NrdPluginSetSetting(kReblur, "maxAccumulatedFrameNum", 2.5),
                   "maxAccumulatedFrameNum is 2.5, must be a whole number");
    requireRefusal(NrdPluginSetSetting(kReblur, "maxAccumulatedFrameNum", -1.0),
                   "maxAccumulatedFrameNum is -1, must be a whole number");
    requireRefusal(NrdPluginSetSetting(kReblur, "enableAntiFirefly", 2.0), "enableAntiFirefly is 2, must be 0 or 1");
    requireRefusal(NrdPluginSetSetting(kReblur, "checkerboardMode", 3.0),
                   "checkerboardMode is 3, must be the number of a mode");
    requireRefusal(NrdPluginSetSetting(kReblur, "maxBlurRadius", 1e300), "maxBlurRadius is 1e+300, must be finite");
    CHECK(NrdPluginSetSetting(kReblur, "maxAccumulatedFrameNum", 64.0) == NRD_PLUGIN_INVALID_ARGUMENT); // its range
    CHECK(std::string(NrdPluginGetLastMessage()).find("maxAccumulatedFrameNum") != std::string::npos);
    CHECK(info(kReblur, "maxAccumulatedFrameNum").value == 40.0);
    uint32_t num = 0;
    requireSuccess(NrdPluginGetSettingNum(NRD_PLUGIN_REFERENCE, &num));
    NrdPluginSettingInfo setting = {};
    setting.structSize = sizeof(setting);
    requireRefusal(NrdPluginGetSettingInfo(NRD_PLUGIN_REFERENCE, num, &setting),
                   "index is 1, REFERENCE has 1 settings");
    requireRefusal(NrdPluginGetSettingNum(19, &num), "there is no denoiser 19, the last is 18");
}
