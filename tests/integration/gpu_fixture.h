// A headless device whose every validation message fails the test, and an engine's worth of images and frames.
#pragma once
#include "common.h"
#include <deque>
#include <mutex>
#include <rhi/rhi.h>
#include <rhi/vulkan.h>
#include <vector>

namespace test
{
class Gpu
{
public:
    explicit Gpu(bool isValidated = true);
    ~Gpu(); // reports what validation said, the device's end included

    rhi::Device& device() { return *m_device; }
    nrd::NativeDevice native() const;
    /// Waits for everything, and fails the test if validation has said anything so far.
    void finish();

private:
    void report();

    std::mutex m_mutex;
    std::vector<std::string> m_messages;
    std::unique_ptr<rhi::Device> m_device;
};

/// An image of the engine with its state as NrdIntegration sees it, and host copies of its texels.
class EngineImage
{
public:
    EngineImage(Gpu& gpu, rhi::Format format, uint32_t width, uint32_t height,
                rhi::TextureUsage usage = rhi::TextureUsage::Sampled | rhi::TextureUsage::Storage);

    /// Records a copy of `bytes` to the image, from whatever state it is in.
    void upload(rhi::CommandBuffer& commands, const void* bytes);
    /// Records a copy from the image, from whatever state it is in.
    void download(rhi::CommandBuffer& commands);
    /// After the GPU is done with download().
    template <class T> std::vector<T> texels() const
    {
        const T* data = static_cast<const T*>(m_readback->mapped());
        return std::vector<T>(data, data + m_readback->desc().size / sizeof(T));
    }
    void transition(rhi::CommandBuffer& commands, const nrd::NrdImageState& state);

    nrd::NrdUserImage entry; // its state is the truth

private:
    Gpu* m_gpu;
    std::unique_ptr<rhi::Texture> m_texture;
    std::vector<std::unique_ptr<rhi::Buffer>> m_uploads; // one each: the GPU may be reading those of frames in flight
    std::unique_ptr<rhi::Buffer> m_readback;
};

/// Command buffers and fences of the frames in flight.
class FrameRing
{
public:
    FrameRing(Gpu& gpu, uint32_t framesInFlight);
    ~FrameRing();
    /// Waits for the frame that used this slot before, and begins to record.
    rhi::CommandBuffer& begin();
    /// Ends the recording; submits unless it is held back.
    void end(bool isHeldBack = false);
    /// Submits what was held back, in order.
    void release();
    void wait();

private:
    struct Frame
    {
        std::unique_ptr<rhi::CommandBuffer> commands;
        std::unique_ptr<rhi::Fence> fence;
        bool isPending = false;
    };
    Gpu& m_gpu;
    std::vector<Frame> m_frames;
    std::deque<Frame*> m_heldBack;
    uint32_t m_index = 0;
};
} // namespace test
