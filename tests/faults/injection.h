// Decides which calls of Vulkan fail, and counts the objects that are alive. The hooks ask and tell it; one thread.
#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vulkan/vulkan_core.h>

namespace faults
{
// Which calls fail from now on; one plan at a time.
void failNth(size_t n, size_t variant = 0); // the n-th that can fail, once; `variant` picks among its results
void failEachOnce();                        // every creation that Denoise() makes once and keeps: before it succeeds
void failCallsOf(const char* function, VkResult result); // all calls of one function
void stop();

size_t callCount(); // calls that can fail, since the plan was made

struct Fault
{
    const char* function = nullptr; // null: none since the last takeFault()
    VkResult result = VK_SUCCESS;
};
Fault takeFault();

/// A device that hangs: of what is recorded from now on, `dispatchNum` dispatches and what is before the next one run.
void hangAfter(size_t dispatchNum);
void unhang();

/// What the hooked functions have made and not given back.
struct Census
{
    std::map<std::string, size_t> alive; // by kind: "Image"; kinds of which there are none are left out
    uint64_t memoryBytes = 0;
    size_t foreign = 0; // destructions of what is not alive
};
Census census();
std::string toString(const Census& census);

namespace detail // for the hooks
{
bool isFailing(const char* function, VkResult& result);
bool isExecuted(bool isDispatch); // the command that is being recorded
void noteCreated(const char* kind, uint64_t handle, uint64_t byteSize);
void noteDestroyed(const char* kind, uint64_t handle);
} // namespace detail
} // namespace faults
