// A denoiser's settings for an interface that knows no structs: by name, as numbers.
#pragma once
#include <nrd/plugin.h>
#include <nrd/settings.h>
#include <variant>

namespace nrd::plugin
{
using DenoiserSettings = std::variant<ReblurSettings, RelaxSettings, SigmaSettings, ReferenceSettings>;
DenoiserSettings defaultSettings(Denoiser denoiser);

/// Numbers in a fixed order; the light's direction is not among them, as it comes with the frame.
uint32_t settingNum(Denoiser denoiser);
/// `index` < settingNum(). All but structSize.
void describeSetting(Denoiser denoiser, uint32_t index, const DenoiserSettings& settings, NrdPluginSettingInfo& info);
/// Throws a Refusal for a name that is none, and for a value that the field cannot hold; ranges are not looked at.
void setSetting(Denoiser denoiser, const char* name, double value, DenoiserSettings& settings);
} // namespace nrd::plugin
