// A device of the library's own, made through the linked loader: the calls that an instance, a device and its objects
// take, each of which fails once.
#include "catch.h"
#include "hooks.h"
#include "injection.h"
#include "long_form.h"
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <rhi/rhi.h>
#include <rhi/vulkan.h>

using namespace faults;

namespace
{
struct Messages
{
    std::mutex mutex;
    std::vector<std::string> texts;
};

std::unique_ptr<rhi::Device> makeDevice(Messages& messages)
{
    rhi::VulkanDeviceDesc desc;
    if (const char* name = std::getenv("NRD_TEST_DEVICE")) desc.adapter = name;
    desc.isValidationEnabled = std::getenv("NRD_TEST_NO_VALIDATION") == nullptr;
    desc.messageCallback = [&messages](rhi::MessageSeverity severity, const std::string& text)
    {
        if (severity == rhi::MessageSeverity::Info) return;
        const std::lock_guard lock(messages.mutex);
        messages.texts.push_back(text);
    };
    return rhi::makeVulkanDevice(desc);
}

std::unique_ptr<rhi::Buffer> makeBuffer(rhi::Device& device, rhi::BufferMemory memory)
{
    rhi::BufferDesc desc;
    desc.size = 16 * 16 * 4;
    desc.usage = rhi::BufferUsage::TransferSrc | rhi::BufferUsage::TransferDst;
    desc.memory = memory;
    desc.name = "texels";
    return device.createBuffer(desc);
}

struct Copies
{
    rhi::Texture& texture;
    rhi::Buffer& upload;
    rhi::Buffer& readback;
    rhi::QueryPool& queries;
};

void record(rhi::CommandBuffer& commands, const Copies& copies)
{
    commands.begin();
    commands.resetQueries(copies.queries, 0, 2);
    commands.writeTimestamp(copies.queries, 0);
    commands.barrier(rhi::TextureBarrier{&copies.texture, rhi::states::kUndefined, rhi::states::kTransferDst});
    commands.copyBufferToTexture({&copies.texture, 0, &copies.upload, 0});
    commands.barrier(rhi::TextureBarrier{&copies.texture, rhi::states::kTransferDst, rhi::states::kTransferSrc});
    commands.copyTextureToBuffer({&copies.texture, 0, &copies.readback, 0});
    commands.barrier(rhi::BufferBarrier{&copies.readback,
                                        {rhi::Access::TransferWrite, rhi::Stage::Transfer},
                                        {rhi::Access::HostRead, rhi::Stage::Host}});
    commands.writeTimestamp(copies.queries, 1);
    commands.end();
}

// A texture there and back, timed.
void copyThereAndBack(rhi::Device& device)
{
    rhi::TextureDesc desc;
    desc.format = rhi::Format::RGBA8_UNORM;
    desc.width = desc.height = 16;
    desc.usage = rhi::TextureUsage::Sampled | rhi::TextureUsage::TransferSrc | rhi::TextureUsage::TransferDst;
    desc.name = "copied";
    const auto texture = device.createTexture(desc);
    const auto view = device.createView(*texture, {rhi::ViewType::Sampled, {0, 1}});
    const auto upload = makeBuffer(device, rhi::BufferMemory::Upload);
    const auto readback = makeBuffer(device, rhi::BufferMemory::Readback);
    const auto queries = device.createQueryPool({2, "times"});
    const auto commands = device.createCommandBuffer("copies");
    const auto fence = device.createFence("end of copies");
    std::memset(upload->mapped(), 0x5A, upload->desc().size);
    record(*commands, {*texture, *upload, *readback, *queries});

    struct Idle // before what the device may use is destroyed, whatever failed
    {
        rhi::Device& device;
        ~Idle()
        {
            stop();
            device.waitIdle();
        }
    } const idle{device};
    rhi::CommandBuffer* const list[] = {commands.get()};
    device.submit(list, fence.get());
    const bool isDone = fence->wait() && fence->isSignaled(); // outside of the checks, which take errors for failures
    uint64_t ticks[2] = {};
    const bool isTimed = queries->read(0, ticks);
    fence->reset();
    device.waitIdle();
    CHECK(isDone);
    CHECK(isTimed);
    CHECK(std::memcmp(upload->mapped(), readback->mapped(), upload->desc().size) == 0);
}

// The sentence of the error that came of the n-th call, empty if none did.
std::string failAt(size_t n, size_t variant, Messages& messages)
{
    failNth(n, variant);
    std::string sentence;
    try
    {
        const std::unique_ptr<rhi::Device> device = makeDevice(messages);
        copyThereAndBack(*device);
    }
    catch (const rhi::Error& error)
    {
        sentence = error.what();
    }
    stop();
    return sentence;
}
} // namespace

TEST_CASE("every call of Vulkan that a device of our own makes can fail, and nothing leaks", "[gpu]")
{
    const LinkedLoaderHook hook;
    size_t faultNum = 0;
    for (size_t variant = 0; variant < (test::isLong() ? 3u : 1u); variant++)
        for (size_t n = 1;; n++)
        {
            Messages messages;
            (void)takeFault();
            const std::string sentence = failAt(n, variant, messages);
            const Fault fault = takeFault();
            const Census alive = census();
            INFO("call " << n << ", " << (fault.function ? fault.function : "no fault") << ": " << sentence);
            for (const std::string& text : messages.texts) FAIL_CHECK(text);
            INFO(toString(alive));
            CHECK(alive.alive.empty());
            CHECK(alive.foreign == 0);
            if (!fault.function) break;
            faultNum++;
            const bool isHarmless = std::strcmp(fault.function, "vkSetDebugUtilsObjectNameEXT") == 0;
            CHECK(sentence.empty() == isHarmless);
        }
    CHECK(faultNum > 20);
    for (const std::string& name : unhooked()) FAIL_CHECK("no hook for " << name);
    std::printf("FIGURE Faults of Vulkan in a device of our own: %zu survived and reported\n", faultNum);
}
