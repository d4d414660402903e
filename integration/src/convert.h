// Between the vocabularies of the descriptor library, the RHI and Vulkan.
#pragma once
#include <nrd/integration.h>
#include <rhi/error.h>
#include <rhi/format.h>
#include <rhi/pipeline.h>
#include <rhi/states.h>

namespace nrd
{
rhi::Format toRhi(Format format); // Unknown for values outside the enumeration
rhi::SamplerKind toRhi(Sampler sampler);
Result toResult(rhi::ErrorCode code);

/// The state of a texture while a dispatch uses it.
rhi::TextureState toRhi(ResourceState state, LayoutPolicy policy);
/// The state of a buffer while a dispatch uses it.
rhi::BufferState toBufferState(ResourceState state);

rhi::MemoryState toRhi(const NrdMemoryUse& use); // native
/// Native unless it is one that compute passes leave images in: then equal states compare equal.
rhi::TextureState toRhi(const NrdImageState& state);
/// Only of states that compute passes leave images in, or of Native ones.
NrdImageState toImageState(const rhi::TextureState& state);
} // namespace nrd
