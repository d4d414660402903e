#include "catch.h"
#include "fixture.h"
#include "gpu.h"
#include <bit>
#include <cmath>
#include <cstring>

using namespace rhi;
using namespace rhi::test;

namespace
{
constexpr uint32_t kWidth = 37; // neither a multiple of the workgroup nor of any alignment
constexpr uint32_t kHeight = 19;

uint32_t hash(uint32_t x)
{
    x = (x ^ 61u) ^ (x >> 16);
    x *= 9u;
    x = (x ^ (x >> 4)) * 0x27d4eb2du;
    return x ^ (x >> 15);
}

/// A float with `mantissaBits` and `exponentBits` whose value is normal: drivers may flush denormals and quieten NaNs.
uint32_t normalFloat(uint32_t random, uint32_t exponentBits, uint32_t mantissaBits, bool isSigned)
{
    const uint32_t maxExponent = (1u << exponentBits) - 2;
    const uint32_t exponent = 1 + (random >> 8) % maxExponent;
    const uint32_t mantissa = hash(random) & ((1u << mantissaBits) - 1);
    const uint32_t sign = isSigned ? random & 1 : 0;
    return (sign << (exponentBits + mantissaBits)) | (exponent << mantissaBits) | mantissa;
}

enum class Encoding
{
    Unorm,
    Snorm,
    Integer,
    Float,
    Packed10,
    Packed11,
};

Encoding encodingOf(Format format)
{
    const std::string name = formatInfo(format).name;
    if (name.rfind("B10G11R11", 0) == 0) return Encoding::Packed11;
    if (name.rfind("A2", 0) == 0) return Encoding::Packed10;
    if (name.find("UNORM") != std::string::npos) return Encoding::Unorm;
    if (name.find("SNORM") != std::string::npos) return Encoding::Snorm;
    if (name.find("FLOAT") != std::string::npos) return Encoding::Float;
    return Encoding::Integer;
}

/// One texel whose bits survive being read and written by a shader.
void makeTexel(Format format, uint32_t seed, std::byte* texel)
{
    const FormatInfo& info = formatInfo(format);
    const Encoding encoding = encodingOf(format);
    const uint32_t bits = info.texelSize * 8u / info.componentCount;
    if (encoding == Encoding::Packed10 || encoding == Encoding::Packed11)
    {
        const uint32_t packed = encoding == Encoding::Packed10 ? hash(seed)
                                                               : normalFloat(hash(seed), 5, 6, false) |
                                                                     normalFloat(hash(seed + 1), 5, 6, false) << 11 |
                                                                     normalFloat(hash(seed + 2), 5, 5, false) << 22;
        std::memcpy(texel, &packed, sizeof(packed));
        return;
    }
    for (uint32_t c = 0; c < info.componentCount; c++)
    {
        uint32_t value = hash(seed * 4 + c);
        if (encoding == Encoding::Float) value = normalFloat(value, bits == 16 ? 5 : 8, bits == 16 ? 10 : 23, true);
        const uint32_t lowest = 1u << (bits - 1); // the second -1 of a signed normalised format
        const uint32_t mask = bits == 32 ? ~0u : (1u << bits) - 1;
        if (encoding == Encoding::Snorm && (value & mask) == lowest) value++;
        std::memcpy(texel + c * bits / 8, &value, bits / 8); // little-endian
    }
}

Bytes makeTexels(Format format, uint32_t width, uint32_t height)
{
    const uint32_t size = formatInfo(format).texelSize;
    Bytes bytes(size_t{width} * height * size);
    for (uint32_t i = 0; i < width * height; i++) makeTexel(format, i * 7 + 1, bytes.data() + size_t{i} * size);
    return bytes;
}

float toFloat(uint32_t bits, uint32_t exponentBits, uint32_t mantissaBits)
{
    const int32_t bias = (1 << (exponentBits - 1)) - 1;
    const int32_t exponent = static_cast<int32_t>((bits >> mantissaBits) & ((1u << exponentBits) - 1)) - bias;
    const float mantissa =
        1.0f + static_cast<float>(bits & ((1u << mantissaBits) - 1)) / static_cast<float>(1u << mantissaBits);
    const bool isNegative = (bits >> (exponentBits + mantissaBits)) & 1;
    return std::ldexp(isNegative ? -mantissa : mantissa, exponent);
}

/// Component `c` as a shader sees it: the bits of a float, or an integer.
uint32_t decode(Format format, const std::byte* texel, uint32_t c)
{
    const FormatInfo& info = formatInfo(format);
    const Encoding encoding = encodingOf(format);
    const bool isInteger = info.formatClass == FormatClass::Int || info.formatClass == FormatClass::Uint;
    if (c >= info.componentCount) return c < 3 ? 0 : isInteger ? 1 : std::bit_cast<uint32_t>(1.0f);
    uint32_t packed = 0;
    const uint32_t bits = info.texelSize * 8u / info.componentCount;
    if (encoding == Encoding::Packed10)
    {
        std::memcpy(&packed, texel, 4);
        const uint32_t shift = std::string(info.name).rfind("A2R10", 0) == 0 && c < 3 ? (2 - c) * 10 : c * 10;
        const uint32_t value = (packed >> shift) & (c < 3 ? 1023u : 3u);
        if (isInteger) return value;
        return std::bit_cast<uint32_t>(static_cast<float>(value) / (c < 3 ? 1023.0f : 3.0f));
    }
    if (encoding == Encoding::Packed11)
    {
        std::memcpy(&packed, texel, 4);
        const uint32_t value = (packed >> (c * 11)) & (c < 2 ? 2047u : 1023u);
        return std::bit_cast<uint32_t>(toFloat(value, 5, c < 2 ? 6 : 5));
    }
    const bool isSwapped = format == Format::BGRA8_UNORM && c < 3;
    std::memcpy(&packed, texel + (isSwapped ? 2 - c : c) * bits / 8, bits / 8);
    const uint32_t mask = bits == 32 ? ~0u : (1u << bits) - 1;
    const bool isNegative = (packed >> (bits - 1)) & 1;
    const int32_t extended = static_cast<int32_t>(isNegative ? packed | ~mask : packed);
    switch (encoding)
    {
    case Encoding::Unorm:
        return std::bit_cast<uint32_t>(static_cast<float>(packed) / static_cast<float>(mask));
    case Encoding::Snorm:
        return std::bit_cast<uint32_t>(static_cast<float>(extended) / static_cast<float>(mask / 2));
    case Encoding::Float:
        return bits == 32 ? packed : std::bit_cast<uint32_t>(toFloat(packed, 5, 10));
    case Encoding::Integer:
    case Encoding::Packed10:
    case Encoding::Packed11:
        break;
    }
    return info.formatClass == FormatClass::Int ? static_cast<uint32_t>(extended) : packed;
}

/// Every colour format but sRGB, which a shader cannot write, and the shared exponent, which has no unique bits.
std::vector<Format> colorFormats()
{
    std::vector<Format> formats;
    for (uint32_t i = 1; i < static_cast<uint32_t>(Format::Count); i++)
    {
        const Format format = static_cast<Format>(i);
        const bool isLeftOut = format == Format::RGBA8_SRGB || format == Format::E5B9G9R9_UFLOAT_PACK32 ||
                               formatInfo(format).formatClass == FormatClass::Depth;
        if (!isLeftOut) formats.push_back(format);
    }
    return formats;
}

Shader byClass(Format format, Shader ofFloat, Shader ofInt, Shader ofUint)
{
    switch (formatInfo(format).formatClass)
    {
    case FormatClass::Int:
        return ofInt;
    case FormatClass::Uint:
        return ofUint;
    case FormatClass::Float:
    case FormatClass::Depth:
        break;
    }
    return ofFloat;
}

bool isSupported(Device& device, Format format, FormatSupport needed)
{
    if (hasAll(device.formatSupport(format), needed)) return true;
    skip(device.info().name + " lacks an access to format " + formatInfo(format).name);
    return false;
}

TextureDesc textureDesc(Format format, TextureUsage usage)
{
    TextureDesc desc;
    desc.format = format;
    desc.width = kWidth;
    desc.height = kHeight;
    desc.usage = usage;
    desc.name = formatInfo(format).name;
    return desc;
}

constexpr BindingDesc kTextureToTexture[] = {{0, 0, BindingType::SampledTexture}, {0, 1, BindingType::StorageTexture}};
constexpr BindingDesc kTextureToBuffer[] = {{0, 0, BindingType::SampledTexture}, {0, 1, BindingType::StorageBuffer}};

void copyThroughShader(Device& device, Format format)
{
    const auto from = device.createTexture(textureDesc(format, TextureUsage::Sampled | TextureUsage::TransferDst));
    const auto to = device.createTexture(textureDesc(format, TextureUsage::Storage | TextureUsage::TransferSrc));
    const Bytes texels = makeTexels(format, kWidth, kHeight);
    upload(device, *from, 0, texels, states::kSampled);
    const auto fromView = device.createView(*from, {ViewType::Sampled, {}});
    const auto toView = device.createView(*to, {ViewType::Storage, {}});
    Pass pass(device, byClass(format, Shader::CopyFloat, Shader::CopyInt, Shader::CopyUint), kTextureToTexture);
    pass.write(0, {viewAt(0, *fromView), viewAt(1, *toView)});
    run(device,
        [&](CommandBuffer& commands)
        {
            commands.barrier(TextureBarrier{to.get(), states::kUndefined, states::kStorageWrite, {}});
            pass.record(commands, (kWidth + 7) / 8, (kHeight + 7) / 8);
        });
    CHECK(readBack(device, *to, 0, states::kStorageWrite) == texels);
}

std::vector<uint32_t> fetchThroughShader(Device& device, const Texture& texture)
{
    const auto view = device.createView(texture, {ViewType::Sampled, {}});
    const auto out =
        makeBuffer(device, size_t{kWidth} * kHeight * 16, BufferUsage::Storage, BufferMemory::Readback, "fetched");
    const Format format = texture.desc().format;
    Pass pass(device, byClass(format, Shader::FetchFloat, Shader::FetchInt, Shader::FetchUint), kTextureToBuffer);
    pass.write(0, {viewAt(0, *view), bufferAt(1, *out)});
    run(device,
        [&](CommandBuffer& commands)
        {
            pass.record(commands, (kWidth + 7) / 8, (kHeight + 7) / 8);
            commands.barrier(
                BufferBarrier{out.get(), {Access::StorageWrite, Stage::Compute}, {Access::HostRead, Stage::Host}});
        });
    const Span<uint32_t> words = mappedAs<uint32_t>(*out);
    return {words.begin(), words.end()};
}
} // namespace

TEST_CASE("every colour format survives upload, sampled read, storage write and read-back bit for bit", "[gpu]")
{
    forEachDevice(
        [](TestDevice& device)
        {
            for (const Format format : colorFormats())
            {
                INFO(formatInfo(format).name);
                if (isSupported(*device, format,
                                FormatSupport::Sampled | FormatSupport::Storage | FormatSupport::TransferSrc |
                                    FormatSupport::TransferDst))
                    copyThroughShader(*device, format);
            }
        });
}

TEST_CASE("a shader sees the values that a format's texels stand for", "[gpu]")
{
    forEachDevice(
        [](TestDevice& device)
        {
            for (const Format format : colorFormats())
            {
                INFO(formatInfo(format).name);
                if (!isSupported(*device, format, FormatSupport::Sampled | FormatSupport::TransferDst)) continue;
                const auto texture =
                    device->createTexture(textureDesc(format, TextureUsage::Sampled | TextureUsage::TransferDst));
                const Bytes texels = makeTexels(format, kWidth, kHeight);
                upload(*device, *texture, 0, texels, states::kSampled);
                const std::vector<uint32_t> seen = fetchThroughShader(*device, *texture);
                uint32_t wrongCount = 0;
                for (uint32_t i = 0; i < kWidth * kHeight * 4; i++)
                {
                    const size_t texelSize = formatInfo(format).texelSize;
                    const uint32_t expected = decode(format, texels.data() + i / 4 * texelSize, i % 4);
                    const bool isFloat = formatInfo(format).formatClass == FormatClass::Float;
                    const float a = std::bit_cast<float>(seen[i]);
                    const float b = std::bit_cast<float>(expected);
                    // Normalised formats may be off by rounding: 2^-20 is far below a step of 16 bits.
                    const bool isEqual = isFloat ? std::abs(a - b) <= std::abs(b) * 0x1p-20f : seen[i] == expected;
                    wrongCount += !isEqual;
                }
                CHECK(wrongCount == 0);
            }
        });
}

TEST_CASE("a clear fills exactly the mips it names", "[gpu]")
{
    forEachDevice(
        [](TestDevice& device)
        {
            TextureDesc desc =
                textureDesc(Format::RGBA16_SFLOAT, TextureUsage::TransferSrc | TextureUsage::TransferDst);
            desc.mipCount = 3;
            const auto texture = device->createTexture(desc);
            run(*device,
                [&](CommandBuffer& commands)
                {
                    commands.barrier(TextureBarrier{texture.get(), states::kUndefined, states::kTransferDst, {}});
                    commands.clearTexture(*texture, {0, 1}, {false, {1.0f, 2.0f, -0.5f, 0.25f}, {}});
                    commands.clearTexture(*texture, {1, kAllMips}, {false, {0.0f, 0.0f, 0.0f, 4.0f}, {}});
                });
            const Bytes fine = readBack(*device, *texture, 0, states::kTransferDst);
            const Bytes coarse = readBack(*device, *texture, 2, states::kTransferDst);
            const uint16_t expectedFine[4] = {0x3c00, 0x4000, 0xb800, 0x3400};
            const uint16_t expectedCoarse[4] = {0, 0, 0, 0x4400};
            CHECK(std::memcmp(fine.data() + fine.size() - 8, expectedFine, 8) == 0);
            CHECK(std::memcmp(coarse.data(), expectedCoarse, 8) == 0);
            CHECK(coarse.size() == size_t{kWidth / 4} * (kHeight / 4) * 8);
        });
}
