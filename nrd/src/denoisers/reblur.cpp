// REBLUR: recurrent blur with two kinds of history. Textures, passes, variants; the constants are next door.
#include "reblur.h"
#include "bindings.h"
#include "families.h"
#include <cstring>

namespace nrd
{
namespace
{
enum Tex : uint8_t
{
    Tiles,
    Length,
    FastTemp,
    TrackNew,
    StabHistory,
    StabWeight,
    VirtualAmount,
    Scratch,
    PrevViewZ,
    PrevNormalRoughness,
    PrevLength,
    History,
    Fast,
    Stab,
    Track
};

using enum Format;
using enum Lifetime;

constexpr TextureRow kTextures[] = {
    {Tiles, "Tiles", fixed(R8_UNORM), Transient, 16},
    {Length, "Length", perLobes(R8_UNORM, RG8_UNORM), Transient},
    {FastTemp, "FastTemp", perLobes(R16_SFLOAT, RG16_SFLOAT), Transient},
    {TrackNew, "TrackNew", fixed(R16_SFLOAT), Transient, 1, kSpecular},
    {StabHistory, "StabHistory", perLobes(R16_SFLOAT, RG16_SFLOAT), Transient},
    {StabWeight, "StabWeight", perLobes(R8_UNORM, RG8_UNORM), Transient},
    {VirtualAmount, "VirtualAmount", fixed(R8_UNORM), Transient, VIRTUAL_AMOUNT_STEP, kSpecular},
    {Scratch, "Scratch", kPerSignal, Transient},
    {PrevViewZ, "PrevViewZ", fixed(R32_SFLOAT), Permanent},
    {PrevNormalRoughness, "PrevNormalRoughness", kGuide, Permanent},
    {PrevLength, "PrevLength", perLobes(R8_UINT, R16_UINT), Permanent},
    {History, "History", kPerSignal, Permanent},
    {Fast, "Fast", perLobes(R16_SFLOAT, RG16_SFLOAT), Permanent},
    {Stab, "Stab", perLobes(R16_SFLOAT, RG16_SFLOAT), Permanent},
    {Track, "Track", fixed(R16_SFLOAT), PingPong, 1, kSpecular},
};
static_assert(rowsMatchKeys(kTextures));

const ReblurSettings& settingsOf(const Conditions& c) { return *std::get_if<ReblurSettings>(&c.settings); }

// With the split at the right border nothing but the input is shown, so nothing else runs.
bool isDenoised(const Conditions& c) { return c.common.splitScreen < 1.0f; }
bool isSplit(const Conditions& c) { return c.common.splitScreen > 0.0f; }

bool hasPrePass(const Conditions& c)
{
    const ReblurSettings& s = settingsOf(c);
    return ((c.lobes & kDiffuse) && s.diffusePrepassBlurRadius > 0.0f) ||
           ((c.lobes & kSpecular) && s.specularPrepassBlurRadius > 0.0f);
}
bool runsPrePass(const Conditions& c) { return isDenoised(c) && hasPrePass(c); }

bool hasStabilization(const Conditions& c) { return settingsOf(c).maxStabilizedFrameNum > 0; }
bool runsStabilization(const Conditions& c) { return isDenoised(c) && hasStabilization(c); }

bool hasAntiFirefly(const Conditions& c) { return settingsOf(c).enableAntiFirefly; }
bool hasConfidence(const Conditions& c) { return c.common.isHistoryConfidenceAvailable; }
bool hasDisocclusionMix(const Conditions& c) { return c.common.isDisocclusionThresholdMixAvailable; }
bool hasValidation(const Conditions& c) { return c.common.enableValidation; }

bool hasMaterialTest(const Conditions& c)
{
    constexpr uint32_t kMaterialNum = 4; // two bits
    if (c.normalEncoding != NormalEncoding::R10_G10_B10_A2_UNORM) return false;
    const ReblurSettings& s = settingsOf(c);
    return ((c.lobes & kDiffuse) && s.minMaterialForDiffuse < kMaterialNum) ||
           ((c.lobes & kSpecular) && s.minMaterialForSpecular < kMaterialNum) ||
           c.common.strandMaterialID < kMaterialNum || c.common.cameraAttachedReflectionMaterialID < kMaterialNum ||
           c.common.historyFixAlternatePixelStrideMaterialID < kMaterialNum;
}

constexpr SwitchRow kPrePassSwitch = {SPEC_HAS_PREPASS, hasPrePass, kSpecular};
constexpr SwitchRow kStabilization = {SPEC_HAS_STABILIZATION, hasStabilization};
constexpr SwitchRow kMaterialTest = {SPEC_HAS_MATERIAL_TEST, hasMaterialTest};
constexpr SwitchRow kConfidence = {SPEC_HAS_CONFIDENCE, hasConfidence};
constexpr SwitchRow kDisocclusionMix = {SPEC_HAS_DISOCCLUSION_MIX, hasDisocclusionMix};
constexpr SwitchRow kAntiFirefly = {SPEC_HAS_ANTI_FIREFLY, hasAntiFirefly};
constexpr SwitchRow kValidationSwitch = {SPEC_HAS_VALIDATION, hasValidation, kSpecular};

constexpr ResourceType ViewZ = ResourceType::IN_VIEWZ;
constexpr ResourceType NormalRoughness = ResourceType::IN_NORMAL_ROUGHNESS;
constexpr ResourceType Motion = ResourceType::IN_MV;

// Without a pre-pass the input is accumulated as it came, and nobody wrote a tracking distance.
constexpr Slot kEachAccumulated = choose(hasPrePass, each(Scratch), kEachInput);
constexpr Slot kTrackNew = only(kSpecular, optional(hasPrePass, TrackNew));
// Without stabilisation nobody keeps this history up to date.
constexpr Slot kStab = optional(hasStabilization, Stab);
constexpr Slot kThresholdMix = optional(hasDisocclusionMix, ResourceType::IN_DISOCCLUSION_THRESHOLD_MIX);
constexpr Slot kDiffuseConfidence = only(kDiffuse, optional(hasConfidence, ResourceType::IN_DIFF_CONFIDENCE));
constexpr Slot kSpecularConfidence = only(kSpecular, optional(hasConfidence, ResourceType::IN_SPEC_CONFIDENCE));
// The overlay shows the inputs even when nothing is denoised.
constexpr Slot kShownLength = optional(isDenoised, Length);
constexpr Slot kShownVirtualAmount = only(kSpecular, optional(isDenoised, VirtualAmount));

constexpr GroupSize kTile = {TILE_SIZE, TILE_SIZE}; // whatever the number of invocations
constexpr GroupSize kGroup16x16 = {16, 16};
constexpr GroupSize kGroup8x16 = {8, 16};

// In the order of kVariants.
constexpr ShaderSet kPrePass = {Shader::ReblurPrePassDiffuse, Shader::ReblurPrePassSpecular,
                                Shader::ReblurPrePassDiffuseSpecular};
constexpr ShaderSet kTemporalAccumulation = {Shader::ReblurTemporalAccumulationDiffuse,
                                             Shader::ReblurTemporalAccumulationSpecular,
                                             Shader::ReblurTemporalAccumulationDiffuseSpecular};
constexpr ShaderSet kHistoryFix = {Shader::ReblurHistoryFixDiffuse, Shader::ReblurHistoryFixSpecular,
                                   Shader::ReblurHistoryFixDiffuseSpecular};
constexpr ShaderSet kBlur = {Shader::ReblurBlurDiffuse, Shader::ReblurBlurSpecular, Shader::ReblurBlurDiffuseSpecular};
constexpr ShaderSet kPostBlur = {Shader::ReblurPostBlurDiffuse, Shader::ReblurPostBlurSpecular,
                                 Shader::ReblurPostBlurDiffuseSpecular};
constexpr ShaderSet kTemporalStabilization = {Shader::ReblurTemporalStabilizationDiffuse,
                                              Shader::ReblurTemporalStabilizationSpecular,
                                              Shader::ReblurTemporalStabilizationDiffuseSpecular};
constexpr ShaderSet kSplitScreen = {Shader::ReblurSplitScreenDiffuse, Shader::ReblurSplitScreenSpecular,
                                    Shader::ReblurSplitScreenDiffuseSpecular};
constexpr ShaderSet kValidation = {Shader::ReblurValidationDiffuse, Shader::ReblurValidationSpecular,
                                   Shader::ReblurValidationDiffuseSpecular};

// name, shader per variant, reads, writes, group, runs if, switches. Outputs are written once, by the last pass.
constexpr PassRow kPasses[] = {
    {"Classify tiles", Shader::ReblurClassifyTiles, {ViewZ}, {Tiles}, kTile, isDenoised},
    {"Pre-pass",
     kPrePass,
     {Tiles, ViewZ, NormalRoughness, kEachInput},
     {each(Scratch), only(kSpecular, TrackNew)},
     kGroup16x16,
     runsPrePass,
     {kMaterialTest}},
    {"Temporal accumulation",
     kTemporalAccumulation,
     {Tiles, ViewZ, NormalRoughness, Motion, PrevViewZ, PrevNormalRoughness, PrevLength, kThresholdMix,
      kDiffuseConfidence, kSpecularConfidence, kEachAccumulated, each(History), Fast, kStab, kTrackNew,
      only(kSpecular, prev(Track))},
     {each(Scratch), FastTemp, Length, StabHistory, StabWeight, only(kSpecular, Track), only(kSpecular, VirtualAmount)},
     kGroup8x16,
     isDenoised,
     {kPrePassSwitch, kStabilization, kMaterialTest, kConfidence, kDisocclusionMix, kValidationSwitch}},
    {"History fix",
     kHistoryFix,
     {Tiles, ViewZ, NormalRoughness, Length, each(Scratch), FastTemp, only(kSpecular, Track)},
     {each(History), Fast},
     kGroup8x16,
     isDenoised,
     {kAntiFirefly, kMaterialTest}},
    {"Blur",
     kBlur,
     {Tiles, ViewZ, NormalRoughness, Length, each(History)},
     {each(Scratch), PrevViewZ},
     kGroup8x16,
     isDenoised,
     {kMaterialTest}},
    {"Post-blur",
     kPostBlur,
     {Tiles, ViewZ, NormalRoughness, Length, each(Scratch)},
     {each(History), PrevNormalRoughness, PrevLength, kEachOutput},
     kGroup8x16,
     isDenoised,
     {kMaterialTest, kStabilization}},
    {"Temporal stabilization",
     kTemporalStabilization,
     {Tiles, ViewZ, Length, StabHistory, StabWeight, each(History), only(kSpecular, NormalRoughness)},
     {kEachOutput, Stab, PrevLength},
     kGroup8x16,
     runsStabilization},
    {"Split screen", kSplitScreen, {ViewZ, kEachInput}, {kEachOutput}, kGroup16x16, isSplit},
    {"Validation",
     kValidation,
     {ViewZ, NormalRoughness, Motion, kShownLength, kShownVirtualAmount, kEachInput},
     {ResourceType::OUT_VALIDATION},
     kGroup16x16,
     hasValidation},
};

constexpr SignalRow kDiffuseRadiance = {ResourceType::IN_DIFF_RADIANCE_HITDIST, ResourceType::OUT_DIFF_RADIANCE_HITDIST,
                                        RGBA16_SFLOAT, kDiffuse};
constexpr SignalRow kSpecularRadiance = {ResourceType::IN_SPEC_RADIANCE_HITDIST,
                                         ResourceType::OUT_SPEC_RADIANCE_HITDIST, RGBA16_SFLOAT, kSpecular};

// The only place that knows which denoiser has which lobes and signals.
constexpr Variant kVariants[] = {
    {Denoiser::REBLUR_DIFFUSE, kDiffuse, {kDiffuseRadiance}},
    {Denoiser::REBLUR_SPECULAR, kSpecular, {kSpecularRadiance}},
    {Denoiser::REBLUR_DIFFUSE_SPECULAR, kBoth, {kDiffuseRadiance, kSpecularRadiance}},
};
static_assert(shadersMatchVariants(kPasses, std::size(kVariants)));
static_assert(sizeof(shared::ReblurConstants) <= kConstantMaxByteSize);

void fillConstants(const Request& request, void* block)
{
    const shared::ReblurConstants constants = makeReblurConstants(request);
    std::memcpy(block, &constants, sizeof(constants));
}

RequestHistory advance(const Request& request)
{
    RequestHistory next = request.history;
    const bool isDenoising = request.common.splitScreen < 1.0f;
    next.isValid = isDenoising;
    next.isStabilized = isDenoising && std::get<ReblurSettings>(request.settings).maxStabilizedFrameNum > 0;
    next.splitScreen = request.common.splitScreen;
    return next;
}
} // namespace

const Family kReblur = {ReblurSettings{}, kVariants, kTextures, kPasses, sizeof(shared::ReblurConstants), true,
                        fillConstants,    advance};
} // namespace nrd
