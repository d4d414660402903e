// Names that a regular expression of the command line chooses.
#pragma once
#include "replay_settings.h"

#include <regex>

namespace sample
{
// The expression that `option` was given. Throws SettingError when it is none.
std::regex parseNames(const char* option, const std::string& expression);

// The library's denoisers whose whole name the expression of --denoisers matches. Throws SettingError when it is none,
// or matches none.
std::vector<const ReplayDenoiser*> selectDenoisers(const std::string& expression);
} // namespace sample
