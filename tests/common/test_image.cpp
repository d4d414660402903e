#include "test_image.h"
#include "catch.h"
#include "validated_device.h"
#include <cstring>
#include <glm/gtc/packing.hpp>

namespace test
{
namespace
{
template <class T> void store(void* texel, T value) { std::memcpy(texel, &value, sizeof(value)); }

template <class T> T load(const void* texel)
{
    T value;
    std::memcpy(&value, texel, sizeof(value));
    return value;
}

// Saturated here, so that poison that is no number stores as something.
glm::vec4 bounded(glm::vec4 v, float low)
{
    for (int i = 0; i < 4; i++) v[i] = v[i] >= low ? glm::min(v[i], 1.0f) : low;
    return v;
}
} // namespace

void encodeTexel(rhi::Format format, glm::vec4 v, void* texel)
{
    using F = rhi::Format;
    if (format == F::R8_UNORM) return store(texel, glm::packUnorm1x8(bounded(v, 0.0f).x));
    if (format == F::R16_UNORM) return store(texel, glm::packUnorm1x16(bounded(v, 0.0f).x));
    if (format == F::RGBA8_UNORM) return store(texel, glm::packUnorm4x8(bounded(v, 0.0f)));
    if (format == F::RGBA8_SNORM) return store(texel, glm::packSnorm4x8(bounded(v, -1.0f)));
    if (format == F::RGBA16_UNORM) return store(texel, glm::packUnorm4x16(bounded(v, 0.0f)));
    if (format == F::RGBA16_SNORM) return store(texel, glm::packSnorm4x16(bounded(v, -1.0f)));
    if (format == F::A2B10G10R10_UNORM_PACK32) return store(texel, glm::packUnorm3x10_1x2(bounded(v, 0.0f)));
    if (format == F::R16_SFLOAT) return store(texel, glm::packHalf1x16(v.x));
    if (format == F::RG16_SFLOAT) return store(texel, glm::packHalf2x16(glm::vec2(v)));
    if (format == F::RGBA16_SFLOAT) return store(texel, glm::packHalf4x16(v));
    if (format == F::R32_SFLOAT) return store(texel, v.x);
    if (format == F::RGBA32_SFLOAT) return store(texel, v);
    FAIL("no codec for " << rhi::formatInfo(format).name);
}

glm::vec4 decodeTexel(rhi::Format format, const void* texel)
{
    using F = rhi::Format;
    if (format == F::R8_UNORM) return {glm::unpackUnorm1x8(load<uint8_t>(texel)), 0.0f, 0.0f, 0.0f};
    if (format == F::R16_UNORM) return {glm::unpackUnorm1x16(load<uint16_t>(texel)), 0.0f, 0.0f, 0.0f};
    if (format == F::RGBA8_UNORM) return glm::unpackUnorm4x8(load<uint32_t>(texel));
    if (format == F::RGBA8_SNORM) return glm::unpackSnorm4x8(load<uint32_t>(texel));
    if (format == F::RGBA16_UNORM) return glm::unpackUnorm4x16(load<uint64_t>(texel));
    if (format == F::RGBA16_SNORM) return glm::unpackSnorm4x16(load<uint64_t>(texel));
    if (format == F::A2B10G10R10_UNORM_PACK32) return glm::unpackUnorm3x10_1x2(load<uint32_t>(texel));
    if (format == F::R16_SFLOAT) return {glm::unpackHalf1x16(load<uint16_t>(texel)), 0.0f, 0.0f, 0.0f};
    if (format == F::RG16_SFLOAT) return {glm::unpackHalf2x16(load<uint32_t>(texel)), 0.0f, 0.0f};
    if (format == F::RGBA16_SFLOAT) return glm::unpackHalf4x16(load<uint64_t>(texel));
    if (format == F::R32_SFLOAT) return {load<float>(texel), 0.0f, 0.0f, 0.0f};
    if (format == F::RGBA32_SFLOAT) return load<glm::vec4>(texel);
    FAIL("no codec for " << rhi::formatInfo(format).name);
    return {};
}

Image::Image(rhi::Format format, int width, int height) : m_width(width), m_height(height)
{
    rhi::TextureDesc desc;
    desc.format = format;
    desc.width = static_cast<uint32_t>(width);
    desc.height = static_cast<uint32_t>(height);
    desc.usage = rhi::TextureUsage::Sampled | rhi::TextureUsage::Storage | rhi::TextureUsage::TransferSrc |
                 rhi::TextureUsage::TransferDst;
    m_texture = validatedDevice().createTexture(desc);
    m_upload = makeBuffer(rhi::BufferMemory::Upload);
    m_readback = makeBuffer(rhi::BufferMemory::Readback);
    fill(glm::vec4(0.0f));
}

std::unique_ptr<rhi::Buffer> Image::makeBuffer(rhi::BufferMemory memory) const
{
    rhi::BufferDesc desc;
    desc.size = m_texture->mipByteSize(0);
    desc.usage = rhi::BufferUsage::TransferSrc | rhi::BufferUsage::TransferDst;
    desc.memory = memory;
    return validatedDevice().createBuffer(desc);
}

void Image::fill(const Plane& texels)
{
    REQUIRE(texels.size() == texelCount());
    auto* out = static_cast<uint8_t*>(m_upload->mapped());
    for (size_t i = 0; i < texels.size(); i++) encodeTexel(format(), texels[i], out + i * texelSize());
}

void Image::fill(glm::vec4 value) { fill(Plane(texelCount(), value)); }

Plane Image::read() const
{
    Plane texels(texelCount());
    const auto* in = static_cast<const uint8_t*>(m_readback->mapped());
    for (size_t i = 0; i < texels.size(); i++) texels[i] = decodeTexel(format(), in + i * texelSize());
    return texels;
}

void Image::transition(rhi::CommandBuffer& commands, const rhi::TextureState& after)
{
    commands.barrier(rhi::TextureBarrier{m_texture.get(), m_state, after});
    m_state = after;
}

void Image::upload(rhi::CommandBuffer& commands)
{
    transition(commands, rhi::states::kTransferDst);
    commands.copyBufferToTexture({m_texture.get(), 0, m_upload.get(), 0});
}

void Image::download(rhi::CommandBuffer& commands)
{
    transition(commands, rhi::states::kTransferSrc);
    commands.copyTextureToBuffer({m_texture.get(), 0, m_readback.get(), 0});
    commands.barrier(rhi::BufferBarrier{m_readback.get(),
                                        {rhi::Access::TransferWrite, rhi::Stage::Transfer},
                                        {rhi::Access::HostRead, rhi::Stage::Host}});
}
} // namespace test
