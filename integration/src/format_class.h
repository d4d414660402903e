// What a texel format can keep, to tell whether an application's image serves a slot.
#pragma once
#include <nrd/types.h>
#include <rhi/format.h>

namespace nrd
{
enum class FormatRange : uint8_t
{
    Unorm, // [0; 1]
    Snorm, // [-1; 1]
    Float, // depth included
    Integer,
};

struct FormatClass
{
    FormatRange range = FormatRange::Integer;
    uint8_t channelCount = 0; // 0 for Unknown
    uint8_t bitCount = 0;     // of the smallest channel
};
FormatClass formatClass(rhi::Format format);

/// Whether `format` keeps everything that `minimum` does: as many channels, their range and their bits.
bool isAtLeast(rhi::Format format, rhi::Format minimum);

/// Whether texels of this format can hold normals and roughness in this encoding.
bool suits(rhi::Format format, NormalEncoding encoding);
const char* expectedFormat(NormalEncoding encoding); // for messages
} // namespace nrd
