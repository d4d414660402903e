// The transient pool's memory: lent by the application, shared with it, or from its allocator.
#include "application_allocator.h"
#include "reblur_engine.h"
#include "recording_fixture.h"
#include <rhi/recording.h>

using nrd::ResourceType;
using rhi::CallType;
using test::EngineImage;
using test::kHeight;
using test::kReblur;
using test::kWidth;
using test::RecordingFixture;
using test::require;
using test::requireRefusal;

namespace
{
enum class Owner
{
    Nobody, // not shared
    Application,
    Library,
    Allocator, // of the application, for both pools
};

constexpr nrd::NrdMemoryUse kTransfer = {VK_ACCESS_TRANSFER_WRITE_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT};

// A pass of the application that uses the transient pool's memory for an image of its own.
class Tenant
{
public:
    Tenant(rhi::Device& device, const nrd::NrdMemory& block)
    {
        rhi::TextureDesc desc;
        desc.format = rhi::Format::RGBA8_UNORM;
        desc.width = desc.height = 32;
        desc.usage = rhi::TextureUsage::TransferDst;
        desc.name = "application's scratch";
        const uint64_t alignment = device.textureMemoryRequirements(desc).alignment;
        m_memory = rhi::wrapVulkanMemory(device, block.memory,
                                         {block.offset + block.size, 1u << block.memoryTypeIndex, "tenant", "tenant"});
        m_image = device.createPlacedTexture(desc, *m_memory, (block.offset + alignment - 1) / alignment * alignment);
    }

    void use(rhi::CommandBuffer& commands, float value)
    {
        const rhi::TextureState taken = {rhi::Access::TransferWrite, rhi::Layout::Undefined, rhi::Stage::Transfer, {}};
        commands.barrier(rhi::TextureBarrier{m_image.get(), taken, rhi::states::kTransferDst, {}});
        rhi::ClearColor color;
        std::fill_n(color.f, 4, value);
        commands.clearTexture(*m_image, {}, color);
    }

private:
    std::unique_ptr<rhi::Memory> m_memory;
    std::unique_ptr<rhi::Texture> m_image;
};

// Memory of the application for the integration of this engine, at an offset that is not 0.
std::unique_ptr<rhi::Memory> allocate(test::ReblurEngine& engine, nrd::NrdMemory& block)
{
    nrd::InstanceCreationDesc instance;
    instance.denoisers = &engine.denoiser;
    instance.denoisersNum = 1;
    nrd::PoolMemoryRequirements needs;
    REQUIRE(nrd::NrdIntegration::GetMemoryRequirements(engine.desc, instance, needs) == nrd::Result::SUCCESS);
    const nrd::MemoryStatistics taken = engine.integration.GetMemoryStatistics(); // of one that has its own
    CHECK(needs.permanent.size == taken.permanent);
    CHECK(needs.transient.size == taken.transient);
    const uint64_t offset = needs.transient.alignment;
    auto memory = engine.gpu.device().createMemory(
        {offset + needs.transient.size, needs.transient.memoryTypeBits, "application's", "application's"});
    block = {rhi::vulkanMemory(*memory), offset, needs.transient.size, 0};
    while (!(memory->memoryTypeBits() >> block.memoryTypeIndex & 1)) block.memoryTypeIndex++;
    return memory;
}

std::vector<float> picture(Owner owner, const nrd::NrdMemoryUse& use, bool isSync2)
{
    test::ReblurEngine engine(nrd::LayoutPolicy::OPTIMAL, isSync2);
    nrd::NrdMemory block;
    std::unique_ptr<rhi::Memory> memory;
    std::unique_ptr<Tenant> tenant;
    test::Allocator allocator(engine.gpu.device());
    if (owner != Owner::Nobody)
    {
        if (owner == Owner::Application) memory = allocate(engine, block);
        engine.desc.transientMemory = block;
        engine.desc.isTransientMemoryShared = owner != Owner::Application; // which implies it
        if (owner == Owner::Allocator) engine.desc.deviceMemory = allocator.callbacks();
        nrd::InstanceCreationDesc instance;
        instance.denoisers = &engine.denoiser;
        instance.denoisersNum = 1;
        engine.integration.Destroy();
        require(engine.integration.Create(engine.desc, instance), engine.integration);
        const nrd::NrdMemory shared = engine.integration.GetTransientMemory();
        if (owner == Owner::Application)
            CHECK((shared.memory == block.memory && shared.offset == block.offset && shared.size == block.size));
        CHECK((engine.integration.GetMemoryStatistics().transient == 0) == (owner == Owner::Application));
        tenant = std::make_unique<Tenant>(engine.gpu.device(), shared);
    }
    CHECK((engine.integration.GetTransientMemory().memory == VK_NULL_HANDLE) == (owner == Owner::Nobody));
    std::vector<float> result;
    for (uint32_t frame = 0; frame < 4; frame++)
    {
        rhi::CommandBuffer& commands = engine.beginFrame();
        if (frame == 0) engine.images.upload(commands);
        if (tenant) tenant->use(commands, 1.0f + static_cast<float>(frame));
        nrd::DenoiseOptions options;
        options.transientBefore = options.transientAfter = use;
        engine.images.denoise(engine.integration, commands, options);
        engine.images.images[5].download(commands);
        engine.frames.end();
    }
    engine.frames.wait();
    result = engine.images.images[5].texels<float>();
    CHECK(allocator.given.size() == (owner == Owner::Allocator ? 2 : 0));
    engine.integration.Destroy();
    tenant.reset();
    CHECK(allocator.given.empty());
    engine.gpu.finish();
    return result;
}
} // namespace

TEST_CASE("transient memory that the application uses between the calls changes no picture", "[gpu]")
{
    const std::vector<float> alone = picture(Owner::Nobody, {}, true);
    CHECK(picture(Owner::Application, {}, true) == alone);
    CHECK(picture(Owner::Library, kTransfer, true) == alone);
    CHECK(picture(Owner::Application, kTransfer, false) == alone);
    CHECK(picture(Owner::Allocator, kTransfer, false) == alone);
}

TEST_CASE("integrations that share one block of scratch memory do not disturb each other", "[gpu]")
{
    test::ReblurEngine engine;
    nrd::NrdMemory block;
    const std::unique_ptr<rhi::Memory> memory = allocate(engine, block);
    engine.desc.transientMemory = block;
    nrd::InstanceCreationDesc instance;
    instance.denoisers = &engine.denoiser;
    instance.denoisersNum = 1;
    nrd::NrdIntegration sharers[2];
    for (nrd::NrdIntegration& sharer : sharers) require(sharer.Create(engine.desc, instance), sharer);
    test::ReblurImages images[2] = {test::ReblurImages(engine.gpu), test::ReblurImages(engine.gpu)};
    for (uint32_t frame = 0; frame < 3; frame++)
    {
        rhi::CommandBuffer& commands = engine.beginFrame();
        if (frame == 0) engine.images.upload(commands);
        engine.images.denoise(engine.integration, commands); // with memory of its own
        for (size_t i = 0; i < 2; i++)
        {
            if (frame == 0) images[i].upload(commands);
            require(sharers[i].NewFrame(), sharers[i]);
            require(sharers[i].SetCommonSettings(test::stillCamera(kWidth, kHeight, frame)), sharers[i]);
            images[i].denoise(sharers[i], commands);
            images[i].images[5].download(commands);
        }
        engine.images.images[5].download(commands);
        engine.frames.end();
    }
    engine.frames.wait();
    for (const test::ReblurImages& shared : images)
        CHECK(shared.images[5].texels<float>() == engine.images.images[5].texels<float>());
    for (nrd::NrdIntegration& sharer : sharers) sharer.Destroy();
    engine.gpu.finish();
}

namespace
{
nrd::NrdMemory lentBlock(const RecordingFixture& f)
{
    nrd::PoolMemoryRequirements needs;
    REQUIRE(nrd::IntegrationAccess::GetMemoryRequirements(*f.device, f.desc, f.instanceDesc, needs) ==
            nrd::Result::SUCCESS);
    return {reinterpret_cast<VkDeviceMemory>(uintptr_t(0xABC)), needs.transient.alignment, needs.transient.size, 0};
}
} // namespace

TEST_CASE("what pools will take is known before anything is there, and nothing is left of asking", "[unit]")
{
    RecordingFixture f({{3, nrd::Denoiser::REBLUR_DIFFUSE_SPECULAR}, {7, nrd::Denoiser::RELAX_DIFFUSE}});
    nrd::PoolMemoryRequirements needs;
    REQUIRE(nrd::IntegrationAccess::GetMemoryRequirements(*f.device, f.desc, f.instanceDesc, needs) ==
            nrd::Result::SUCCESS);
    CHECK(f.device->objectCount() == 0);
    f.requireCreated();
    const std::vector<rhi::RecordedCall> blocks = f.calls(CallType::CreateMemory);
    REQUIRE(blocks.size() == 2);
    CHECK(blocks[0].size == needs.permanent.size);
    CHECK(blocks[1].size == needs.transient.size);
    CHECK(needs.transient.memoryTypeBits == 1);
    CHECK(f.integration.GetTransientMemory().memory == VK_NULL_HANDLE); // it is not shared
    REQUIRE(f.denoisers.size() == 2);
    f.desc.resourceHeight = 0;
    std::string message;
    f.instanceDesc.messageSink = {
        [](void* text, nrd::Result, const char* sentence) { *static_cast<std::string*>(text) = sentence; }, &message};
    CHECK(nrd::IntegrationAccess::GetMemoryRequirements(*f.device, f.desc, f.instanceDesc, needs) ==
          nrd::Result::INVALID_ARGUMENT);
    CHECK(message == "resourceHeight is 0, must be at least 1");
    CHECK(needs.transient.size == 0);
}

TEST_CASE("a lent block that does not serve is refused with its field, at creation and in a new size", "[unit]")
{
    RecordingFixture f({{3, nrd::Denoiser::REBLUR_DIFFUSE_SPECULAR}});
    f.fillReblurSlots();
    const nrd::NrdMemory good = lentBlock(f);
    const auto refuse = [&](const nrd::NrdMemory& block, const std::string& sentence)
    {
        f.desc.transientMemory = block;
        CHECK(f.create() == nrd::Result::INVALID_ARGUMENT);
        CHECK(f.integration.GetLastMessage() == sentence);
        CHECK(f.device->objectCount() == 0);
    };
    nrd::NrdMemory block = good;
    block.size--;
    refuse(block, "transientMemory.size is " + std::to_string(block.size) + ", must be at least " +
                      std::to_string(good.size) + " at 64 x 48");
    block = good;
    block.offset++;
    refuse(block, "transientMemory.offset is " + std::to_string(block.offset) + ", must be a multiple of " +
                      std::to_string(good.offset));
    block = good;
    block.memoryTypeIndex = 1;
    refuse(block, "transientMemory.memoryTypeIndex is 1, must be a bit of 0x1");
    block.memoryTypeIndex = 99;
    refuse(block, "transientMemory.memoryTypeIndex is 99, must be a bit of 0x1");

    f.desc.transientMemory = good;
    f.requireCreated();
    CHECK(f.count(CallType::WrapMemory) == 1);
    CHECK(f.integration.GetMemoryStatistics().transient == 0);
    const uint64_t before = f.integration.GetMemoryStatistics().total;
    CHECK(f.integration.Resize(640, 480) == nrd::Result::INVALID_ARGUMENT); // the block is too small
    CHECK(f.integration.GetMemoryStatistics().total == before);
    f.desc.resourceWidth = 640;
    f.desc.resourceHeight = 480;
    require(f.integration.Resize(640, 480, lentBlock(f)), f.integration);
    require(f.integration.Resize(64, 48), f.integration); // there it fits
    CHECK(f.integration.GetMemoryStatistics().transient == 0);
    CHECK(f.count(CallType::WrapMemory) == 3);
}

TEST_CASE("barriers of all memory are recorded for shared memory only, and as the application says", "[unit]")
{
    RecordingFixture f({{3, nrd::Denoiser::REBLUR_DIFFUSE_SPECULAR}});
    f.fillReblurSlots();
    f.desc.isTransientMemoryShared = GENERATE(false, true);
    f.requireCreated();
    const auto barriers = [&](const nrd::NrdMemoryUse& before, const nrd::NrdMemoryUse& after)
    {
        nrd::DenoiseOptions options;
        options.transientBefore = before;
        options.transientAfter = after;
        f.beginFrame();
        f.device->clearCalls();
        require(f.denoise({3}, options), f.integration);
        return f.calls(CallType::MemoryBarrier);
    };
    constexpr nrd::NrdMemoryUse kNone = {0, 0};
    const size_t perSide = f.desc.isTransientMemoryShared ? 1 : 0;
    CHECK(barriers({}, {}).size() == 2 * perSide);
    const std::vector<rhi::RecordedCall> both = barriers(kTransfer, kTransfer);
    REQUIRE(both.size() == 2 * perSide);
    if (perSide)
    {
        CHECK(both[0].memory.before.native.stages ==
              (VK_PIPELINE_STAGE_TRANSFER_BIT | VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT));
        CHECK(both[1].memory.after.native.stages == VK_PIPELINE_STAGE_TRANSFER_BIT);
        CHECK(f.barriersOf("NRD T(0)")[0].before.layout == rhi::Layout::Undefined);
    }
    CHECK(barriers(kNone, kTransfer).size() == perSide);
    CHECK(f.barriersOf("NRD T(0)")[0].before.layout != rhi::Layout::Undefined); // as it left it
    CHECK(barriers(kNone, kNone).empty());
    f.integration.Destroy();
    f.requireCreated();
    CHECK(barriers(kNone, kNone).size() == perSide); // its first use of memory that may have served others before
}

TEST_CASE("recordings with shared memory are repeated as long as its uses are the same", "[unit]")
{
    RecordingFixture f({{3, nrd::Denoiser::REBLUR_DIFFUSE_SPECULAR}});
    f.desc.framesInFlight = 1;
    f.fillReblurSlots();
    f.desc.transientMemory = lentBlock(f);
    f.requireCreated();
    const nrd::Identifier identifier = 3;
    nrd::DenoiseOptions options;
    const auto isRecorded = [&]
    {
        options.recording = 1 + f.frameIndex % 2;
        bool isNeeded = false;
        f.beginFrame();
        require(f.integration.Repeat(&identifier, 1, f.pool, options, isNeeded), f.integration);
        if (isNeeded) require(f.denoise({3}, options), f.integration);
        return isNeeded;
    };
    for (int frame = 0; frame < 6; frame++) isRecorded();
    CHECK_FALSE(isRecorded());
    options.transientBefore = kTransfer;
    CHECK(isRecorded());
    CHECK(isRecorded());
    CHECK_FALSE(isRecorded());
    options.transientAfter = kTransfer;
    CHECK(isRecorded());
}
