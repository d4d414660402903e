#include "hooks.h"
#include "allocations.h"
#include "injection.h"
#include <algorithm>
#include <dlfcn.h>
#include <rhi/vulkan.h>
#include <string_view>
#include <tuple>

namespace faults
{
namespace
{
template <size_t N> struct Name
{
    constexpr Name(const char (&from)[N]) { std::copy_n(from, N, text); }
    constexpr bool startsWith(std::string_view part) const { return std::string_view(text).starts_with(part); }
    constexpr const char* kind(size_t prefixLength) const { return text + prefixLength; }
    char text[N] = {};
};

constexpr size_t kCreateLength = sizeof("vkCreate") - 1;
constexpr size_t kDestroyLength = sizeof("vkDestroy") - 1;
constexpr uint64_t kGarbage = 0xDEADBEEFDEADBEEF; // what a failed call leaves where the handle would be

template <class T> uint64_t toNumber(T handle) { return rhi::detail::toHandle(handle); }

// The arguments of one call, and what they say about objects.
template <Name kName, class... Arguments> struct Objects
{
    static constexpr bool kIsPipelines = kName.startsWith("vkCreateComputePipelines");
    static constexpr bool kIsMemory = kName.startsWith("vkAllocateMemory");
    static constexpr bool kIsCreation = kName.startsWith("vkCreate") || kIsMemory;
    static constexpr bool kIsDestruction = kName.startsWith("vkDestroy") || kName.startsWith("vkFreeMemory");
    using All = std::tuple<Arguments...>;

    static constexpr const char* kind()
    {
        if constexpr (kIsPipelines) return "Pipeline";
        if constexpr (kIsMemory || kName.startsWith("vkFreeMemory")) return "Memory";
        return kName.kind(kName.startsWith("vkCreate") ? kCreateLength : kDestroyLength);
    }
    static void spoil(const All& arguments)
    {
        if constexpr (kIsCreation)
        {
            auto* handle = std::get<sizeof...(Arguments) - 1>(arguments);
            using Handle = std::remove_pointer_t<decltype(handle)>;
            *handle = kIsPipelines ? Handle{VK_NULL_HANDLE} : rhi::detail::fromHandle<Handle>(kGarbage);
        }
    }
    static void noteAfter(const All& arguments)
    {
        if constexpr (kIsCreation)
        {
            uint64_t byteSize = 0;
            if constexpr (kIsMemory) byteSize = std::get<1>(arguments)->allocationSize;
            detail::noteCreated(kind(), toNumber(*std::get<sizeof...(Arguments) - 1>(arguments)), byteSize);
        }
    }
    static void noteBefore(const All& arguments)
    {
        if constexpr (kIsDestruction)
        {
            const uint64_t handle = toNumber(std::get<sizeof...(Arguments) - 2>(arguments)); // before the callbacks
            if (handle != 0) detail::noteDestroyed(kind(), handle);
        }
    }
};

template <Name kName, class Function> struct Hook;
template <Name kName, class Return, class... Arguments> struct Hook<kName, Return(VKAPI_PTR*)(Arguments...)>
{
    using Function = Return(VKAPI_PTR*)(Arguments...);
    using About = Objects<kName, Arguments...>;
    static constexpr bool kIsDispatch = kName.startsWith("vkCmdDispatch");
    static constexpr bool kIsDropped = kIsDispatch || kName.startsWith("vkCmdFillBuffer");
    static inline Function real = nullptr;

    static PFN_vkVoidFunction stand(PFN_vkVoidFunction function)
    {
        real = reinterpret_cast<Function>(function);
        return reinterpret_cast<PFN_vkVoidFunction>(call);
    }

    static VKAPI_ATTR Return VKAPI_CALL call(Arguments... arguments)
    {
        const test::AllocationPause pause; // the heap of the layers and of the driver is not the library's
        const std::tuple<Arguments...> all(arguments...);
        if constexpr (std::is_same_v<Return, VkResult>)
        {
            VkResult result = VK_SUCCESS;
            if (detail::isFailing(kName.text, result))
                About::spoil(all);
            else if (result = real(arguments...); result == VK_SUCCESS)
                About::noteAfter(all);
            return result;
        }
        else
        {
            if constexpr (kIsDropped)
                if (!detail::isExecuted(kIsDispatch)) return;
            About::noteBefore(all);
            return real(arguments...);
        }
    }
};

struct Row
{
    const char* name;
    PFN_vkVoidFunction (*stand)(PFN_vkVoidFunction real);
};
template <Name kName, class Function> constexpr Row kRow = {kName.text, Hook<kName, Function>::stand};

// What rhi/src/vulkan loads.
constexpr Row kRows[] = {
    kRow<"vkGetPhysicalDeviceProperties2", PFN_vkGetPhysicalDeviceProperties2>,
    kRow<"vkGetPhysicalDeviceFormatProperties", PFN_vkGetPhysicalDeviceFormatProperties>,
    kRow<"vkGetPhysicalDeviceMemoryProperties", PFN_vkGetPhysicalDeviceMemoryProperties>,
    kRow<"vkGetPhysicalDeviceQueueFamilyProperties", PFN_vkGetPhysicalDeviceQueueFamilyProperties>,
    kRow<"vkGetDeviceQueue", PFN_vkGetDeviceQueue>,
    kRow<"vkQueueSubmit", PFN_vkQueueSubmit>,
    kRow<"vkQueueWaitIdle", PFN_vkQueueWaitIdle>,
    kRow<"vkAllocateMemory", PFN_vkAllocateMemory>,
    kRow<"vkFreeMemory", PFN_vkFreeMemory>,
    kRow<"vkMapMemory", PFN_vkMapMemory>,
    kRow<"vkCreateImage", PFN_vkCreateImage>,
    kRow<"vkDestroyImage", PFN_vkDestroyImage>,
    kRow<"vkGetImageMemoryRequirements", PFN_vkGetImageMemoryRequirements>,
    kRow<"vkBindImageMemory", PFN_vkBindImageMemory>,
    kRow<"vkCreateImageView", PFN_vkCreateImageView>,
    kRow<"vkDestroyImageView", PFN_vkDestroyImageView>,
    kRow<"vkCreateBuffer", PFN_vkCreateBuffer>,
    kRow<"vkDestroyBuffer", PFN_vkDestroyBuffer>,
    kRow<"vkGetBufferMemoryRequirements", PFN_vkGetBufferMemoryRequirements>,
    kRow<"vkBindBufferMemory", PFN_vkBindBufferMemory>,
    kRow<"vkCreateSampler", PFN_vkCreateSampler>,
    kRow<"vkDestroySampler", PFN_vkDestroySampler>,
    kRow<"vkCreateDescriptorSetLayout", PFN_vkCreateDescriptorSetLayout>,
    kRow<"vkDestroyDescriptorSetLayout", PFN_vkDestroyDescriptorSetLayout>,
    kRow<"vkCreatePipelineLayout", PFN_vkCreatePipelineLayout>,
    kRow<"vkDestroyPipelineLayout", PFN_vkDestroyPipelineLayout>,
    kRow<"vkCreateShaderModule", PFN_vkCreateShaderModule>,
    kRow<"vkDestroyShaderModule", PFN_vkDestroyShaderModule>,
    kRow<"vkCreateComputePipelines", PFN_vkCreateComputePipelines>,
    kRow<"vkDestroyPipeline", PFN_vkDestroyPipeline>,
    kRow<"vkCreateDescriptorPool", PFN_vkCreateDescriptorPool>,
    kRow<"vkDestroyDescriptorPool", PFN_vkDestroyDescriptorPool>,
    kRow<"vkResetDescriptorPool", PFN_vkResetDescriptorPool>,
    kRow<"vkAllocateDescriptorSets", PFN_vkAllocateDescriptorSets>,
    kRow<"vkUpdateDescriptorSets", PFN_vkUpdateDescriptorSets>,
    kRow<"vkCreateQueryPool", PFN_vkCreateQueryPool>,
    kRow<"vkDestroyQueryPool", PFN_vkDestroyQueryPool>,
    kRow<"vkGetQueryPoolResults", PFN_vkGetQueryPoolResults>,
    kRow<"vkCreateFence", PFN_vkCreateFence>,
    kRow<"vkDestroyFence", PFN_vkDestroyFence>,
    kRow<"vkGetFenceStatus", PFN_vkGetFenceStatus>,
    kRow<"vkWaitForFences", PFN_vkWaitForFences>,
    kRow<"vkResetFences", PFN_vkResetFences>,
    kRow<"vkCreateCommandPool", PFN_vkCreateCommandPool>,
    kRow<"vkDestroyCommandPool", PFN_vkDestroyCommandPool>,
    kRow<"vkResetCommandPool", PFN_vkResetCommandPool>,
    kRow<"vkAllocateCommandBuffers", PFN_vkAllocateCommandBuffers>,
    kRow<"vkBeginCommandBuffer", PFN_vkBeginCommandBuffer>,
    kRow<"vkEndCommandBuffer", PFN_vkEndCommandBuffer>,
    kRow<"vkCmdBindPipeline", PFN_vkCmdBindPipeline>,
    kRow<"vkCmdBindDescriptorSets", PFN_vkCmdBindDescriptorSets>,
    kRow<"vkCmdDispatch", PFN_vkCmdDispatch>,
    kRow<"vkCmdDispatchIndirect", PFN_vkCmdDispatchIndirect>,
    kRow<"vkCmdPipelineBarrier", PFN_vkCmdPipelineBarrier>,
    kRow<"vkCmdCopyBufferToImage", PFN_vkCmdCopyBufferToImage>,
    kRow<"vkCmdCopyImageToBuffer", PFN_vkCmdCopyImageToBuffer>,
    kRow<"vkCmdCopyImage", PFN_vkCmdCopyImage>,
    kRow<"vkCmdCopyBuffer", PFN_vkCmdCopyBuffer>,
    kRow<"vkCmdFillBuffer", PFN_vkCmdFillBuffer>,
    kRow<"vkCmdClearColorImage", PFN_vkCmdClearColorImage>,
    kRow<"vkCmdResetQueryPool", PFN_vkCmdResetQueryPool>,
    kRow<"vkCmdWriteTimestamp", PFN_vkCmdWriteTimestamp>,
    kRow<"vkCmdPipelineBarrier2", PFN_vkCmdPipelineBarrier2>,
    kRow<"vkSetDebugUtilsObjectNameEXT", PFN_vkSetDebugUtilsObjectNameEXT>,
    kRow<"vkCmdBeginDebugUtilsLabelEXT", PFN_vkCmdBeginDebugUtilsLabelEXT>,
    kRow<"vkCmdEndDebugUtilsLabelEXT", PFN_vkCmdEndDebugUtilsLabelEXT>,
    kRow<"vkEnumerateDeviceExtensionProperties", PFN_vkEnumerateDeviceExtensionProperties>,
    kRow<"vkGetPhysicalDeviceProperties", PFN_vkGetPhysicalDeviceProperties>,
    kRow<"vkGetPhysicalDeviceFeatures2", PFN_vkGetPhysicalDeviceFeatures2>,
    kRow<"vkCreateDevice", PFN_vkCreateDevice>,
    kRow<"vkDestroyDevice", PFN_vkDestroyDevice>,
    kRow<"vkEnumerateInstanceExtensionProperties", PFN_vkEnumerateInstanceExtensionProperties>,
    kRow<"vkEnumerateInstanceLayerProperties", PFN_vkEnumerateInstanceLayerProperties>,
    kRow<"vkDestroyInstance", PFN_vkDestroyInstance>,
    kRow<"vkDestroyDebugUtilsMessengerEXT", PFN_vkDestroyDebugUtilsMessengerEXT>,
    kRow<"vkEnumerateInstanceVersion", PFN_vkEnumerateInstanceVersion>,
    kRow<"vkCreateInstance", PFN_vkCreateInstance>,
    kRow<"vkCreateDebugUtilsMessengerEXT", PFN_vkCreateDebugUtilsMessengerEXT>,
    kRow<"vkEnumeratePhysicalDevices", PFN_vkEnumeratePhysicalDevices>,
};

struct Loaders
{
    PFN_vkGetInstanceProcAddr getInstanceProcAddr = nullptr;
    PFN_vkGetDeviceProcAddr getDeviceProcAddr = nullptr;
    std::vector<std::string> unhooked;
    bool isLinkedHooked = false;
};

Loaders& loaders()
{
    static Loaders instance;
    return instance;
}

PFN_vkVoidFunction hooked(const char* name, PFN_vkVoidFunction real)
{
    if (!real) return nullptr;
    const test::AllocationPause pause;
    const auto row = std::find_if(std::begin(kRows), std::end(kRows),
                                  [name](const Row& r) { return std::string_view(r.name) == name; });
    if (row != std::end(kRows)) return row->stand(real);
    loaders().unhooked.push_back(name);
    return real;
}

PFN_vkGetInstanceProcAddr linkedLoader()
{
    static void* const library = dlopen("libvulkan.so.1", RTLD_NOW);
    static void* const function = library ? dlsym(library, "vkGetInstanceProcAddr") : nullptr;
    return reinterpret_cast<PFN_vkGetInstanceProcAddr>(function);
}
} // namespace

void standBefore(PFN_vkGetInstanceProcAddr getInstanceProcAddr, PFN_vkGetDeviceProcAddr getDeviceProcAddr)
{
    loaders().getInstanceProcAddr = getInstanceProcAddr;
    loaders().getDeviceProcAddr = getDeviceProcAddr;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL hookedInstanceProcAddr(VkInstance instance, const char* name)
{
    const std::string_view text = name;
    if (text == "vkGetInstanceProcAddr") return reinterpret_cast<PFN_vkVoidFunction>(hookedInstanceProcAddr);
    const PFN_vkVoidFunction real = loaders().getInstanceProcAddr(instance, name);
    if (text != "vkGetDeviceProcAddr") return hooked(name, real);
    loaders().getDeviceProcAddr = reinterpret_cast<PFN_vkGetDeviceProcAddr>(real);
    return reinterpret_cast<PFN_vkVoidFunction>(hookedDeviceProcAddr);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL hookedDeviceProcAddr(VkDevice device, const char* name)
{
    return hooked(name, loaders().getDeviceProcAddr(device, name));
}

const std::vector<std::string>& unhooked() { return loaders().unhooked; }

LinkedLoaderHook::LinkedLoaderHook()
{
    standBefore(linkedLoader(), nullptr);
    loaders().isLinkedHooked = true;
}

LinkedLoaderHook::~LinkedLoaderHook() { loaders().isLinkedHooked = false; }
} // namespace faults

// In place of the linked loader's: the one function by which the library gets at it.
extern "C" __attribute__((visibility("hidden"))) PFN_vkVoidFunction VKAPI_CALL
vkGetInstanceProcAddr(VkInstance instance, const char* name)
{
    if (faults::loaders().isLinkedHooked) return faults::hookedInstanceProcAddr(instance, name);
    return faults::linkedLoader()(instance, name);
}
