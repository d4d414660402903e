#include "gpu_fixture.h"
#include "convert.h"
#include <cstdlib>
#include <cstring>

namespace test
{
Gpu::Gpu(bool isValidated)
{
    rhi::VulkanDeviceDesc desc;
    if (const char* name = std::getenv("NRD_TEST_DEVICE")) desc.adapter = name;
    desc.isValidationEnabled = isValidated && std::getenv("NRD_TEST_NO_VALIDATION") == nullptr;
    desc.isSyncValidationEnabled = desc.isValidationEnabled;
    desc.messageCallback = [this](rhi::MessageSeverity severity, const std::string& text)
    {
        if (severity == rhi::MessageSeverity::Info) return;
        const std::lock_guard lock(m_mutex);
        m_messages.push_back(text);
    };
    m_device = rhi::makeVulkanDevice(desc);
}

Gpu::~Gpu()
{
    m_device.reset();
    report();
}

void Gpu::report()
{
    const std::lock_guard lock(m_mutex);
    for (const std::string& text : m_messages) FAIL_CHECK(text);
    m_messages.clear();
}

void Gpu::finish()
{
    m_device->waitIdle();
    report();
}

nrd::NativeDevice Gpu::native() const
{
    const rhi::VulkanHandles handles = rhi::vulkanHandles(*m_device);
    nrd::NativeDevice result;
    result.instance = handles.instance;
    result.physicalDevice = handles.physicalDevice;
    result.device = handles.device;
    result.queueFamilyIndex = handles.queueFamilyIndex;
    result.getInstanceProcAddr = handles.getInstanceProcAddr;
    result.getDeviceProcAddr = handles.getDeviceProcAddr;
    result.isSynchronization2Enabled = m_device->info().hasSynchronization2;
    result.isDebugUtilsEnabled = m_device->info().hasDebugLabels;
    return result;
}

EngineImage::EngineImage(Gpu& gpu, rhi::Format format, uint32_t width, uint32_t height, rhi::TextureUsage usage)
    : m_gpu(&gpu)
{
    rhi::TextureDesc desc;
    desc.format = format;
    desc.width = width;
    desc.height = height;
    desc.usage = usage | rhi::TextureUsage::TransferSrc | rhi::TextureUsage::TransferDst;
    m_texture = gpu.device().createTexture(desc);
    rhi::BufferDesc buffer;
    buffer.size = m_texture->mipByteSize(0);
    buffer.usage = rhi::BufferUsage::TransferDst;
    buffer.memory = rhi::BufferMemory::Readback;
    m_readback = gpu.device().createBuffer(buffer);

    static uint64_t generation = 0;
    entry.image = rhi::vulkanImage(*m_texture);
    entry.format = rhi::toVulkan(format);
    entry.width = width;
    entry.height = height;
    entry.usage = VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    if (rhi::hasAll(usage, rhi::TextureUsage::Sampled)) entry.usage |= VK_IMAGE_USAGE_SAMPLED_BIT;
    if (rhi::hasAll(usage, rhi::TextureUsage::Storage)) entry.usage |= VK_IMAGE_USAGE_STORAGE_BIT;
    entry.generation = ++generation;
}

void EngineImage::transition(rhi::CommandBuffer& commands, const nrd::NrdImageState& state)
{
    commands.barrier(rhi::TextureBarrier{m_texture.get(), nrd::toRhi(entry.state), nrd::toRhi(state)});
    entry.state = state;
}

void EngineImage::upload(rhi::CommandBuffer& commands, const void* bytes)
{
    rhi::BufferDesc desc;
    desc.size = m_texture->mipByteSize(0);
    desc.usage = rhi::BufferUsage::TransferSrc;
    desc.memory = rhi::BufferMemory::Upload;
    m_uploads.push_back(m_gpu->device().createBuffer(desc));
    rhi::Buffer* const upload = m_uploads.back().get();
    std::memcpy(upload->mapped(), bytes, desc.size);
    transition(commands,
               {VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_ACCESS_TRANSFER_WRITE_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT});
    commands.copyBufferToTexture({m_texture.get(), 0, upload, 0});
}

void EngineImage::download(rhi::CommandBuffer& commands)
{
    transition(commands,
               {VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_ACCESS_TRANSFER_READ_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT});
    commands.barrier(rhi::BufferBarrier{m_readback.get(),
                                        {rhi::Access::HostRead, rhi::Stage::Host},
                                        {rhi::Access::TransferWrite, rhi::Stage::Transfer}});
    commands.copyTextureToBuffer({m_texture.get(), 0, m_readback.get(), 0});
    commands.barrier(rhi::BufferBarrier{m_readback.get(),
                                        {rhi::Access::TransferWrite, rhi::Stage::Transfer},
                                        {rhi::Access::HostRead, rhi::Stage::Host}});
}

FrameRing::FrameRing(Gpu& gpu, uint32_t framesInFlight) : m_gpu(gpu), m_frames(framesInFlight)
{
    for (Frame& frame : m_frames)
    {
        frame.commands = gpu.device().createCommandBuffer("frame");
        frame.fence = gpu.device().createFence("frame");
    }
}

FrameRing::~FrameRing() { wait(); }

rhi::CommandBuffer& FrameRing::begin()
{
    Frame& frame = m_frames[m_index];
    if (frame.isPending)
    {
        frame.fence->wait();
        frame.fence->reset();
        frame.isPending = false;
    }
    frame.commands->begin();
    return *frame.commands;
}

void FrameRing::end(bool isHeldBack)
{
    Frame& frame = m_frames[m_index];
    frame.commands->end();
    m_heldBack.push_back(&frame);
    m_index = (m_index + 1) % static_cast<uint32_t>(m_frames.size());
    if (!isHeldBack) release();
}

void FrameRing::release()
{
    for (Frame* frame : m_heldBack)
    {
        rhi::CommandBuffer* const commands = frame->commands.get();
        m_gpu.device().submit({&commands, 1}, frame->fence.get());
        frame->isPending = true;
    }
    m_heldBack.clear();
}

void FrameRing::wait()
{
    for (Frame& frame : m_frames)
        if (frame.isPending) frame.fence->wait();
}
} // namespace test
