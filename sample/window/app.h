// The program with a window: loads, shows, listens, and follows a script where there is one.
#pragma once
#include "options.h"

namespace sample
{
/// Runs until the window is closed or the script is done. Throws engine::Error, SceneError, FileError, SettingError
/// and ScriptError.
void runWindow(const Options& options);
} // namespace sample
