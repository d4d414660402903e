// SIGMA: the shadow of one light, blurred as wide as its penumbra. Textures, passes, variants.
#include "sigma.h"
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
    Radius,
    Shadow,
    ShadowColor,
    Past,
    PastColor,
    History,
    HistoryColor
};

using enum Format;
using enum Lifetime;

constexpr Having kRemembered = Keeps::History;
constexpr Having kRememberedShadow = {Keeps::History, kShadow};
constexpr Having kRememberedColor = {Keeps::History, kTranslucentShadow};

// Key, name, format, lifetime, downsample factor, having. What packs several quantities says how in sigma.glsl.
constexpr TextureRow kTextures[] = {
    {Tiles, "Tiles", fixed(R8_UINT), Transient, TILE_SIZE},
    {Radius, "Radius", fixed(R8_UNORM), Transient},
    {Shadow, "Shadow", fixed(R16_SFLOAT), Transient, 1, kShadow},
    {ShadowColor, "Shadow", fixed(RGBA8_UNORM), Transient, 1, kTranslucentShadow},
    {Past, "Past", fixed(R16_UINT), Transient, 1, kRemembered},
    {PastColor, "PastColor", fixed(RGBA8_UNORM), Lent, 1, kRememberedColor}, // the four bytes of a word
    {History, "History", fixed(R32_UINT), Permanent, 1, kRememberedShadow},
    {HistoryColor, "History", fixed(RG32_UINT), Permanent, 1, kRememberedColor},
};
static_assert(rowsMatchKeys(kTextures));

bool isStabilized(const Conditions& c) { return std::get<SigmaSettings>(c.settings).maxStabilizedFrameNum > 0; }

constexpr Type kPenumbra = Type::IN_PENUMBRA;
constexpr Type kOut = Type::OUT_SHADOW_TRANSLUCENCY;
constexpr Slot kTranslucency = only(kTranslucentShadow, Type::IN_TRANSLUCENCY);
constexpr Slot kShadowIn = only(kShadow, Shadow), kShadowColorIn = only(kTranslucentShadow, ShadowColor);
constexpr Slot kHistory = only(kRememberedShadow, History), kHistoryColor = only(kRememberedColor, HistoryColor);
constexpr Slot kPast = only(kRemembered, Past), kPastColor = only(kRememberedColor, PastColor);

// From the first variant a pass applies to, to the last.
constexpr ShaderSet kBlur = {Shader::SigmaBlurShadow, Shader::SigmaBlurShadowTranslucencyMemoryless};
constexpr ShaderSet kPostBlur = {Shader::SigmaPostBlurShadow, Shader::SigmaPostBlurShadowTranslucencyMemoryless};

PassRow constexpr classify(Shader shader, Having having)
{
    PassRow row = {"Classify tiles", shader, {ViewZ, kPenumbra, kTranslucency}, {Tiles}, kTile, isDenoised};
    row.having = having;
    return row;
}

PassRow constexpr splitScreen(Shader shader, Having having)
{
    PassRow row = {"Split screen", shader, {ViewZ, kPenumbra, kTranslucency}, {kOut}, kGroup16x16, isSplit};
    row.having = having;
    return row;
}

// name, shader per variant, reads, writes, group, runs if. Outputs are written once, by the last pass.
constexpr PassRow kPasses[] = {
    classify(Shader::SigmaClassifyTilesShadow, kShadow),
    classify(Shader::SigmaClassifyTilesShadowTranslucency, kTranslucentShadow),
    {"Blur",
     kBlur,
     {Tiles, ViewZ, NormalRoughness, kPenumbra, kTranslucency, only(kRemembered, optional(isStabilized, Motion)),
      kHistory, kHistoryColor},
     {Radius, kShadowIn, kShadowColorIn, kPast, kPastColor},
     kGroup8x16,
     isDenoised},
    {"Post-blur",
     kPostBlur,
     {Tiles, ViewZ, NormalRoughness, Radius, kShadowIn, kShadowColorIn, kPast, kPastColor},
     {kOut, kHistory, kHistoryColor},
     kGroup8x16,
     isDenoised},
    splitScreen(Shader::SigmaSplitScreenShadow, kShadow),
    splitScreen(Shader::SigmaSplitScreenShadowTranslucency, kTranslucentShadow),
};

constexpr SignalRow kSignal = {kPenumbra, kOut, R16_SFLOAT, kNoLobe};
constexpr SignalRow kColorSignal = lending(kSignal);

// In the order of the shader list.
constexpr Variant kVariants[] = {
    {Denoiser::SIGMA_SHADOW, kNoLobe, kShadow, {kSignal}},
    {Denoiser::SIGMA_SHADOW_TRANSLUCENCY, kNoLobe, kTranslucentShadow, {kColorSignal}},
    {Denoiser::SIGMA_SHADOW, kNoLobe, kShadow, {kSignal}, Keeps::Nothing},
    {Denoiser::SIGMA_SHADOW_TRANSLUCENCY, kNoLobe, kTranslucentShadow, {kColorSignal}, Keeps::Nothing},
};
static_assert(shadersMatchVariants(kPasses, kVariants));

void fillConstants(const Request& request, void* block)
{
    const shared::DenoiserConstants constants = makeSigmaConstants(request);
    std::memcpy(block, &constants, sizeof(constants));
}

RequestHistory advance(const Request& request)
{
    RequestHistory next = request.history;
    next.isValid = request.common.splitScreen < 1.0f;
    return next;
}
} // namespace

const Family kSigma = {SigmaSettings{}, kVariants, kTextures, kPasses, sizeof(shared::DenoiserConstants), true,
                       fillConstants,   advance};
} // namespace nrd
