#include "injection.h"
#include <algorithm>
#include <iterator>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

namespace faults
{
namespace
{
enum class Plan : uint8_t
{
    None,
    Nth,
    EachOnce,
    Function
};

struct Results
{
    const char* function;
    std::vector<VkResult> results;
};

// What the specification lets each function return; the last row stands for all others.
const std::vector<Results>& allResults()
{
    constexpr VkResult kHost = VK_ERROR_OUT_OF_HOST_MEMORY, kDevice = VK_ERROR_OUT_OF_DEVICE_MEMORY,
                       kLost = VK_ERROR_DEVICE_LOST, kInitialization = VK_ERROR_INITIALIZATION_FAILED;
    static const std::vector<Results> rows = {
        {"vkCreateInstance", {kInitialization, kHost}},
        {"vkEnumeratePhysicalDevices", {kInitialization, kHost}},
        {"vkEnumerateInstanceVersion", {kHost}},
        {"vkCreateDebugUtilsMessengerEXT", {kHost}},
        {"vkCreateDevice", {kInitialization, kLost, kHost}},
        {"vkQueueSubmit", {kLost, kHost, kDevice}},
        {"vkQueueWaitIdle", {kLost, kHost, kDevice}},
        {"vkGetFenceStatus", {kLost, kHost, kDevice}},
        {"vkWaitForFences", {kLost, kHost, kDevice}},
        {"vkGetQueryPoolResults", {kLost, kHost, kDevice}},
        {"vkAllocateMemory", {kDevice, kHost, VK_ERROR_TOO_MANY_OBJECTS}},
        {"vkMapMemory", {VK_ERROR_MEMORY_MAP_FAILED, kHost, kDevice}},
        {"vkCreateDescriptorPool", {kDevice, VK_ERROR_FRAGMENTATION, kHost}},
        {"vkAllocateDescriptorSets", {VK_ERROR_OUT_OF_POOL_MEMORY, VK_ERROR_FRAGMENTED_POOL, kHost}},
        {"", {kDevice, kHost}},
    };
    return rows;
}

// Made by Denoise() and kept, so that a second attempt goes on behind the first.
constexpr std::string_view kKept[] = {
    "vkCreateShaderModule",   "vkCreateComputePipelines", "vkCreateDescriptorSetLayout",
    "vkCreatePipelineLayout", "vkCreateSampler",          "vkCreateImageView"};

struct Attempts
{
    size_t successes = 0;
    size_t failedAt = ~size_t{0}; // successes before the last failure
};

struct State
{
    Plan plan = Plan::None;
    size_t n = 0;
    size_t variant = 0;
    std::string_view function;
    VkResult functionResult = VK_SUCCESS;
    size_t calls = 0;
    std::map<std::string_view, Attempts> attempts;
    Fault fault;
    bool isHanging = false;
    size_t dispatchesLeft = 0;
    std::map<std::pair<std::string, uint64_t>, uint64_t> objects; // kind and handle, bytes
    size_t foreign = 0;
};

State& state()
{
    static State instance;
    return instance;
}

void start(Plan plan)
{
    state().plan = plan;
    state().calls = 0;
    state().attempts.clear();
    state().fault = {};
}

VkResult resultOf(const char* function, size_t variant)
{
    const std::vector<Results>& rows = allResults();
    auto row = std::find_if(rows.begin(), rows.end(),
                            [&](const Results& r) { return r.function == std::string_view(function); });
    if (row == rows.end()) row = std::prev(rows.end());
    return row->results[variant % row->results.size()];
}

bool isFirstAttempt(const char* function)
{
    if (std::find(std::begin(kKept), std::end(kKept), function) == std::end(kKept)) return false;
    Attempts& attempts = state().attempts[function];
    if (attempts.failedAt == attempts.successes)
    {
        attempts.successes++;
        return false;
    }
    attempts.failedAt = attempts.successes;
    return true;
}
} // namespace

void failNth(size_t n, size_t variant)
{
    start(Plan::Nth);
    state().n = n;
    state().variant = variant;
}

void failEachOnce() { start(Plan::EachOnce); }

void failCallsOf(const char* function, VkResult result)
{
    start(Plan::Function);
    state().function = function;
    state().functionResult = result;
}

void stop() { state().plan = Plan::None; }
size_t callCount() { return state().calls; }
Fault takeFault() { return std::exchange(state().fault, {}); }

void hangAfter(size_t dispatchNum)
{
    state().isHanging = true;
    state().dispatchesLeft = dispatchNum + 1; // the one that hangs has its commands before it executed
}

void unhang() { state().isHanging = false; }

Census census()
{
    Census result;
    for (const auto& [object, byteSize] : state().objects)
    {
        result.alive[object.first]++;
        result.memoryBytes += byteSize;
    }
    result.foreign = state().foreign;
    return result;
}

std::string toString(const Census& census)
{
    std::string text = std::to_string(census.memoryBytes) + " bytes";
    for (const auto& [kind, count] : census.alive) text += ", " + std::to_string(count) + " " + kind;
    return text + ", " + std::to_string(census.foreign) + " destroyed that were not alive";
}

namespace detail
{
bool isFailing(const char* function, VkResult& result)
{
    State& s = state();
    s.calls++;
    result = resultOf(function, s.variant);
    bool isIt = false;
    switch (s.plan)
    {
    case Plan::None:
        break;
    case Plan::Nth:
        isIt = s.calls == s.n;
        break;
    case Plan::EachOnce:
        isIt = isFirstAttempt(function);
        break;
    case Plan::Function:
        isIt = s.function == function;
        result = s.functionResult;
        break;
    }
    if (isIt) s.fault = {function, result};
    return isIt;
}

bool isExecuted(bool isDispatch)
{
    State& s = state();
    if (!s.isHanging) return true;
    if (isDispatch && s.dispatchesLeft > 0) s.dispatchesLeft--;
    return s.dispatchesLeft > 0;
}

void noteCreated(const char* kind, uint64_t handle, uint64_t byteSize) { state().objects[{kind, handle}] = byteSize; }

void noteDestroyed(const char* kind, uint64_t handle)
{
    if (state().objects.erase({kind, handle}) == 0) state().foreign++;
}
} // namespace detail
} // namespace faults
