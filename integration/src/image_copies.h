// Copies of an application's images as floats on the host, of one frame; the same memory serves frame after frame.
#pragma once
#include "retire_queue.h"
#include "view_cache.h"
#include <rhi/device.h>
#include <vector>

namespace nrd
{
struct CopiedImage
{
    const char* name = "";
    NrdUserImage* image = nullptr;
};

/// What recording reads and takes from; all borrowed for one call.
struct CopyContext
{
    ViewCache& views;
    RetireQueue& retired;
    LayoutPolicy layoutPolicy;
    uint64_t frame;
};

/// The pipeline of all copies. `name` as in IntegrationCreationDesc. Throws rhi::Error.
std::unique_ptr<rhi::Pipeline> createCopyPipeline(rhi::Device& device, const char* name);

class ImageCopies
{
public:
    /// Throws rhi::Error.
    ImageCopies(rhi::Device& device, const rhi::Pipeline& pipeline, const char* name);

    /// The GPU is done with what was recorded. Throws rhi::Error.
    void reset();
    /// Adds images to the frame; what an earlier plan had and nobody recorded is dropped. Throws rhi::Error.
    void plan(const CopyContext& context, rhi::Span<const CopiedImage> images);
    /// Records what was planned last. The images are then in copiedState().
    void record(rhi::CommandBuffer& commands);

    uint32_t size() const { return static_cast<uint32_t>(m_recorded); }
    /// Four floats per texel, row by row; after the GPU is done.
    const float* texels(size_t index) const { return static_cast<const float*>(m_copies[index].buffer->mapped()); }

private:
    struct Copy
    {
        const rhi::Buffer* buffer;
        const rhi::DescriptorSet* set;
        uint32_t width, height;
    };
    const rhi::Buffer& bufferAt(size_t index, uint64_t size);
    void planImage(const CopyContext& context, rhi::Span<const CopiedImage> images, size_t index);

    rhi::Device& m_device;
    const rhi::Pipeline& m_pipeline;
    std::string m_name;
    std::vector<std::unique_ptr<rhi::Buffer>> m_buffers; // by the copy's place in the list
    std::unique_ptr<rhi::DescriptorPool> m_descriptors;
    std::vector<Copy> m_copies;
    size_t m_recorded = 0;
    std::vector<rhi::TextureBarrier> m_textureBarriers; // of the plan
    std::vector<rhi::BufferBarrier> m_bufferBarriers;
};

/// How a copy leaves an image that came in this state.
NrdImageState copiedState(const NrdImageState& before, LayoutPolicy layoutPolicy);
} // namespace nrd
