// The plug-in in an engine whose main thread sets frames and queues events that a render thread executes. It is spoken
// to through its C header alone; the namespace `engine` stands for yours, and the wall's data for what it renders.
#include "engine/commands.h"
#include "engine/error.h"
#include "engine/transfer.h"
#include "noisy_wall.h"
#include <algorithm>
#include <cstdio>
#include <future>
#include <nrd/plugin.h>

namespace
{
constexpr uint32_t kDenoiser = NRD_PLUGIN_REBLUR_DIFFUSE_SPECULAR;

void check(NrdPluginResult result)
{
    if (result != NRD_PLUGIN_SUCCESS) throw engine::Error(NrdPluginGetLastMessage()); // one sentence: what is wrong
}

struct Slot
{
    nrd::ResourceType type; // only to say which of the wall's data it holds
    engine::Image image;
};

struct Engine
{
    Engine();
    ~Engine() { (void)NrdPluginReleaseAll(); } // the device is idle: every frame was waited for
    void initialize();
    void render(uint32_t frame, int eventId);

    static engine::DeviceDesc deviceDesc();
    engine::Device device{deviceDesc()};
    std::vector<Slot> slots;
    VkCommandBuffer current = VK_NULL_HANDLE; // that the render thread records now
};

engine::DeviceDesc Engine::deviceDesc()
{
    engine::DeviceDesc result;
    result.features.shaderStorageImageWriteWithoutFormat = VK_TRUE; // as the header says
    result.features.shaderStorageImageExtendedFormats = VK_TRUE;
    return result;
}

// 1. Once: the device, and how to get at the current command buffer.
Engine::Engine()
{
    NrdPluginDevice desc = {};
    desc.structSize = sizeof(desc);
    desc.queueFamilyIndex = device.queueFamily();
    desc.instance = device.instance();
    desc.physicalDevice = device.physical();
    desc.device = device.handle();
    desc.getInstanceProcAddr = vkGetInstanceProcAddr;
    desc.getCommandBuffer = [](void* self) { return static_cast<Engine*>(self)->current; };
    desc.userArg = this;
    desc.framesInFlight = 1;
    check(NrdPluginSetDevice(&desc));
    initialize();
}

nrd::ResourceType slotOf(const std::string& name)
{
    const auto isIt = [&](nrd::ResourceType slot) { return name == nrd::toString(slot); };
    return *std::find_if(std::begin(example::kSlots), std::end(example::kSlots), isIt);
}

// 2. Once for each denoiser, and again for another size: its images in the order that the plug-in tells.
void Engine::initialize()
{
    uint32_t imageNum = 0;
    check(NrdPluginGetImageNum(kDenoiser, &imageNum));
    std::vector<NrdPluginImage> images(imageNum);
    for (uint32_t i = 0; i < imageNum; i++)
    {
        NrdPluginImageInfo info = {};
        info.structSize = sizeof(info);
        check(NrdPluginGetImageInfo(kDenoiser, i, &info));
        if (!info.isRequired) continue; // left zeroed
        slots.push_back({slotOf(info.name), engine::Image(device, {info.name, example::kWidth, example::kHeight})});
        const engine::Image& image = slots.back().image;
        images[i] = {image.handle(), image.desc().format, example::kWidth, example::kHeight, VK_IMAGE_LAYOUT_GENERAL};
    }
    check(NrdPluginInitialize(kDenoiser, images.data(), imageNum));
}

// 3. Every frame, on the main thread: this frame's camera; the last one's is remembered.
int setFrame(uint32_t frame)
{
    const nrd::CommonSettings wall = example::settings(frame);
    NrdPluginFrame desc = {};
    desc.structSize = sizeof(desc);
    desc.frameIndex = frame;
    std::copy_n(wall.viewToClipMatrix, 16, desc.viewToClipMatrix);
    std::copy_n(wall.worldToViewMatrix, 16, desc.worldToViewMatrix);
    desc.isMotionVectorInWorldSpace = 1; // IN_MV holds the scene's own motion: zero
    desc.deltaTime = wall.timeDeltaBetweenFrames / 1000.0f;
    check(NrdPluginSetFrame(&desc));
    return NrdPluginGetEventId(kDenoiser, frame);
}

// 4. Every frame, on the render thread, up to three frames later: the images in their layout, then the event.
void Engine::render(uint32_t frame, int eventId)
{
    for (Slot& slot : slots)
    {
        const std::vector<float> rgba = example::texels(slot.type, frame);
        if (example::isInput(slot.type)) engine::upload(device, slot.image, std::as_bytes(std::span(rgba)));
    }
    const auto record = [&](VkCommandBuffer commands)
    {
        for (Slot& slot : slots) engine::transition(commands, slot.image, engine::kStorage);
        current = commands;
        check(NrdPluginExecute(eventId)); // or the callback of NrdPluginGetEventCallback()
    };
    engine::submitAndWait(device, record);
}

std::vector<float> denoiseWall()
{
    Engine engine;
    std::future<void> rendered;
    for (uint32_t frame = 0; frame < example::kFrameNum; frame++)
    {
        const int eventId = setFrame(frame); // while the frame before may still be rendered
        if (rendered.valid()) rendered.get();
        rendered = std::async(std::launch::async, [&engine, frame, eventId] { engine.render(frame, eventId); });
    }
    rendered.get();
    std::vector<float> result;
    for (Slot& slot : engine.slots)
    {
        if (example::isInput(slot.type)) continue;
        const std::vector<float> rgba = engine::readBackAs<float>(engine.device, slot.image);
        result.insert(result.end(), rgba.begin(), rgba.end());
    }
    return result;
}
} // namespace

int main(int argc, char** argv)
try
{
    if (argc != 2)
    {
        std::fprintf(stderr, "usage: %s PICTURE\n", argv[0]);
        return 2;
    }
    example::writePicture(argv[1], denoiseWall());
    std::printf("denoised %u frames\n", example::kFrameNum);
    return 0;
}
catch (const std::exception& error)
{
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
}
