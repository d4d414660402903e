#include "recording_plugin.h"
#include "integration_access.h"
#include "plugin_access.h"
#include <sstream>

namespace test
{
namespace
{
VkCommandBuffer commandBuffer(void*) { return reinterpret_cast<VkCommandBuffer>(uintptr_t(0xC0DE)); }

std::string textOf(const rhi::RecordedCall& call)
{
    std::ostringstream text;
    text << toString(call.type) << ' ' << call.name << ' ' << call.other << ' ' << call.index << ' ' << call.handle;
    for (const uint32_t group : call.groups) text << ' ' << group;
    for (const uint32_t offset : call.dynamicOffsets) text << " +" << offset;
    for (const rhi::SpecConstant& constant : call.constants) text << " c" << constant.id << '=' << constant.value;
    for (const rhi::RecordedBarrier& barrier : call.barriers)
        text << " b" << barrier.name << ':' << unsigned(barrier.before.layout) << '>' << unsigned(barrier.after.layout);
    for (const rhi::RecordedBinding& binding : call.bindings)
        text << " r" << binding.binding << ':' << binding.name << '@' << binding.offset;
    return text.str();
}
} // namespace

std::vector<std::string> RecordedDevice::calls() const
{
    std::vector<std::string> result;
    for (const rhi::RecordedCall& call : device->calls()) result.push_back(textOf(call));
    return result;
}

std::vector<std::string> RecordedDevice::uploads() const
{
    std::vector<std::string> result;
    for (const rhi::Buffer* buffer : spy.uploadBuffers())
        result.emplace_back(static_cast<const char*>(buffer->mapped()), buffer->desc().size);
    return result;
}

RecordingPlugin::RecordingPlugin()
{
    nrd::plugin::PluginAccess::SetCreator(
        [this](nrd::NrdIntegration& integration, const nrd::IntegrationCreationDesc& desc,
               const nrd::InstanceCreationDesc& instance)
        { return nrd::IntegrationAccess::Create(integration, devices.emplace_back().spy, desc, instance); });
    const NrdPluginDevice device = deviceDesc();
    requireSuccess(NrdPluginSetDevice(&device));
}

RecordingPlugin::~RecordingPlugin()
{
    (void)NrdPluginReleaseAll();
    (void)NrdPluginSetMessageCallback(nullptr, nullptr);
    nrd::plugin::PluginAccess::SetCreator({});
}

NrdPluginDevice RecordingPlugin::deviceDesc()
{
    NrdPluginDevice result = {};
    result.structSize = sizeof(result);
    result.getCommandBuffer = commandBuffer;
    return result;
}

NrdPluginImage RecordingPlugin::image(uintptr_t number, Size size)
{
    NrdPluginImage result = {};
    result.image = reinterpret_cast<VkImage>(number);
    result.format = VK_FORMAT_R32G32B32A32_SFLOAT;
    result.width = size.width;
    result.height = size.height;
    result.layout = VK_IMAGE_LAYOUT_GENERAL;
    return result;
}

std::vector<NrdPluginImage> RecordingPlugin::images(uint32_t denoiser, bool isAll, Size size)
{
    uint32_t imageNum = 0;
    requireSuccess(NrdPluginGetImageNum(denoiser, &imageNum));
    std::vector<NrdPluginImage> result(imageNum);
    for (uint32_t i = 0; i < imageNum; i++)
    {
        NrdPluginImageInfo info = {};
        info.structSize = sizeof(info);
        requireSuccess(NrdPluginGetImageInfo(denoiser, i, &info));
        if (isAll || info.isRequired) result[i] = image(0x100 + i, size);
    }
    return result;
}

NrdPluginResult RecordingPlugin::initialize(uint32_t denoiser, Size size)
{
    const std::vector<NrdPluginImage> list = images(denoiser, false, size);
    return NrdPluginInitialize(denoiser, list.data(), static_cast<uint32_t>(list.size()));
}
} // namespace test
