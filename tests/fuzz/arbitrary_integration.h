// What an application may hand to NrdIntegration, made of bytes: mostly sensible, now and then anything.
#pragma once
#include "fuzz.h"

#include <nrd/integration.h>

namespace fuzz
{
// Without native handles. Most sides are at most `smallSize` pixels.
nrd::NrdMemory arbitraryMemory(ByteReader& reader); // mostly none
nrd::IntegrationCreationDesc arbitraryDesc(ByteReader& reader, uint32_t smallSize);

// One thing of it.
void changeImage(ByteReader& reader, nrd::NrdUserImage& image);

// Up to three images.
void damagePool(ByteReader& reader, nrd::NrdUserPool& pool);
} // namespace fuzz
