// NrdIntegration on an engine's own Vulkan objects: a noisy wall is denoised for some frames. The namespace `engine`
// stands for yours; nothing of it is known to the library but VkDevice, VkCommandBuffer and VkImage.
#include "engine/commands.h"
#include "engine/transfer.h"
#include <cmath>
#include <cstdio>
#include <fstream>
#include <nrd/integration.h>
#include <random>

namespace
{
constexpr uint16_t kWidth = 256, kHeight = 128;
constexpr uint32_t kFramesInFlight = 2, kFrameCount = 32;
constexpr nrd::Identifier kIdentifier = 0; // our name for the denoiser
constexpr float kDepth = 5.0f, kTanHalfFov = 0.5f;

void check(nrd::Result result, const nrd::NrdIntegration& nrd)
{
    if (result != nrd::Result::SUCCESS) throw engine::Error(nrd.GetLastMessage()); // one sentence: what is wrong
}

// 1. Once: hand over the device, which main() created with the features the library asks for.
void create(nrd::NrdIntegration& nrd, const engine::Device& device)
{
    nrd::IntegrationCreationDesc desc;
    desc.native.instance = device.instance();
    desc.native.physicalDevice = device.physical();
    desc.native.device = device.handle();
    desc.native.queueFamilyIndex = device.queueFamily();
    desc.native.getInstanceProcAddr = vkGetInstanceProcAddr;
    desc.resourceWidth = kWidth;
    desc.resourceHeight = kHeight;
    desc.framesInFlight = kFramesInFlight;
    const nrd::DenoiserDesc denoiser = {kIdentifier, nrd::Denoiser::REBLUR_DIFFUSE_SPECULAR};
    nrd::InstanceCreationDesc instance;
    instance.denoisers = &denoiser;
    instance.denoisersNum = 1;
    instance.normalEncoding = nrd::NormalEncoding::RGBA16_SNORM; // for float images; the default packs into 10-10-10-2
    check(nrd.Create(desc, instance), nrd);
}

// 2. Every frame: the camera of this frame and of the one before. Here it stands still and looks along +Z.
nrd::CommonSettings frameSettings(uint32_t frameIndex)
{
    nrd::CommonSettings s;
    for (float* m : {s.viewToClipMatrix, s.viewToClipMatrixPrev}) // depth in [0; 1], far plane at infinity
    {
        m[0] = float(kHeight) / (kTanHalfFov * float(kWidth));
        m[5] = 1.0f / kTanHalfFov;
        m[10] = m[11] = 1.0f;
        m[14] = -0.1f;
    }
    for (float* m : {s.worldToViewMatrix, s.worldToViewMatrixPrev}) m[0] = m[5] = m[10] = m[15] = 1.0f;
    s.isMotionVectorInWorldSpace = true; // IN_MV holds the scene's own motion: zero
    for (uint16_t* size : {s.resourceSize, s.resourceSizePrev, s.rectSize, s.rectSizePrev})
        size[0] = kWidth, size[1] = kHeight;
    s.frameIndex = frameIndex;
    return s;
}

struct Slot
{
    nrd::ResourceType type;
    engine::Image image; // RGBA32F; remembers the state it was left in
};

void upload(const engine::Device& device, Slot& slot, const std::vector<float>& rgba)
{
    engine::upload(device, slot.image, std::as_bytes(std::span(rgba)));
}

std::vector<float> constant(float r, float g, float b, float a)
{
    std::vector<float> rgba;
    for (int i = 0; i < kWidth * kHeight; ++i) rgba.insert(rgba.end(), {r, g, b, a});
    return rgba;
}

// Luma (YCoCg) that is 0 or 4, 1 in the mean; normalised hit distance 0.5.
std::vector<float> noise(uint32_t seed)
{
    std::mt19937 random(seed);
    std::vector<float> rgba = constant(0, 0, 0, 0.5f);
    for (size_t i = 0; i < rgba.size(); i += 4) rgba[i] = random() % 4 == 0 ? 4.0f : 0.0f;
    return rgba;
}

double deviation(const std::vector<float>& rgba)
{
    double sum = 0.0; // of squared distances from the mean, 1
    for (size_t i = 0; i < rgba.size(); i += 4) sum += std::pow(double(rgba[i]) - 1.0, 2.0);
    return std::sqrt(sum / (kWidth * kHeight));
}

// 3. Every frame: name the images with the state they are in, record, and go on from the state they are left in.
void denoise(nrd::NrdIntegration& nrd, VkCommandBuffer cmd, std::vector<Slot>& slots, uint32_t frameIndex)
{
    check(nrd.NewFrame(), nrd);
    check(nrd.SetCommonSettings(frameSettings(frameIndex)), nrd);
    nrd::NrdUserPool pool;
    for (const Slot& slot : slots)
    {
        nrd::NrdUserImage& user = pool[slot.type];
        user.image = slot.image.handle();
        user.format = slot.image.desc().format;
        user.width = kWidth;
        user.height = kHeight;
        user.state = {slot.image.state.layout, slot.image.state.access, slot.image.state.stage};
    }
    check(nrd.Denoise(cmd, &kIdentifier, 1, pool), nrd);
    for (Slot& slot : slots)
        slot.image.state = {pool[slot.type].state.layout, pool[slot.type].state.access, pool[slot.type].state.stages};
}
} // namespace

int main(int argc, char** argv) // PICTURE, to keep the last one
try
{
    engine::DeviceDesc deviceDesc;
    deviceDesc.features = nrd::GetRequiredDeviceFeatures().features; // deviceExtensions is empty for core Vulkan 1.1
    const engine::Device device(deviceDesc);
    nrd::NrdIntegration nrd;
    create(nrd, device);
    std::vector<Slot> slots;
    using T = nrd::ResourceType;
    for (T type : {T::IN_DIFF_RADIANCE_HITDIST, T::IN_SPEC_RADIANCE_HITDIST, T::IN_MV, T::IN_VIEWZ,
                   T::IN_NORMAL_ROUGHNESS, T::OUT_DIFF_RADIANCE_HITDIST, T::OUT_SPEC_RADIANCE_HITDIST})
        slots.push_back({type, engine::Image(device, {nrd::toString(type), kWidth, kHeight})});
    upload(device, slots[2], constant(0, 0, 0, 0));
    upload(device, slots[3], constant(kDepth, 0, 0, 0));
    upload(device, slots[4], constant(0, 0, -1, 0.5f)); // NRD_FrontEnd_PackNormalAndRoughness((0, 0, -1), 0.5)
    engine::FrameRing ring(device, kFramesInFlight);
    for (uint32_t frame = 0; frame < kFrameCount; ++frame)
    {
        ring.waitAll(); // before the inputs change; an engine renders them on the device instead
        for (uint32_t lobe = 0; lobe < 2; ++lobe) upload(device, slots[lobe], noise(2 * frame + lobe));
        VkCommandBuffer cmd = ring.begin(); // waits for the frame before the last
        denoise(nrd, cmd, slots, frame);
        ring.submit();
    }
    ring.waitAll();
    const std::vector<float> picture = engine::readBackAs<float>(device, slots[5].image);
    const std::span bytes = std::as_bytes(std::span(picture));
    if (argc > 1) std::ofstream(argv[1]).write(reinterpret_cast<const char*>(bytes.data()), std::ssize(bytes));
    const double before = deviation(noise(0)), after = deviation(picture);
    std::printf("standard deviation of the noisy input %.3f, denoised %.3f\n", before, after);
    return after < 0.1 * before ? 0 : 1;
}
catch (const std::exception& error)
{
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
}
