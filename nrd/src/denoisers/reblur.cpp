// REBLUR: recurrent blur with two kinds of history. Textures, passes, variants; the constants are next door.
#include "reblur.h"
#include "common_rows.h"
#include "families.h"
#include <cstring>

namespace nrd
{
namespace
{
enum Tex : uint8_t
{
    Tiles,
    Cut,
    Cap,
    Length,
    FastTemp,
    TrackNew,
    StabHistory,
    StabWeight,
    VirtualAmount,
    BlurLuma,
    Work,
    PrevDepth,
    PrevNormalRoughness,
    PrevLength,
    History,
    Fast,
    Pair,
    Spread,
    NewSpread,
    Stab,
    Track
};

using enum Format;
using enum Lifetime;

constexpr Having kSpecularColor = {kSpecular, kColor};
constexpr Having kSpecularOcclusion = {kSpecular, kOcclusion};

constexpr TextureRow kTextures[] = {
    {Tiles, "Tiles", fixed(R8_UNORM), Transient, TILE_SIZE},
    {Cut, "Cut", fixed(R32_UINT), PingPong, kOneTexel}, // a sum of votes
    {Cap, "Cap", fixed(RGBA16_SFLOAT), Transient, TILE_SIZE, kColor},
    {Length, "Length", perLobes(R8_UNORM, RG8_UNORM), Transient},
    {FastTemp, "FastTemp", kLuma, Transient},
    {TrackNew, "TrackNew", fixed(R16_SFLOAT), Transient, 1, kSpecularColor},
    {StabHistory, "StabHistory", perLobes(R16_SFLOAT, RG16_SFLOAT), Transient, 1, kStabilized},
    {StabWeight, "StabWeight", perLobes(R8_UNORM, RG8_UNORM), Transient, 1, kStabilized},
    {VirtualAmount, "VirtualAmount", fixed(R8_UNORM), Transient, VIRTUAL_AMOUNT_STEP, kSpecular},
    {BlurLuma, "BlurLuma", perLobes(R16_SFLOAT, RG16_SFLOAT), Transient, 1, kStabilized},
    {Work, "Work", kPerSignal, Lent, 1, kStabilized},
    {PrevDepth, "PrevDepth", fixed(R16_UNORM), Permanent},
    {PrevNormalRoughness, "PrevNormalRoughness", kPrevGuide, Permanent},
    {PrevLength, "PrevLength", perLobes(R8_UINT, R16_UINT), Permanent},
    {History, "History", kPerSignal, Permanent, 1, kStabilized},
    {Fast, "Fast", kLuma, Permanent},
    {Pair, "Pair", kPerSignal, PingPong, 1, kOcclusion},
    {Spread, "Spread", fixed(RGBA16_SFLOAT), PingPong, TILE_SIZE, kColor},
    {NewSpread, "NewSpread", fixed(RGBA16_SFLOAT), PingPong, TILE_SIZE, kColor}, // without the past
    {Stab, "Stab", perLobes(R16_SFLOAT, RG16_SFLOAT), Permanent, 1, kStabilized},
    {Track, "Track", fixed(R16_SFLOAT), PingPong, 1, kSpecularColor},
};
static_assert(rowsMatchKeys(kTextures));

ReblurSettings settingsOf(const Conditions& c) { return effective(std::get<ReblurSettings>(c.settings)); }

// Besides blurring, the pre-pass completes what an application left out: hit distances, half of a checkerboard.
bool hasPrePass(const Conditions& c)
{
    const ReblurSettings s = settingsOf(c);
    return isIncomplete(s) || (isBlurred(c, s) && has(c.variant, kColor));
}
bool runsPrePass(const Conditions& c) { return isDenoised(c) && hasPrePass(c); }

bool hasStabilization(const Conditions& c) { return settingsOf(c).maxStabilizedFrameNum > 0; }

bool hasAntiFirefly(const Conditions& c) { return settingsOf(c).enableAntiFirefly; }
bool hasMaterialTest(const Conditions& c)
{
    const ReblurSettings s = settingsOf(c);
    return usesMaterials(c, s.minMaterialForDiffuse, s.minMaterialForSpecular);
}

constexpr SwitchRow kPrePassSwitch = {SPEC_HAS_PREPASS, hasPrePass};
constexpr SwitchRow kStabilization = {SPEC_HAS_STABILIZATION, hasStabilization, kStabilized};
constexpr SwitchRow kMaterialTest = {SPEC_HAS_MATERIAL_TEST, hasMaterialTest};
constexpr SwitchRow kAntiFirefly = {SPEC_HAS_ANTI_FIREFLY, hasAntiFirefly, kColor};

// Without a pre-pass, temporal accumulation sees to it.
bool isCappedLate(const Conditions& c) { return hasAntiFirefly(c) && !hasPrePass(c); }

// Signals go back and forth between two textures, since every pass but the first reads what another wrote around a
// pixel: the history, once temporal accumulation has read it, and one more, which is the output where that is lent.
// Occlusion, whose blur is its last pass, ends in the second one, and so the two change places from frame to frame.
constexpr Slot kSteps[] = {only(kStabilized, each(Work)), only(kOcclusion, each(Pair))};
constexpr Slot kHistories[] = {only(kStabilized, each(History)), only(kOcclusion, prevEach(Pair))};
// Without a pre-pass the input is accumulated as it came, and nobody wrote a tracking distance.
constexpr Slot kAccumulated[] = {only(kStabilized, choose(hasPrePass, each(Work), kEachInput)),
                                 only(kOcclusion, choose(hasPrePass, each(Pair), kEachInput))};
constexpr Slot kTrackNew = only(kSpecularColor, optional(hasPrePass, TrackNew));
// Without stabilisation nobody keeps this history up to date.
constexpr Slot kStab = only(kStabilized, optional(hasStabilization, Stab));
// The overlay shows the inputs even when nothing is denoised.
constexpr Slot kShownLength = optional(isDenoised, Length);
constexpr Slot kShownVirtualAmount = only(kSpecular, optional(isDenoised, VirtualAmount));

// From the first variant a pass applies to, to the last.
constexpr ShaderSet kClassifyTiles = {Shader::ReblurClassifyTilesDiffuse, Shader::ReblurClassifyTilesDiffuseSpecularSh};
constexpr ShaderSet kPrePass = {Shader::ReblurPrePassDiffuse, Shader::ReblurPrePassDiffuseDirectionalOcclusion};
constexpr ShaderSet kTemporalAccumulation = {Shader::ReblurTemporalAccumulationDiffuse,
                                             Shader::ReblurTemporalAccumulationDiffuseDirectionalOcclusion};
constexpr ShaderSet kHistoryFix = {Shader::ReblurHistoryFixDiffuse,
                                   Shader::ReblurHistoryFixDiffuseDirectionalOcclusion};
constexpr ShaderSet kBlur = {Shader::ReblurBlurDiffuse, Shader::ReblurBlurDiffuseDirectionalOcclusion};
constexpr ShaderSet kTemporalStabilization = {Shader::ReblurTemporalStabilizationDiffuse,
                                              Shader::ReblurTemporalStabilizationDiffuseDirectionalOcclusion};
constexpr ShaderSet kSplitScreen = {Shader::ReblurSplitScreenDiffuse,
                                    Shader::ReblurSplitScreenDiffuseDirectionalOcclusion};
constexpr ShaderSet kValidation = {Shader::ReblurValidationDiffuse,
                                   Shader::ReblurValidationDiffuseDirectionalOcclusion};

// name, shader per variant, reads, writes, group, runs if, switches. Outputs are written once, by the last pass.
constexpr PassRow kPasses[] = {
    {"Classify tiles",
     Shader::ClassifyTiles,
     {ViewZ, Motion, PrevDepth, prev(Cut)},
     {Tiles, Cut},
     kTile,
     isDenoised,
     {},
     1,
     kBounded},
    {"Classify tiles",
     kClassifyTiles,
     {ViewZ, Motion, PrevDepth, prev(Cut), kEachInput, prev(Spread), prev(NewSpread)},
     {Tiles, Cut, Cap, Spread, NewSpread},
     kTile,
     isDenoised,
     {kPrePassSwitch, kAntiFirefly},
     1,
     kColor},
    {"Pre-pass",
     kPrePass,
     {Tiles, ViewZ, NormalRoughness, kEachInput, only(kColor, optional(hasAntiFirefly, Cap)), only(kColor, Cut)},
     {kSteps[0], kSteps[1], only(kSpecularColor, TrackNew)},
     kGroup8x16,
     runsPrePass,
     {kAntiFirefly, kMaterialTest}},
    {"Temporal accumulation",
     kTemporalAccumulation,
     {Tiles,
      ViewZ,
      NormalRoughness,
      Motion,
      PrevDepth,
      PrevNormalRoughness,
      PrevLength,
      Cut,
      kThresholdMix,
      kDiffuseConfidence,
      kSpecularConfidence,
      kAccumulated[0],
      kAccumulated[1],
      kHistories[0],
      kHistories[1],
      Fast,
      kStab,
      kTrackNew,
      only(kSpecularOcclusion, ResourceType::IN_SPEC_HITDIST),
      only(kSpecularColor, prev(Track)),
      kSpecularMotion,
      only(kColor, optional(isCappedLate, Cap))},
     {prev(Cut), kSteps[0], kSteps[1], FastTemp, Length, only(kStabilized, StabHistory), only(kStabilized, StabWeight),
      only(kSpecularColor, Track), only(kSpecular, VirtualAmount)},
     kGroup8x16,
     isDenoised,
     {kPrePassSwitch, kStabilization, kMaterialTest, kConfidence, kReflectedMotion}},
    {"History fix",
     kHistoryFix,
     {Tiles, ViewZ, NormalRoughness, Length, kSteps[0], kSteps[1], FastTemp, only(kSpecularColor, Track)},
     {kHistories[0], kHistories[1], Fast, PrevDepth, PrevNormalRoughness},
     kGroup8x16,
     isDenoised,
     {kAntiFirefly, kMaterialTest}},
    {"Blur",
     kBlur,
     {ViewZ, NormalRoughness, Length, kHistories[0], kHistories[1]},
     {kSteps[0], kSteps[1], only(kStabilized, BlurLuma), only(kOcclusion, kEachOutput), only(kOcclusion, PrevLength)},
     kGroup8x16,
     isDenoised,
     {kMaterialTest}},
    {"Temporal stabilization",
     kTemporalStabilization,
     {Tiles, Length, StabHistory, StabWeight, BlurLuma, each(Work), only(kSpecular, NormalRoughness)},
     {kEachOutput, each(History), Stab, PrevLength},
     kGroup8x16,
     isDenoised,
     {kStabilization},
     1,
     kStabilized},
    {"Split screen", kSplitScreen, {ViewZ, kEachInput}, {kEachOutput}, kGroup16x16, isSplit},
    {"Validation",
     kValidation,
     {ViewZ, NormalRoughness, Motion, kShownLength, kShownVirtualAmount, kEachInput},
     {ResourceType::OUT_VALIDATION},
     kGroup16x16,
     hasValidation},
};

constexpr SignalRow kDiffuseHitDist = diffuse(Type::IN_DIFF_HITDIST, Type::OUT_DIFF_HITDIST, R16_UNORM);
constexpr SignalRow kSpecularHitDist = specular(Type::IN_SPEC_HITDIST, Type::OUT_SPEC_HITDIST, R16_UNORM);
constexpr SignalRow kDirection =
    lending(diffuse(Type::IN_DIFF_DIRECTION_HITDIST, Type::OUT_DIFF_DIRECTION_HITDIST, RGBA16_SNORM));

// The only place that knows which denoiser has which lobes and signals. In the order of the shader list.
constexpr Variant kVariants[] = {
    {Denoiser::REBLUR_DIFFUSE, kDiffuse, kRadiance, {kDiffuseRadiance}},
    {Denoiser::REBLUR_DIFFUSE_OCCLUSION, kDiffuse, kOcclusion, {kDiffuseHitDist}},
    {Denoiser::REBLUR_DIFFUSE_SH, kDiffuse, kSphericalHarmonics, {kDiffuseSh0, kDiffuseSh1}},
    {Denoiser::REBLUR_SPECULAR, kSpecular, kRadiance, {kSpecularRadiance}},
    {Denoiser::REBLUR_SPECULAR_OCCLUSION, kSpecular, kOcclusion, {kSpecularHitDist}},
    {Denoiser::REBLUR_SPECULAR_SH, kSpecular, kSphericalHarmonics, {kSpecularSh0, kSpecularSh1}},
    {Denoiser::REBLUR_DIFFUSE_SPECULAR, kBoth, kRadiance, {kDiffuseRadiance, kSpecularRadiance}},
    {Denoiser::REBLUR_DIFFUSE_SPECULAR_OCCLUSION, kBoth, kOcclusion, {kDiffuseHitDist, kSpecularHitDist}},
    {Denoiser::REBLUR_DIFFUSE_SPECULAR_SH,
     kBoth,
     kSphericalHarmonics,
     {kDiffuseSh0, kSpecularSh0, kDiffuseSh1, kSpecularSh1}},
    {Denoiser::REBLUR_DIFFUSE_DIRECTIONAL_OCCLUSION, kDiffuse, kDirectionalOcclusion, {kDirection}},
};
static_assert(shadersMatchVariants(kPasses, kVariants));
static_assert(sizeof(shared::DenoiserConstants) <= kConstantMaxByteSize);

void fillConstants(const Request& request, void* block)
{
    const shared::DenoiserConstants constants = makeReblurConstants(request);
    std::memcpy(block, &constants, sizeof(constants));
}

RequestHistory advance(const Request& request)
{
    RequestHistory next = request.history;
    const bool isDenoising = request.common.splitScreen < 1.0f;
    next.isValid = isDenoising;
    const ReblurSettings settings = effective(std::get<ReblurSettings>(request.settings));
    next.isStabilized = isDenoising && settings.maxStabilizedFrameNum > 0;
    next.splitScreen = request.common.splitScreen;
    return next;
}
} // namespace

const Family kReblur = {ReblurSettings{}, kVariants, kTextures, kPasses, sizeof(shared::DenoiserConstants), true,
                        fillConstants,    advance};
} // namespace nrd
