// For tests: how the plug-in creates an integration, in place of NrdIntegration::Create() over the native device.
#pragma once
#include "session.h"

namespace nrd::plugin
{
struct PluginAccess
{
    /// For the devices that are set from now on; an empty one is NrdIntegration::Create() again.
    static void SetCreator(Creator create);
};
} // namespace nrd::plugin
