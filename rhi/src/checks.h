// What can be checked of a description without knowing any state: done by every back end, so that bad input ends in one
// sentence on all of them. Each function throws rhi::Error, or returns.
#pragma once
#include <rhi/device.h>

namespace rhi
{
void checkTexture(const TextureDesc& desc, const DeviceLimits& limits, FormatSupport support);
/// Returns the view with its count of mips resolved.
TextureViewDesc checkView(const TextureDesc& texture, const TextureViewDesc& view);
void checkBuffer(const BufferDesc& desc);
void checkMemory(const MemoryDesc& desc);
void checkWrappedMemory(uint64_t handle, const MemoryDesc& desc);
void checkPlacement(const TextureDesc& desc, const MemoryRequirements& needs, const Memory& memory, uint64_t offset);
void checkPipeline(const PipelineDesc& desc, const DeviceLimits& limits);
void checkDescriptorPool(const DescriptorPoolDesc& desc);
void checkQueryPool(const QueryPoolDesc& desc, const DeviceLimits& limits);

/// `mips` with kAllMips replaced by the count that is left; unchanged if it starts beyond the last mip.
MipRange resolveMips(MipRange mips, uint32_t mipCount);

const char* safeName(const char* name); // never null
/// A sentence: printf-like, for messages only.
[[gnu::format(printf, 1, 2)]] std::string sentence(const char* format, ...);
[[noreturn]] void throwInvalid(const std::string& text);
} // namespace rhi
