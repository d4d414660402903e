// The exported functions: arguments are checked for null and size, exceptions become results, and a refusal's sentence
// is kept for its thread and reported.
#include "convert.h"
#include "plugin.h"
#include "plugin_access.h"
#include "refusal.h"
#include <cstdio>
#include <rhi/vulkan.h>

namespace nrd::plugin
{
namespace
{
struct MessageTarget
{
    NrdPluginMessageCallback callback = nullptr;
    void* userArg = nullptr;
};

struct State
{
    Plugin plugin;
    std::mutex mutex; // of the two below
    MessageTarget target;
    Creator create;
};

// Never destroyed: at the end of the process the engine's device may be gone, and what is left must not touch it.
State& state()
{
    static State& instance = *new State;
    return instance;
}

thread_local char t_message[512] = "";

NrdPluginResult toPlugin(Result result)
{
    switch (result)
    {
    case Result::SUCCESS:
        return NRD_PLUGIN_SUCCESS;
    case Result::INVALID_ARGUMENT:
    case Result::NON_UNIQUE_IDENTIFIER:
        return NRD_PLUGIN_INVALID_ARGUMENT;
    case Result::UNSUPPORTED:
        return NRD_PLUGIN_UNSUPPORTED;
    case Result::FAILURE:
    case Result::MAX_NUM:
        break;
    }
    return NRD_PLUGIN_FAILURE;
}

MessageTarget target()
{
    const std::lock_guard lock(state().mutex);
    return state().target;
}

NrdPluginResult fail(NrdPluginResult result, const char* text)
{
    std::snprintf(t_message, sizeof(t_message), "%s", text);
    const MessageTarget to = target();
    if (to.callback) to.callback(to.userArg, result, t_message);
    return result;
}

// The one place where exceptions end; the engine's callback may throw as it likes, but not through here.
template <class Body> NrdPluginResult guarded(Body&& body) noexcept
try
{
    try
    {
        body();
        return NRD_PLUGIN_SUCCESS;
    }
    catch (const Refusal& error)
    {
        return fail(toPlugin(error.result()), error.what());
    }
    catch (const std::exception& error) // memory of the host
    {
        return fail(NRD_PLUGIN_FAILURE, error.what());
    }
}
catch (...)
{
    return NRD_PLUGIN_FAILURE;
}

template <class T> const T& require(const T* argument, const char* name)
{
    if (!argument) throw Refusal(Result::INVALID_ARGUMENT, sentence("%s is null", name));
    return *argument;
}

template <class T> T& requireOut(T* argument, const char* name)
{
    (void)require(argument, name);
    return *argument;
}

// Structs only grow at their end: a caller with a newer header hands in more than is known here.
template <class T> void requireSize(const T& argument, const char* name)
{
    if (argument.structSize < sizeof(T))
        throw Refusal(Result::INVALID_ARGUMENT, sentence("%s.structSize is %u, must be sizeof = %u", name,
                                                         argument.structSize, static_cast<uint32_t>(sizeof(T))));
}

Creator creator()
{
    const std::lock_guard lock(state().mutex);
    if (state().create) return state().create;
    return [](NrdIntegration& integration, const IntegrationCreationDesc& desc, const InstanceCreationDesc& instance)
    { return integration.Create(desc, instance); };
}

void describe(const ResourceRequirement& slot, NrdPluginImageInfo& info)
{
    info.isRequired = slot.isRequired ? 1 : 0;
    info.isOutput = slot.descriptorType == DescriptorType::STORAGE_TEXTURE ? 1 : 0;
    info.minFormat = rhi::toVulkan(toRhi(slot.minFormat));
    info.name = toString(slot.type);
}

void onEvent(int eventId) { (void)NrdPluginExecute(eventId); }
} // namespace

void PluginAccess::SetCreator(Creator create)
{
    const std::lock_guard lock(state().mutex);
    state().create = std::move(create);
}
} // namespace nrd::plugin

using namespace nrd::plugin;

NrdPluginResult NrdPluginSetDevice(const NrdPluginDevice* device)
{
    return guarded(
        [&]
        {
            requireSize(require(device, "device"), "device");
            state().plugin.setDevice(*device, creator());
        });
}

NrdPluginResult NrdPluginGetImageNum(uint32_t denoiser, uint32_t* imageNum)
{
    return guarded(
        [&] { requireOut(imageNum, "imageNum") = static_cast<uint32_t>(imageSlots(toDenoiser(denoiser)).size()); });
}

NrdPluginResult NrdPluginGetImageInfo(uint32_t denoiser, uint32_t index, NrdPluginImageInfo* info)
{
    return guarded(
        [&]
        {
            requireSize(requireOut(info, "info"), "info");
            const std::vector<nrd::ResourceRequirement> slots = imageSlots(toDenoiser(denoiser));
            if (index >= slots.size())
                throw nrd::Refusal(nrd::Result::INVALID_ARGUMENT,
                                   nrd::sentence("index is %u, %s takes %u images", index,
                                                 nrd::toString(toDenoiser(denoiser)),
                                                 static_cast<uint32_t>(slots.size())));
            describe(slots[index], *info);
        });
}

NrdPluginResult NrdPluginInitialize(uint32_t denoiser, const NrdPluginImage* images, uint32_t imageNum)
{
    return guarded([&] { state().plugin.initialize(denoiser, {images, imageNum}); });
}

NrdPluginResult NrdPluginGetSettingNum(uint32_t denoiser, uint32_t* num)
{
    return guarded([&] { requireOut(num, "settingNum") = settingNum(toDenoiser(denoiser)); });
}

NrdPluginResult NrdPluginGetSettingInfo(uint32_t denoiser, uint32_t index, NrdPluginSettingInfo* info)
{
    return guarded(
        [&]
        {
            requireSize(requireOut(info, "info"), "info");
            state().plugin.describeSetting(denoiser, index, *info);
        });
}

NrdPluginResult NrdPluginSetSetting(uint32_t denoiser, const char* name, double value)
{
    return guarded([&] { state().plugin.setSetting(denoiser, &require(name, "name"), value); });
}

NrdPluginResult NrdPluginSetFrame(const NrdPluginFrame* frame)
{
    return guarded(
        [&]
        {
            requireSize(require(frame, "frame"), "frame");
            state().plugin.setFrame(*frame);
        });
}

int NrdPluginGetEventId(uint32_t denoiser, uint32_t frameIndex) { return makeEventId(denoiser, frameIndex); }

NrdPluginResult NrdPluginGetEventCallback(NrdPluginEventCallback* callback)
{
    return guarded([&] { requireOut(callback, "callback") = onEvent; });
}

NrdPluginResult NrdPluginExecute(int eventId)
{
    return guarded([&] { state().plugin.execute(static_cast<uint32_t>(eventId)); });
}

NrdPluginResult NrdPluginRelease(uint32_t denoiser)
{
    return guarded([&] { state().plugin.release(denoiser); });
}

NrdPluginResult NrdPluginReleaseAll(void)
{
    return guarded([] { state().plugin.releaseAll(); });
}

NrdPluginResult NrdPluginSetMessageCallback(NrdPluginMessageCallback callback, void* userArg)
{
    return guarded(
        [&]
        {
            const std::lock_guard lock(state().mutex);
            state().target = {callback, userArg};
        });
}

const char* NrdPluginGetLastMessage(void) { return t_message; }
