#include "catch.h"
#include "fixture.h"
#include "gpu.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

using namespace rhi;
using namespace rhi::test;

namespace
{
constexpr int kSize = 4;
using Image = std::array<float, kSize * kSize>;

struct Uv
{
    float u;
    float v;
};

int wrap(int i, bool isMirror)
{
    if (!isMirror) return std::clamp(i, 0, kSize - 1);
    const int period = 2 * kSize;
    const int m = ((i % period) + period) % period;
    return m < kSize ? m : period - 1 - m;
}

float texel(const Image& image, int x, int y, bool isMirror)
{
    return image.at(static_cast<size_t>(wrap(y, isMirror) * kSize + wrap(x, isMirror)));
}

/// Vulkan specification, "Texel Filtering".
float sampleImage(const Image& image, Uv uv, bool isLinear, bool isMirror)
{
    const float x = uv.u * kSize;
    const float y = uv.v * kSize;
    if (!isLinear) return texel(image, static_cast<int>(std::floor(x)), static_cast<int>(std::floor(y)), isMirror);
    const float fx = std::floor(x - 0.5f);
    const float fy = std::floor(y - 0.5f);
    const float a = x - 0.5f - fx;
    const float b = y - 0.5f - fy;
    const int i = static_cast<int>(fx);
    const int j = static_cast<int>(fy);
    const float top = std::lerp(texel(image, i, j, isMirror), texel(image, i + 1, j, isMirror), a);
    const float bottom = std::lerp(texel(image, i, j + 1, isMirror), texel(image, i + 1, j + 1, isMirror), a);
    return std::lerp(top, bottom, b);
}

/// From -1.6 to 2.6 in both directions, never on a border between texels.
std::vector<Uv> coordinates()
{
    std::vector<Uv> result;
    for (int y = 0; y < 43; y++)
        for (int x = 0; x < 43; x++)
            result.push_back({-1.613f + 0.0987f * static_cast<float>(x), -1.587f + 0.0991f * static_cast<float>(y)});
    return result;
}

void requireEqual(TestDevice& device, const Image& image, const std::vector<Uv>& uvs, Span<const float> seen)
{
    // 8 bits of the fraction are usual in hardware: an error of 1/128 per direction is allowed.
    const float linearTolerance = 2.0f / 128.0f;
    for (size_t kind = 0; kind < 4; kind++)
    {
        const bool isLinear = kind % 2 == 1;
        const bool isMirror = kind >= 2;
        float worst = 0.0f;
        for (size_t i = 0; i < uvs.size(); i++)
            worst = std::max(worst, std::abs(seen[i * 4 + kind] - sampleImage(image, uvs[i], isLinear, isMirror)));
        INFO(device->info().name << ", sampler " << kind);
        CHECK(worst <= (isLinear ? linearTolerance : 0.0f));
    }
}
} // namespace

TEST_CASE("the four samplers give the values computed on the CPU", "[gpu]")
{
    Image image = {};
    for (size_t i = 0; i < image.size(); i++) image[i] = static_cast<float>((i * 7) % 16) / 16.0f; // exact in half
    const std::vector<Uv> uvs = coordinates();
    forEachDevice(
        [&](TestDevice& device)
        {
            TextureDesc desc;
            desc.format = Format::R16_SFLOAT;
            desc.width = desc.height = kSize;
            desc.usage = TextureUsage::Sampled | TextureUsage::TransferDst;
            desc.name = "sampled";
            const auto texture = device->createTexture(desc);
            Bytes bytes(image.size() * 2);
            for (size_t i = 0; i < image.size(); i++)
            {
                // Half of a multiple of 1/16 below 1: the bits follow from the exponent.
                int exponent = 0;
                const float mantissa = std::frexp(image[i], &exponent);
                const auto half = static_cast<uint16_t>(
                    image[i] == 0.0f ? 0 : ((exponent + 14) << 10) | static_cast<int>((mantissa * 2 - 1) * 1024));
                std::memcpy(bytes.data() + i * 2, &half, 2);
            }
            upload(*device, *texture, 0, bytes, states::kSampled);
            const auto view = device->createView(*texture, {ViewType::Sampled, {}});
            const auto in =
                makeBuffer(*device, uvs.size() * 8, BufferUsage::Storage, BufferMemory::Upload, "coordinates");
            std::memcpy(in->mapped(), uvs.data(), uvs.size() * 8);
            const auto out =
                makeBuffer(*device, uvs.size() * 16, BufferUsage::Storage, BufferMemory::Readback, "samples");
            const BindingDesc bindings[] = {{0, 0, BindingType::Sampler, SamplerKind::NearestClamp},
                                            {0, 1, BindingType::Sampler, SamplerKind::LinearClamp},
                                            {0, 2, BindingType::Sampler, SamplerKind::NearestMirroredRepeat},
                                            {0, 3, BindingType::Sampler, SamplerKind::LinearMirroredRepeat},
                                            {1, 0, BindingType::SampledTexture},
                                            {1, 1, BindingType::StorageBuffer},
                                            {1, 2, BindingType::StorageBuffer}};
            Pass pass(*device, Shader::Sample, bindings);
            pass.write(1, {viewAt(0, *view), bufferAt(1, *in), bufferAt(2, *out)});
            run(*device,
                [&](CommandBuffer& commands)
                {
                    pass.record(commands, static_cast<uint32_t>(uvs.size() + 63) / 64);
                    commands.barrier(BufferBarrier{
                        out.get(), {Access::StorageWrite, Stage::Compute}, {Access::HostRead, Stage::Host}});
                });
            requireEqual(device, image, uvs, mappedAs<const float>(*out));
        });
}

TEST_CASE("mips 1-4 are sampled while mip 0 of the same texture is written", "[gpu]")
{
    forEachDevice(
        [](TestDevice& device)
        {
            TextureDesc desc;
            desc.format = Format::R32_UINT;
            desc.width = 64;
            desc.height = 32;
            desc.mipCount = 5;
            desc.usage =
                TextureUsage::Sampled | TextureUsage::Storage | TextureUsage::TransferSrc | TextureUsage::TransferDst;
            desc.name = "pyramid";
            const auto texture = device->createTexture(desc);
            std::array<std::vector<uint32_t>, 5> mips;
            for (uint32_t mip = 1; mip < 5; mip++)
            {
                mips[mip].resize(texture->mipWidth(mip) * texture->mipHeight(mip));
                for (uint32_t i = 0; i < mips[mip].size(); i++) mips[mip][i] = (i * 5 + mip) % 16;
                Bytes bytes(mips[mip].size() * 4);
                std::memcpy(bytes.data(), mips[mip].data(), bytes.size());
                upload(*device, *texture, mip, bytes, states::kSampled);
            }
            const auto coarse = device->createView(*texture, {ViewType::Sampled, {1, 4}});
            const auto fine = device->createView(*texture, {ViewType::Storage, {0, 1}});
            const BindingDesc bindings[] = {{0, 0, BindingType::SampledTexture}, {0, 1, BindingType::StorageTexture}};
            Pass pass(*device, Shader::Mips, bindings);
            pass.write(0, {viewAt(0, *coarse), viewAt(1, *fine)});
            run(*device,
                [&](CommandBuffer& commands)
                {
                    commands.barrier(TextureBarrier{texture.get(), states::kUndefined, states::kStorageWrite, {0, 1}});
                    pass.record(commands, 8, 4);
                });
            const Bytes bytes = readBack(*device, *texture, 0, states::kStorageWrite);
            uint32_t wrongCount = 0;
            for (uint32_t y = 0; y < 32; y++)
                for (uint32_t x = 0; x < 64; x++)
                {
                    uint32_t expected = 0;
                    for (uint32_t mip = 1; mip < 5; mip++)
                        expected = expected * 16 + mips[mip][(y >> mip) * texture->mipWidth(mip) + (x >> mip)];
                    uint32_t seen = 0;
                    std::memcpy(&seen, bytes.data() + (y * 64 + x) * 4, 4);
                    wrongCount += seen != expected;
                }
            CHECK(wrongCount == 0);
        });
}
