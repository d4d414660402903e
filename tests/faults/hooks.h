// A Vulkan loader to hand to the library: the functions of the one it stands before, each with a hook that can fail the
// call or drop the command, and that counts what is made and destroyed.
#pragma once
#include <string>
#include <vector>
#include <vulkan/vulkan_core.h>

namespace faults
{
/// Stands before this loader from now on.
void standBefore(PFN_vkGetInstanceProcAddr getInstanceProcAddr, PFN_vkGetDeviceProcAddr getDeviceProcAddr);

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL hookedInstanceProcAddr(VkInstance instance, const char* name);
VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL hookedDeviceProcAddr(VkDevice device, const char* name);

/// Functions that were asked for and have no hook: none, or the list of hooks is not complete.
const std::vector<std::string>& unhooked();

/// While it lives, what this program takes from the linked loader has hooks too.
class LinkedLoaderHook
{
public:
    LinkedLoaderHook();
    ~LinkedLoaderHook();
    LinkedLoaderHook(const LinkedLoaderHook&) = delete;
    LinkedLoaderHook& operator=(const LinkedLoaderHook&) = delete;
};
} // namespace faults
