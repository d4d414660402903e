// Checks an application's user pool against what the denoisers need: pure, before anything is recorded.
#pragma once
#include <nrd/integration.h>
#include <rhi/span.h>
#include <string>

namespace nrd
{
struct SlotRules
{
    uint32_t width = 0; // pixels, the resource size
    uint32_t height = 0;
    NormalEncoding normalEncoding = NormalEncoding::R10_G10_B10_A2_UNORM;
};

/// Empty, or one sentence that names the slot and what is wrong with its image for this need of `denoiser`.
std::string findError(const NrdUserImage& image, const ResourceRequirement& need, const SlotRules& rules,
                      const char* denoiser);

/// Empty, or one sentence that names an output which holds steps on the way and a slot that is the same image.
std::string findOverlap(const NrdUserPool& pool, rhi::Span<const ResourceRequirement> needs);

/// Empty, or one sentence that names two slots which hold one image in two states.
std::string findStateConflict(const NrdUserPool& pool);
} // namespace nrd
