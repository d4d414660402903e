// An image of the application with buffers to fill and read it; texels are given and returned as vectors, whatever the
// format stores.
#pragma once
#include <glm/glm.hpp>
#include <memory>
#include <rhi/rhi.h>
#include <vector>

namespace test
{
using Plane = std::vector<glm::vec4>; // row by row

// One texel as the format stores it; missing channels are dropped, and read as 0. Floats, and normalised integers.
void encodeTexel(rhi::Format format, glm::vec4 value, void* texel);
glm::vec4 decodeTexel(rhi::Format format, const void* texel);

class Image
{
public:
    Image(rhi::Format format, int width, int height);

    void fill(const Plane& texels); // what upload() copies
    void fill(glm::vec4 value);
    Plane read() const; // what download() copied

    void upload(rhi::CommandBuffer& commands);
    void download(rhi::CommandBuffer& commands);
    void transition(rhi::CommandBuffer& commands, const rhi::TextureState& after);

    rhi::Texture& texture() { return *m_texture; }
    rhi::Format format() const { return m_texture->desc().format; }
    int width() const { return m_width; }
    int height() const { return m_height; }

private:
    std::unique_ptr<rhi::Buffer> makeBuffer(rhi::BufferMemory memory) const;
    size_t texelSize() const { return rhi::formatInfo(format()).texelSize; }
    size_t texelCount() const { return static_cast<size_t>(m_width) * static_cast<size_t>(m_height); }

    int m_width, m_height;
    std::unique_ptr<rhi::Texture> m_texture;
    std::unique_ptr<rhi::Buffer> m_upload, m_readback;
    rhi::TextureState m_state = rhi::states::kUndefined;
};
} // namespace test
