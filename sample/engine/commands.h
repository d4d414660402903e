// Command buffers: one that is waited for, and a ring of them for frames in flight.
#pragma once
#include "engine/device.h"
#include "engine/unique.h"

#include <functional>
#include <vector>

namespace engine
{
/// Records with `record`, submits, and returns when the device is done. For set-up, tests and tools.
void submitAndWait(const Device& device, const std::function<void(VkCommandBuffer)>& record);

/// What a submission waits for and what it signals; null: nothing.
struct SubmitSemaphores
{
    VkSemaphore wait = VK_NULL_HANDLE;
    VkPipelineStageFlags waitStage = VK_PIPELINE_STAGE_ALL_COMMANDS_BIT;
    VkSemaphore signal = VK_NULL_HANDLE;
};

/// One command buffer per frame in flight; begin() waits for the frame that used the slot last.
class FrameRing
{
public:
    FrameRing(const Device& device, uint32_t frameCount); // frameCount in [1; 8]
    ~FrameRing();                                         // waits for all frames
    FrameRing(const FrameRing&) = delete;
    FrameRing& operator=(const FrameRing&) = delete;

    /// The command buffer of the next frame, in recording state.
    VkCommandBuffer begin();
    /// Ends the recording and submits it.
    void submit(const SubmitSemaphores& semaphores = {});
    /// Returns when every submitted frame is done.
    void waitAll() const;
    /// Slot of the frame begun last, in [0; frameCount).
    uint32_t slot() const { return m_slot; }
    uint32_t frameCount() const { return static_cast<uint32_t>(m_frames.size()); }

private:
    struct Frame
    {
        UniqueCommandPool pool;
        UniqueFence fence; // signalled while the slot is free
        VkCommandBuffer cmd = VK_NULL_HANDLE;
    };
    const Device& m_device;
    std::vector<Frame> m_frames;
    uint32_t m_slot = 0;
};
} // namespace engine
