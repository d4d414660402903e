// What the tables of REBLUR and RELAX have in common: conditions and rows that depend on no family's settings.
#pragma once
#include "bindings.h"
#include "common_constants.h"
#include "pass_table.h"

namespace nrd
{
// With the split at the right border nothing but the input is shown, so nothing else runs.
inline bool isDenoised(const Conditions& c) { return c.common.splitScreen < 1.0f; }
inline bool isSplit(const Conditions& c) { return c.common.splitScreen > 0.0f; }

inline bool hasConfidence(const Conditions& c) { return c.common.isHistoryConfidenceAvailable; }
inline bool hasDisocclusionMix(const Conditions& c) { return c.common.isDisocclusionThresholdMixAvailable; }
inline bool hasSpecularMotion(const Conditions& c) { return c.common.isSpecularMotionAvailable; }
inline bool hasValidation(const Conditions& c) { return c.common.enableValidation; }

// minMaterial...: of the family's settings.
inline bool usesMaterials(const Conditions& c, uint32_t minMaterialForDiffuse, uint32_t minMaterialForSpecular)
{
    constexpr uint32_t kMaterialNum = 4; // two bits
    if (c.normalEncoding != NormalEncoding::R10_G10_B10_A2_UNORM) return false;
    return (has(c.variant, kDiffuse) && minMaterialForDiffuse < kMaterialNum) ||
           (has(c.variant, kSpecular) && minMaterialForSpecular < kMaterialNum) ||
           c.common.strandMaterialID < kMaterialNum || c.common.cameraAttachedReflectionMaterialID < kMaterialNum ||
           c.common.historyFixAlternatePixelStrideMaterialID < kMaterialNum;
}

template <class Settings> bool isBlurred(const Conditions& c, const Settings& s)
{
    return (has(c.variant, kDiffuse) && s.diffusePrepassBlurRadius > 0.0f) ||
           (has(c.variant, kSpecular) && s.specularPrepassBlurRadius > 0.0f);
}

constexpr SwitchRow kConfidence = {SPEC_HAS_CONFIDENCE, hasConfidence};
constexpr SwitchRow kReflectedMotion = {SPEC_HAS_SPECULAR_MOTION, hasSpecularMotion, kSpecular};

constexpr ResourceType ViewZ = ResourceType::IN_VIEWZ;
constexpr ResourceType NormalRoughness = ResourceType::IN_NORMAL_ROUGHNESS;
constexpr ResourceType Motion = ResourceType::IN_MV;

constexpr Slot kThresholdMix = optional(hasDisocclusionMix, ResourceType::IN_DISOCCLUSION_THRESHOLD_MIX);
constexpr Slot kDiffuseConfidence = only(kDiffuse, optional(hasConfidence, ResourceType::IN_DIFF_CONFIDENCE));
constexpr Slot kSpecularConfidence = only(kSpecular, optional(hasConfidence, ResourceType::IN_SPEC_CONFIDENCE));
constexpr Slot kSpecularMotion = only(kSpecular, optional(hasSpecularMotion, ResourceType::IN_SPEC_MV));

constexpr GroupSize kTile = {TILE_SIZE, TILE_SIZE}; // whatever the number of invocations
constexpr GroupSize kGroup16x16 = {16, 16};
constexpr GroupSize kGroup8x16 = {8, 16};

constexpr SignalRow diffuse(ResourceType input, ResourceType output, Format format)
{
    return {input, output, format, kDiffuse};
}
constexpr SignalRow specular(ResourceType input, ResourceType output, Format format)
{
    return {input, output, format, kSpecular};
}

constexpr SignalRow lending(SignalRow row)
{
    row.lendsOutput = true;
    return row;
}

using Type = ResourceType;

constexpr SignalRow kDiffuseRadiance =
    lending(diffuse(Type::IN_DIFF_RADIANCE_HITDIST, Type::OUT_DIFF_RADIANCE_HITDIST, Format::RGBA16_SFLOAT));
constexpr SignalRow kSpecularRadiance =
    lending(specular(Type::IN_SPEC_RADIANCE_HITDIST, Type::OUT_SPEC_RADIANCE_HITDIST, Format::RGBA16_SFLOAT));
constexpr SignalRow kDiffuseSh0 = lending(diffuse(Type::IN_DIFF_SH0, Type::OUT_DIFF_SH0, Format::RGBA16_SFLOAT));
constexpr SignalRow kSpecularSh0 = lending(specular(Type::IN_SPEC_SH0, Type::OUT_SPEC_SH0, Format::RGBA16_SFLOAT));
// Directions are kept relative to luma, so ten bits do and a change of luma leaves them alone.
constexpr SignalRow kDiffuseSh1 = diffuse(Type::IN_DIFF_SH1, Type::OUT_DIFF_SH1, Format::A2B10G10R10_UNORM_PACK32);
constexpr SignalRow kSpecularSh1 = specular(Type::IN_SPEC_SH1, Type::OUT_SPEC_SH1, Format::A2B10G10R10_UNORM_PACK32);
} // namespace nrd
