// Native objects go in and come back out. Works on Vulkan, whichever decorator is on top.
#include "catch.h"
#include "fixture.h"
#include "gpu.h"
#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <rhi/validation.h>
#include <rhi/vulkan.h>

using namespace rhi;
using namespace rhi::test;

namespace
{
constexpr BindingDesc kOneTexture[] = {{0, 0, BindingType::StorageTexture}};
constexpr uint32_t kSize = 16;

template <class F> F load(const VulkanHandles& handles, const char* name)
{
    return reinterpret_cast<F>(handles.getDeviceProcAddr(handles.device, name));
}

VulkanNativeDevice nativeOf(const Device& device)
{
    const VulkanHandles handles = vulkanHandles(device);
    VulkanNativeDevice native;
    native.instance = handles.instance;
    native.physicalDevice = handles.physicalDevice;
    native.device = handles.device;
    native.queueFamilyIndex = handles.queueFamilyIndex;
    native.queue = handles.queue;
    native.getInstanceProcAddr = handles.getInstanceProcAddr;
    native.isSynchronization2Enabled = device.info().hasSynchronization2;
    native.isDebugUtilsEnabled = device.info().hasDebugLabels;
    return native;
}

/// A command buffer as an engine would own it.
class EngineCommands
{
public:
    explicit EngineCommands(const VulkanHandles& handles) : m_handles(handles)
    {
        VkCommandPoolCreateInfo poolInfo = {};
        poolInfo.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
        poolInfo.queueFamilyIndex = handles.queueFamilyIndex;
        REQUIRE(load<PFN_vkCreateCommandPool>(handles, "vkCreateCommandPool")(handles.device, &poolInfo, nullptr,
                                                                              &m_pool) == VK_SUCCESS);
        VkCommandBufferAllocateInfo info = {};
        info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
        info.commandPool = m_pool;
        info.commandBufferCount = 1;
        REQUIRE(load<PFN_vkAllocateCommandBuffers>(handles, "vkAllocateCommandBuffers")(handles.device, &info,
                                                                                        &m_commands) == VK_SUCCESS);
        VkCommandBufferBeginInfo beginInfo = {};
        beginInfo.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
        REQUIRE(load<PFN_vkBeginCommandBuffer>(handles, "vkBeginCommandBuffer")(m_commands, &beginInfo) == VK_SUCCESS);
    }
    EngineCommands(const EngineCommands&) = delete;
    EngineCommands& operator=(const EngineCommands&) = delete;
    ~EngineCommands()
    {
        load<PFN_vkDestroyCommandPool>(m_handles, "vkDestroyCommandPool")(m_handles.device, m_pool, nullptr);
    }
    VkCommandBuffer get() const { return m_commands; }
    void submitAndWait() const
    {
        REQUIRE(load<PFN_vkEndCommandBuffer>(m_handles, "vkEndCommandBuffer")(m_commands) == VK_SUCCESS);
        VkSubmitInfo info = {};
        info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
        info.commandBufferCount = 1;
        info.pCommandBuffers = &m_commands;
        REQUIRE(load<PFN_vkQueueSubmit>(m_handles, "vkQueueSubmit")(m_handles.queue, 1, &info, VK_NULL_HANDLE) ==
                VK_SUCCESS);
        REQUIRE(load<PFN_vkQueueWaitIdle>(m_handles, "vkQueueWaitIdle")(m_handles.queue) == VK_SUCCESS);
    }

private:
    VulkanHandles m_handles;
    VkCommandPool m_pool = VK_NULL_HANDLE;
    VkCommandBuffer m_commands = VK_NULL_HANDLE;
};

TextureDesc engineDesc(const char* name)
{
    TextureDesc desc;
    desc.format = Format::R32_UINT;
    desc.width = desc.height = kSize;
    desc.usage = TextureUsage::Storage | TextureUsage::TransferSrc;
    desc.name = name;
    return desc;
}

void fillThroughWrapped(TestDevice& engine, Device& wrapped)
{
    // The image is made by one device and used by another one over the same VkDevice, as an engine's would be.
    const auto image = engine->createTexture(engineDesc("engine's image"));
    const auto texture = wrapVulkanTexture(wrapped, vulkanImage(*image), engineDesc("output"));
    CHECK(vulkanImage(*texture) == vulkanImage(*image));
    const auto readback =
        makeBuffer(*engine, kSize * kSize * 4, BufferUsage::TransferDst, BufferMemory::Readback, "engine's buffer");
    const auto buffer = wrapVulkanBuffer(wrapped, vulkanBuffer(*readback), readback->desc());
    CHECK(vulkanBuffer(*buffer) == vulkanBuffer(*readback));
    CHECK(buffer->mapped() == nullptr);
    const auto view = wrapped.createView(*texture, {ViewType::Storage, {}});
    CHECK(vulkanImageView(*view) != VK_NULL_HANDLE);
    Pass pass(wrapped, Shader::Write, kOneTexture, {{0, 4711}});
    CHECK(vulkanPipeline(pass.pipeline()) != VK_NULL_HANDLE);
    pass.write(0, {viewAt(0, *view)});

    EngineCommands native(vulkanHandles(*engine));
    {
        const auto commands = wrapVulkanCommandBuffer(wrapped, native.get());
        CHECK(vulkanCommandBuffer(*commands) == native.get());
        CHECK_THROWS_AS(wrapVulkanCommandBuffer(wrapped, VK_NULL_HANDLE), Error);
        // The engine's last use of the image was as a colour attachment, say, in a layout the RHI has no name for.
        TextureState before = fromVulkan(VK_IMAGE_LAYOUT_UNDEFINED, 0, VK_PIPELINE_STAGE_2_TOP_OF_PIPE_BIT);
        CHECK(before.layout == Layout::Native);
        commands->beginLabel("wrapped");
        commands->barrier(TextureBarrier{texture.get(), before, states::kStorageWrite, {}});
        pass.record(*commands, kSize / 8, kSize / 8);
        commands->barrier(TextureBarrier{texture.get(), states::kStorageWrite, states::kTransferSrc, {}});
        commands->copyTextureToBuffer({texture.get(), 0, buffer.get(), 0});
        commands->endLabel();
    }
    native.submitAndWait();
    const Span<uint32_t> words = mappedAs<uint32_t>(*readback);
    CHECK(std::count(words.begin(), words.end(), 4711u) == kSize * kSize);
}
} // namespace

TEST_CASE("a wrapped device records into wrapped command buffers, images and buffers", "[gpu]")
{
    forEachDevice(
        [](TestDevice& device)
        {
            const VulkanNativeDevice native = nativeOf(*device);
            REQUIRE(native.device != VK_NULL_HANDLE);
            {
                const auto wrapped = wrapVulkanDevice(native);
                CHECK(vulkanHandles(*wrapped).device == native.device);
                CHECK(wrapped->info().name == device->info().name);
                fillThroughWrapped(device, *wrapped);
            }
            std::vector<std::string> misuses;
            {
                const auto checked = makeValidatingDevice(wrapVulkanDevice(native),
                                                          [&](const std::string& text) { misuses.push_back(text); });
                fillThroughWrapped(device, *checked);
            }
            for (std::string& text : misuses) // the null handle that was wrapped on purpose
                if (text.find("is null") != std::string::npos) text.clear();
            std::erase(misuses, "");
            CHECK(misuses == std::vector<std::string>{});
        });
}

TEST_CASE("a wrapped device passes the engine's allocation callbacks and pipeline cache on", "[gpu]")
{
    struct Counter
    {
        static VKAPI_ATTR void* VKAPI_CALL allocate(void* user, size_t size, size_t alignment, VkSystemAllocationScope)
        {
            ++*static_cast<int*>(user);
            alignment = std::max(alignment, sizeof(void*));
            return std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
        }
        static VKAPI_ATTR void* VKAPI_CALL reallocate(void*, void*, size_t, size_t, VkSystemAllocationScope)
        {
            return nullptr; // out of memory is a legal answer, and nothing here grows
        }
        static VKAPI_ATTR void VKAPI_CALL release(void*, void* memory) { std::free(memory); }
    };
    const auto& factory = deviceFactories().front();
    forEach({factory},
            [](TestDevice& device)
            {
                int allocationCount = 0;
                const VkAllocationCallbacks callbacks = {&allocationCount, Counter::allocate, Counter::reallocate,
                                                         Counter::release, nullptr,           nullptr};
                const VulkanHandles handles = vulkanHandles(*device);
                VkPipelineCacheCreateInfo info = {};
                info.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO;
                VulkanNativeDevice native = nativeOf(*device);
                native.allocationCallbacks = &callbacks;
                REQUIRE(load<PFN_vkCreatePipelineCache>(handles, "vkCreatePipelineCache")(
                            handles.device, &info, nullptr, &native.pipelineCache) == VK_SUCCESS);
                {
                    const auto wrapped = wrapVulkanDevice(native);
                    const auto texture = wrapped->createTexture(engineDesc("counted"));
                    const auto view = wrapped->createView(*texture, {ViewType::Storage, {}});
                    Pass pass(*wrapped, Shader::Write, kOneTexture);
                    pass.write(0, {viewAt(0, *view)});
                }
                CHECK(allocationCount >= 4);
                load<PFN_vkDestroyPipelineCache>(handles, "vkDestroyPipelineCache")(handles.device,
                                                                                    native.pipelineCache, nullptr);
            });
}

TEST_CASE("a device that cannot be wrapped is refused with the reason", "[gpu]")
{
    forEach({deviceFactories().front()},
            [](TestDevice& device)
            {
                const VulkanNativeDevice good = nativeOf(*device);
                const auto refuse = [](const VulkanNativeDevice& native, const char* part)
                { CHECK_THROWS_WITH(wrapVulkanDevice(native), containing(part)); };
                refuse({}, "getInstanceProcAddr is null");
                VulkanNativeDevice bad = good;
                bad.device = VK_NULL_HANDLE;
                refuse(bad, "device is null");
                bad = good;
                bad.queueFamilyIndex = 99;
                refuse(bad, "queueFamilyIndex is 99");
                bad = good;
                VkPhysicalDeviceFeatures features = requiredVulkanFeatures().features;
                features.shaderStorageImageWriteWithoutFormat = VK_FALSE;
                bad.enabledFeatures = &features;
                refuse(bad, "shaderStorageImageWriteWithoutFormat");
                bad = good;
                bad.queue = VK_NULL_HANDLE;
                const auto withoutQueue = wrapVulkanDevice(bad);
                CHECK_THROWS_WITH(withoutQueue->submit({}, nullptr), containing("no queue"));
            });
}

TEST_CASE("every adapter has a name, and one that does not exist is refused with the list of those that do", "[gpu]")
{
    forEach({deviceFactories().front()},
            [](TestDevice& device)
            {
                const std::vector<VulkanAdapter> adapters = listVulkanAdapters();
                REQUIRE(!adapters.empty());
                const auto isIt = [&](const VulkanAdapter& a) { return a.name == device->info().name; };
                CHECK(std::any_of(adapters.begin(), adapters.end(), isIt));
                for (const VulkanAdapter& adapter : adapters) CHECK(!adapter.name.empty());
                VulkanDeviceDesc desc;
                desc.adapter = "no such adapter";
                CHECK_THROWS_WITH(makeVulkanDevice(desc), containing(adapters.front().name));
                desc.adapter = "4096";
                CHECK_THROWS_AS(makeVulkanDevice(desc), Error);
            });
}
