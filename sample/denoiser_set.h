// What denoises a picture together: one denoiser of the lobes and perhaps one of the shadow.
#pragma once
#include "replay_settings.h"
#include "sample_denoisers.h"

namespace sample
{
struct DenoiserSet
{
    const SampleDenoiser* lobes = nullptr;  // never null in a set; NONE leaves them noisy
    const SampleDenoiser* shadow = nullptr; // null: none

    /// As on the command line: "RELAX_DIFFUSE+SIGMA_SHADOW".
    std::string name() const;
    bool isNone() const { return lobes->family == Family::None && !shadow; }
    /// The picture is of light and some of it is denoised.
    bool composesLight() const;
    /// Of its denoisers, and of the history confidence where one of them heeds it; not empty.
    std::vector<Family> families() const;
};

/// From "A+B,C": sets separated by commas. Throws SettingError.
std::vector<DenoiserSet> parseDenoiserSets(const std::string& text);

/// The families of all sets, each once.
std::vector<Family> familiesOf(const std::vector<DenoiserSet>& sets);

/// A field of CommonSettings, which every family has.
bool isCommonSetting(const std::string& key);

/// One of the families has a setting that the key reaches.
bool hasSetting(const std::vector<Family>& families, const std::string& key);

/// Throws SettingError when the field of that name holds a value out of its range.
void checkRanges(ReplaySettings& settings, const std::vector<Family>& families, const std::string& key);

/// The key that reaches only that family's setting of a name that others have, too: "SIGMA.maxStabilizedFrameNum".
std::string qualified(Family family, const std::string& name);

/// Each assignment for every family that has the setting. Throws SettingError where none has, or for a bad value.
void applySettings(ReplaySettings& settings, const std::vector<Family>& families,
                   const std::vector<Assignment>& assignments);
} // namespace sample
