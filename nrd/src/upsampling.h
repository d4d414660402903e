// Signals smaller than the guides: whatever the family, its results go to textures of their size, and from there, along
// the guides, to the outputs.
#pragma once
#include "pass_table.h"

namespace nrd
{
extern const TextureRow kSmallOutput;
extern const PassRow kUpsample;

Format outputFormat(const Variant& variant);
Shader upsampler(const Variant& variant);
} // namespace nrd
