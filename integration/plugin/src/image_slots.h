// The array of images that a denoiser takes: which slot each entry is, and whether the engine's images suit them.
#pragma once
#include "unique_instance.h"
#include <nrd/integration.h>
#include <nrd/plugin.h>
#include <rhi/span.h>
#include <vector>

namespace nrd::plugin
{
using Images = rhi::Span<const NrdPluginImage>;

constexpr Identifier kIdentifier = 0; // of the one denoiser in each instance here

/// An instance with this denoiser alone.
UniqueInstance makeInstance(Denoiser denoiser, NormalEncoding normalEncoding = NormalEncoding::R10_G10_B10_A2_UNORM);
void check(const Instance& instance, Result result); // throws the sentence of a refusal

/// In the order of the array, inputs first.
std::vector<ResourceRequirement> imageSlots(Denoiser denoiser);

/// The images in their slots, with the settings that follow from them: sizes and which optional ones are there.
struct SlottedImages
{
    NrdUserPool pool;
    CommonSettings common;
    NormalEncoding normalEncoding = NormalEncoding::R10_G10_B10_A2_UNORM;
};
/// Throws a sentence about the first image that is missing or does not suit its slot. `generation`: another number
/// where images may have the handles of older ones that are gone.
SlottedImages slotted(Denoiser denoiser, Images images, uint64_t generation);
} // namespace nrd::plugin
