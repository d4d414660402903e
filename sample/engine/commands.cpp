#include "engine/commands.h"

namespace engine
{
namespace
{
UniqueCommandPool createPool(const Device& device)
{
    auto info = describe<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
    info.queueFamilyIndex = device.queueFamily();
    VkCommandPool pool = VK_NULL_HANDLE;
    check(vkCreateCommandPool(device.handle(), &info, nullptr, &pool), "create a command pool");
    return {device.handle(), pool};
}

VkCommandBuffer createCommandBuffer(const Device& device, VkCommandPool pool)
{
    auto info = describe<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
    info.commandPool = pool;
    info.commandBufferCount = 1;
    VkCommandBuffer cmd = VK_NULL_HANDLE;
    check(vkAllocateCommandBuffers(device.handle(), &info, &cmd), "allocate a command buffer");
    return cmd;
}

UniqueFence createFence(const Device& device, VkFenceCreateFlags flags)
{
    const VkFenceCreateInfo info = {VK_STRUCTURE_TYPE_FENCE_CREATE_INFO, nullptr, flags};
    VkFence fence = VK_NULL_HANDLE;
    check(vkCreateFence(device.handle(), &info, nullptr, &fence), "create a fence");
    return {device.handle(), fence};
}

void beginRecording(VkCommandBuffer cmd)
{
    auto info = describe<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
    info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(vkBeginCommandBuffer(cmd, &info), "begin a command buffer");
}

void endAndSubmit(const Device& device, VkCommandBuffer cmd, VkFence fence, const SubmitSemaphores& semaphores = {})
{
    check(vkEndCommandBuffer(cmd), "end a command buffer");
    auto info = describe<VkSubmitInfo>(VK_STRUCTURE_TYPE_SUBMIT_INFO);
    info.commandBufferCount = 1;
    info.pCommandBuffers = &cmd;
    info.waitSemaphoreCount = semaphores.wait ? 1 : 0;
    info.pWaitSemaphores = &semaphores.wait;
    info.pWaitDstStageMask = &semaphores.waitStage;
    info.signalSemaphoreCount = semaphores.signal ? 1 : 0;
    info.pSignalSemaphores = &semaphores.signal;
    check(vkQueueSubmit(device.queue(), 1, &info, fence), "submit a command buffer");
}

void wait(const Device& device, VkFence fence)
{
    check(vkWaitForFences(device.handle(), 1, &fence, VK_TRUE, UINT64_MAX), "wait for the device");
}
} // namespace

void submitAndWait(const Device& device, const std::function<void(VkCommandBuffer)>& record)
{
    const UniqueCommandPool pool = createPool(device);
    const UniqueFence fence = createFence(device, 0);
    VkCommandBuffer cmd = createCommandBuffer(device, pool.get());
    beginRecording(cmd);
    record(cmd);
    endAndSubmit(device, cmd, fence.get());
    wait(device, fence.get());
}

FrameRing::FrameRing(const Device& device, uint32_t frameCount) : m_device(device), m_slot(frameCount - 1)
{
    if (frameCount < 1 || frameCount > 8) throw Error("the number of frames in flight must be in [1; 8]");
    for (uint32_t i = 0; i < frameCount; ++i)
    {
        Frame& frame = m_frames.emplace_back();
        frame.pool = createPool(device);
        frame.fence = createFence(device, VK_FENCE_CREATE_SIGNALED_BIT);
        frame.cmd = createCommandBuffer(device, frame.pool.get());
    }
}

FrameRing::~FrameRing() { vkDeviceWaitIdle(m_device.handle()); } // fences of frames never submitted would not signal

VkCommandBuffer FrameRing::begin()
{
    m_slot = (m_slot + 1) % frameCount();
    Frame& frame = m_frames[m_slot];
    wait(m_device, frame.fence.get());
    check(vkResetCommandPool(m_device.handle(), frame.pool.get(), 0), "reset a command pool");
    beginRecording(frame.cmd);
    return frame.cmd;
}

void FrameRing::submit(const SubmitSemaphores& semaphores)
{
    Frame& frame = m_frames[m_slot];
    VkFence fence = frame.fence.get();
    check(vkResetFences(m_device.handle(), 1, &fence), "reset a fence");
    endAndSubmit(m_device, frame.cmd, fence, semaphores);
}

void FrameRing::waitAll() const
{
    for (const Frame& frame : m_frames) wait(m_device, frame.fence.get());
}
} // namespace engine
