#include "context.h"
#include "checks.h"

namespace rhi::vulkan
{
namespace
{
ErrorCode toErrorCode(VkResult result)
{
    switch (static_cast<int32_t>(result)) // the numbers: extensions add enumerators that cannot be listed here
    {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
        return ErrorCode::OutOfHostMemory;
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
    case VK_ERROR_TOO_MANY_OBJECTS:
        return ErrorCode::OutOfDeviceMemory;
    case VK_ERROR_DEVICE_LOST:
        return ErrorCode::DeviceLost;
    case VK_ERROR_OUT_OF_POOL_MEMORY:
    case VK_ERROR_FRAGMENTED_POOL:
        return ErrorCode::PoolExhausted;
    case VK_ERROR_INVALID_SHADER_NV:
        return ErrorCode::InvalidShader;
    case VK_ERROR_LAYER_NOT_PRESENT:
    case VK_ERROR_EXTENSION_NOT_PRESENT:
    case VK_ERROR_FEATURE_NOT_PRESENT:
    case VK_ERROR_INCOMPATIBLE_DRIVER:
    case VK_ERROR_FORMAT_NOT_SUPPORTED:
        return ErrorCode::Unsupported;
    default:
        return ErrorCode::Failure;
    }
}

PFN_vkGetDeviceProcAddr findGetDeviceProcAddr(const VulkanNativeDevice& native)
{
    if (!native.getInstanceProcAddr) throwInvalid("wrapped device: getInstanceProcAddr is null");
    if (!native.instance) throwInvalid("wrapped device: instance is null");
    if (!native.physicalDevice) throwInvalid("wrapped device: physicalDevice is null");
    if (!native.device) throwInvalid("wrapped device: device is null");
    if (native.getDeviceProcAddr) return native.getDeviceProcAddr;
    return Loader(native.getInstanceProcAddr, native.instance)("vkGetDeviceProcAddr");
}

DebugFunctions loadDebugFunctions(const VulkanNativeDevice& native)
{
    if (!native.isDebugUtilsEnabled) return {};
    const Loader load(native.getInstanceProcAddr, native.instance);
    return {load.optional("vkSetDebugUtilsObjectNameEXT"), load.optional("vkCmdBeginDebugUtilsLabelEXT"),
            load.optional("vkCmdEndDebugUtilsLabelEXT")};
}

DeviceLimits readLimits(const VkPhysicalDeviceLimits& vk, uint32_t subgroupSize, uint32_t timestampValidBits)
{
    DeviceLimits limits;
    limits.maxTextureSize = vk.maxImageDimension2D;
    for (size_t i = 0; i < 3; i++) limits.maxGroupCount[i] = vk.maxComputeWorkGroupCount[i];
    limits.maxSampledTextures = vk.maxPerStageDescriptorSampledImages;
    limits.maxStorageTextures = vk.maxPerStageDescriptorStorageImages;
    limits.uniformOffsetAlignment = static_cast<uint32_t>(vk.minUniformBufferOffsetAlignment);
    limits.storageOffsetAlignment = static_cast<uint32_t>(vk.minStorageBufferOffsetAlignment);
    limits.maxUniformSize = vk.maxUniformBufferRange;
    limits.subgroupSize = subgroupSize;
    limits.timestampValidBits = timestampValidBits;
    limits.timestampPeriod = static_cast<double>(vk.timestampPeriod);
    return limits;
}

VkQueueFamilyProperties queueFamily(const Context& context)
{
    uint32_t count = 0;
    context.instanceFn.getQueueFamilyProperties(context.physicalDevice, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    context.instanceFn.getQueueFamilyProperties(context.physicalDevice, &count, families.data());
    if (context.queueFamilyIndex >= count)
        throwInvalid(sentence("wrapped device: queueFamilyIndex is %u, the device has %u families",
                              context.queueFamilyIndex, count));
    if (!(families[context.queueFamilyIndex].queueFlags & VK_QUEUE_COMPUTE_BIT))
        throwInvalid(sentence("wrapped device: queue family %u has no compute", context.queueFamilyIndex));
    return families[context.queueFamilyIndex];
}
} // namespace

Context::Context(const VulkanNativeDevice& native)
    : instance(native.instance), physicalDevice(native.physicalDevice), device(native.device),
      queueFamilyIndex(native.queueFamilyIndex), queue(native.queue), pipelineCache(native.pipelineCache),
      callbacks(native.allocationCallbacks), getInstanceProcAddr(native.getInstanceProcAddr),
      getDeviceProcAddr(findGetDeviceProcAddr(native)),
      instanceFn{Loader(getInstanceProcAddr, instance)}, fn{Loader(getDeviceProcAddr, device)},
      debugFn(loadDebugFunctions(native))
{
    const VkQueueFamilyProperties family = queueFamily(*this);
    auto subgroup = vkStruct<VkPhysicalDeviceSubgroupProperties>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES);
    auto properties = vkStruct<VkPhysicalDeviceProperties2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2);
    properties.pNext = &subgroup;
    instanceFn.getPhysicalDeviceProperties2(physicalDevice, &properties);
    instanceFn.getMemoryProperties(physicalDevice, &memoryProperties);
    info.name = properties.properties.deviceName;
    info.limits = readLimits(properties.properties.limits, subgroup.subgroupSize, family.timestampValidBits);
    info.isSoftware = properties.properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
    info.hasSynchronization2 = native.isSynchronization2Enabled && fn.cmdPipelineBarrier2;
    info.hasDebugLabels = debugFn.cmdBeginLabel && debugFn.cmdEndLabel;
    info.hasFloat16 = native.isFloat16Enabled;
}

void Context::setNameOf(VkObjectType type, uint64_t handle, const char* name) const
{
    if (!debugFn.setObjectName) return;
    const VkDebugUtilsObjectNameInfoEXT nameInfo = {VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT, nullptr, type,
                                                    handle, name};
    debugFn.setObjectName(device, &nameInfo);
}

void check(VkResult result, const char* what, const char* name)
{
    if (result >= VK_SUCCESS) return;
    const ErrorCode code = toErrorCode(result);
    throw Error(code, sentence("%s '%s': %s (VkResult %d)", what, safeName(name), toString(code), result), result);
}
} // namespace rhi::vulkan
