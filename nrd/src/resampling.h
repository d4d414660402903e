// A denoiser smaller than the guides. Whatever the family, its results go to textures of its size, and from there,
// along the guides, to the outputs; noisy signals of the full size are averaged into such textures first.
#pragma once
#include "pass_table.h"

namespace nrd
{
extern const TextureRow kSmallInput, kSmallOutput;
extern const PassRow kDownsample, kUpsample;

Format outputFormat(const Variant& variant);
Shader downsampler(const Variant& variant);
Shader upsampler(const Variant& variant);
} // namespace nrd
