// RELAX: variance-guided wavelet over an accumulated signal. Textures, passes, variants; the constants are next door.
#include "relax.h"
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
    Confidence,
    VirtualAmount,
    Scratch,
    Pong,
    PrevDepth,
    PrevNormalRoughness,
    PrevLength,
    History,
    Fast,
    Spread,
    NewSpread,
    Track
};

using enum Format;
using enum Lifetime;

constexpr TextureRow kTextures[] = {
    {Tiles, "Tiles", fixed(R8_UNORM), Transient, TILE_SIZE},
    {Cut, "Cut", fixed(R32_UINT), PingPong, kOneTexel}, // a sum of votes
    {Cap, "Cap", fixed(RGBA16_SFLOAT), Transient, TILE_SIZE},
    {Length, "Length", perLobes(R8_UNORM, RG8_UNORM), Transient},
    {FastTemp, "FastTemp", perLobes(RG16_SFLOAT, RGBA16_SFLOAT), Transient}, // with the luma of the new sample
    {TrackNew, "TrackNew", fixed(R16_SFLOAT), Lent, 1, kSpecular},           // until the wavelet runs
    {Confidence, "Confidence", fixed(R8_UNORM), Transient, 1, kSpecular},    // in the reprojection
    {VirtualAmount, "VirtualAmount", fixed(R8_UNORM), Transient, VIRTUAL_AMOUNT_STEP, kSpecular},
    {Scratch, "Scratch", kPerSignal, Transient},
    {Pong, "Pong", kPerSignal, Lent},
    {PrevDepth, "PrevDepth", fixed(R16_UNORM), Permanent},
    {PrevNormalRoughness, "PrevNormalRoughness", kPrevGuide, Permanent},
    {PrevLength, "PrevLength", perLobes(R8_UINT, R16_UINT), Permanent},
    {History, "History", kPerSignal, Permanent},
    {Fast, "Fast", perLobes(R16_SFLOAT, RG16_SFLOAT), Permanent},
    {Spread, "Spread", fixed(RGBA16_SFLOAT), PingPong, TILE_SIZE},       // of the samples' luma: mean, deviation
    {NewSpread, "NewSpread", fixed(RGBA16_SFLOAT), PingPong, TILE_SIZE}, // without the past
    {Track, "Track", fixed(R16_SFLOAT), PingPong, 1, kSpecular},
};
static_assert(rowsMatchKeys(kTextures));

const RelaxSettings& settingsOf(const Conditions& c) { return std::get<RelaxSettings>(c.settings); }

bool hasPrePass(const Conditions& c)
{
    const RelaxSettings& s = settingsOf(c);
    return isIncomplete(s) || (isBlurred(c, s) && isPrefiltered(s));
}
bool runsPrePass(const Conditions& c) { return isDenoised(c) && hasPrePass(c); }
bool hasAntiFirefly(const Conditions& c) { return settingsOf(c).enableAntiFirefly; }

bool isCappedLate(const Conditions& c) { return hasAntiFirefly(c) && !hasPrePass(c); }

bool hasMaterialTest(const Conditions& c)
{
    return usesMaterials(c, settingsOf(c).minMaterialForDiffuse, settingsOf(c).minMaterialForSpecular);
}

template <uint32_t Step> bool runsStep(const Conditions& c)
{
    return isDenoised(c) && settingsOf(c).atrousIterationNum > Step;
}
template <uint32_t Step> bool isLastStep(const Conditions& c) { return settingsOf(c).atrousIterationNum == Step + 1; }
// The last step writes the output, so the one before it must not: Pong may lie there.
template <uint32_t Step> bool writesScratch(const Conditions& c)
{
    return (settingsOf(c).atrousIterationNum - Step) % 2 == 0;
}

constexpr SwitchRow kPrePassSwitch = {SPEC_HAS_PREPASS, hasPrePass};
constexpr SwitchRow kMaterialTest = {SPEC_HAS_MATERIAL_TEST, hasMaterialTest};
constexpr SwitchRow kAntiFirefly = {SPEC_HAS_ANTI_FIREFLY, hasAntiFirefly};

constexpr Slot kEachAccumulated = choose(hasPrePass, each(Scratch), kEachInput);
constexpr Slot kTrackNew = only(kSpecular, optional(hasPrePass, TrackNew));
// The overlay shows the inputs even when nothing is denoised.
constexpr Slot kShownLength = optional(isDenoised, Length);
constexpr Slot kShownVirtualAmount = only(kSpecular, optional(isDenoised, VirtualAmount));

// From the first variant a pass applies to, to the last.
constexpr ShaderSet kClassifyTiles = {Shader::RelaxClassifyTilesDiffuse, Shader::RelaxClassifyTilesDiffuseSpecularSh};
constexpr ShaderSet kPrePass = {Shader::RelaxPrePassDiffuse, Shader::RelaxPrePassDiffuseSpecularSh};
constexpr ShaderSet kTemporalAccumulation = {Shader::RelaxTemporalAccumulationDiffuse,
                                             Shader::RelaxTemporalAccumulationDiffuseSpecularSh};
constexpr ShaderSet kHistoryClamping = {Shader::RelaxHistoryClampingDiffuse,
                                        Shader::RelaxHistoryClampingDiffuseSpecularSh};
constexpr ShaderSet kAtrous = {Shader::RelaxAtrousDiffuse, Shader::RelaxAtrousDiffuseSpecularSh};
constexpr ShaderSet kSplitScreen = {Shader::RelaxSplitScreenDiffuse, Shader::RelaxSplitScreenDiffuseSpecularSh};
constexpr ShaderSet kValidation = {Shader::RelaxValidationDiffuse, Shader::RelaxValidationDiffuseSpecularSh};

// Steps take turns between two textures; the first reads the history, the last writes the outputs.
template <uint32_t Step> constexpr PassRow atrous(const char* name)
{
    constexpr Slot kFrom = Step == 0 ? Slot(each(History)) : choose(writesScratch<Step>, each(Pong), each(Scratch));
    constexpr Slot kTo = choose(isLastStep<Step>, kEachOutput, choose(writesScratch<Step>, each(Scratch), each(Pong)));
    PassRow row = {name,
                   kAtrous,
                   {Tiles, ViewZ, NormalRoughness, Length, kDiffuseConfidence, kSpecularConfidence,
                    only(kSpecular, Confidence), kFrom},
                   {kTo},
                   kGroup8x16,
                   runsStep<Step>,
                   {kMaterialTest, kConfidence, {SPEC_IS_LAST, isLastStep<Step>}}};
    row.step = Step;
    return row;
}

// name, shader per variant, reads, writes, group, runs if, switches. Outputs are written once, by the last pass.
constexpr PassRow kPasses[] = {
    {"Classify tiles",
     kClassifyTiles,
     {ViewZ, Motion, PrevDepth, prev(Cut), kEachInput, prev(Spread), prev(NewSpread)},
     {Tiles, Cut, Cap, Spread, NewSpread},
     kTile,
     isDenoised,
     {kPrePassSwitch, kAntiFirefly}},
    {"Pre-pass",
     kPrePass,
     {Tiles, ViewZ, NormalRoughness, kEachInput, optional(hasAntiFirefly, Cap), Cut},
     {each(Scratch), only(kSpecular, TrackNew)},
     kGroup8x16,
     runsPrePass,
     {kAntiFirefly, kMaterialTest}},
    {"Temporal accumulation",
     kTemporalAccumulation,
     {Tiles, ViewZ, NormalRoughness, Motion, PrevDepth, PrevNormalRoughness, PrevLength, Cut, kThresholdMix,
      kDiffuseConfidence, kSpecularConfidence, kEachAccumulated, each(History), Fast, kTrackNew,
      only(kSpecular, prev(Track)), kSpecularMotion, optional(isCappedLate, Cap)},
     {prev(Cut), each(Scratch), FastTemp, Length, only(kSpecular, Track), only(kSpecular, VirtualAmount),
      only(kSpecular, Confidence)},
     kGroup8x16,
     isDenoised,
     {kPrePassSwitch, kMaterialTest, kConfidence, kReflectedMotion}},
    {"History clamping",
     kHistoryClamping,
     {Tiles, ViewZ, NormalRoughness, Length, each(Scratch), FastTemp},
     {each(History), Fast, PrevLength, PrevDepth, PrevNormalRoughness},
     kGroup8x16,
     isDenoised,
     {kAntiFirefly, kMaterialTest}},
    atrous<0>("A-trous 1"),
    atrous<1>("A-trous 2"),
    atrous<2>("A-trous 3"),
    atrous<3>("A-trous 4"),
    atrous<4>("A-trous 5"),
    atrous<5>("A-trous 6"),
    atrous<6>("A-trous 7"),
    atrous<7>("A-trous 8"),
    {"Split screen", kSplitScreen, {ViewZ, kEachInput}, {kEachOutput}, kGroup16x16, isSplit},
    {"Validation",
     kValidation,
     {ViewZ, NormalRoughness, Motion, kShownLength, kShownVirtualAmount, kEachInput},
     {ResourceType::OUT_VALIDATION},
     kGroup16x16,
     hasValidation},
};

// The only place that knows which denoiser has which lobes and signals. In the order of the shader list.
constexpr Variant kVariants[] = {
    {Denoiser::RELAX_DIFFUSE, kDiffuse, kRadiance, {kDiffuseRadiance}},
    {Denoiser::RELAX_DIFFUSE_SH, kDiffuse, kSphericalHarmonics, {kDiffuseSh0, kDiffuseSh1}},
    {Denoiser::RELAX_SPECULAR, kSpecular, kRadiance, {kSpecularRadiance}},
    {Denoiser::RELAX_SPECULAR_SH, kSpecular, kSphericalHarmonics, {kSpecularSh0, kSpecularSh1}},
    {Denoiser::RELAX_DIFFUSE_SPECULAR, kBoth, kRadiance, {kDiffuseRadiance, kSpecularRadiance}},
    {Denoiser::RELAX_DIFFUSE_SPECULAR_SH,
     kBoth,
     kSphericalHarmonics,
     {kDiffuseSh0, kSpecularSh0, kDiffuseSh1, kSpecularSh1}},
};
static_assert(shadersMatchVariants(kPasses, kVariants));

void fillConstants(const Request& request, void* block)
{
    const shared::DenoiserConstants constants = makeRelaxConstants(request);
    std::memcpy(block, &constants, sizeof(constants));
}

RequestHistory advance(const Request& request)
{
    RequestHistory next = request.history;
    next.isValid = request.common.splitScreen < 1.0f;
    next.splitScreen = request.common.splitScreen;
    return next;
}
} // namespace

const Family kRelax = {RelaxSettings{}, kVariants, kTextures, kPasses, sizeof(shared::DenoiserConstants), true,
                       fillConstants,   advance};
} // namespace nrd
