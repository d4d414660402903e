// History confidence: what has changed about last frame's samples that were traced again, averaged over their
// neighbourhood. No denoiser; after the temporal gradients of Schied, Peters and Dachsbacher 2018, "Gradient Estimation
// for Real-Time Adaptive Temporal Filtering".
#include "confidence.h"
#include "families.h"
#include "frame_state.h"
#include <cstring>

namespace nrd
{
namespace
{
enum Tex : uint8_t
{
    Gradient,
    TempGradient
};

constexpr TextureRow kTextures[] = {
    {Gradient, "Gradient", fixed(Format::RGBA16_SFLOAT), Lifetime::Transient},
    {TempGradient, "TempGradient", fixed(Format::RGBA16_SFLOAT), Lifetime::Transient},
};
static_assert(rowsMatchKeys(kTextures));

constexpr ResourceType StoredSample = ResourceType::IN_STORED_SAMPLE;
constexpr ResourceType RetracedSample = ResourceType::IN_RETRACED_SAMPLE;
constexpr ResourceType StoredGuide = ResourceType::IN_STORED_NORMAL_ROUGHNESS;

uint32_t blurNum(const Conditions& c) { return std::get<ConfidenceSettings>(c.settings).blurPassNum; }
bool always(const Conditions&) { return true; }
template <uint32_t Num> bool blurs(const Conditions& c) { return blurNum(c) >= Num; }
bool endsInTemp(const Conditions& c) { return (blurNum(c) & 1) != 0; }

constexpr GroupSize kGroup8x8 = {8, 8};

template <uint32_t Num> constexpr PassRow blur(Tex from, Tex to)
{
    PassRow row = {
        "Blur", Shader::ConfidenceBlur, {from, StoredSample, StoredGuide}, {to}, kGroup8x8, blurs<Num>, {}, 1, {}, Num};
    return row;
}

constexpr PassRow kPasses[] = {
    {"Gradient", Shader::ConfidenceGradient, {StoredSample, RetracedSample}, {Gradient}, kGroup8x8, always},
    blur<1>(Gradient, TempGradient),
    blur<2>(TempGradient, Gradient),
    blur<3>(Gradient, TempGradient),
    blur<4>(TempGradient, Gradient),
    blur<5>(Gradient, TempGradient),
    {"Confidence",
     Shader::ConfidenceResult,
     {choose(endsInTemp, TempGradient, Gradient)},
     {ResourceType::IN_DIFF_CONFIDENCE, ResourceType::IN_SPEC_CONFIDENCE},
     kGroup8x8,
     always},
};

constexpr Variant kVariants[] = {
    {Denoiser::MAX_NUM, kBoth, kRadiance, {}, Keeps::Nothing},
};
static_assert(shadersMatchVariants(kPasses, kVariants));

void fillConstants(const Request& request, void* block)
{
    const shared::ConfidenceConstants constants = makeConfidenceConstants(request);
    std::memcpy(block, &constants, sizeof(constants));
}

RequestHistory advance(const Request& request)
{
    RequestHistory next = request.history;
    next.isValid = true;
    return next;
}
} // namespace

shared::ConfidenceConstants makeConfidenceConstants(const Request& request)
{
    const CommonSettings& common = request.common; // in tiles
    const ConfidenceSettings& settings = std::get<ConfidenceSettings>(request.settings);
    shared::ConfidenceConstants g = {};
    g.viewToWorldPrev = request.frame.viewToWorldPrev;
    g.frustumPrev = request.frame.frustumPrev;
    g.rectSizePrev = {static_cast<float>(common.rectSizePrev[0]), static_cast<float>(common.rectSizePrev[1])};
    g.outputSizeInv = {1.0f / common.resourceSize[0], 1.0f / common.resourceSize[1]};
    g.isOrthographic = request.frame.cameraDelta.w;
    g.planeDistance = settings.planeDistanceSensitivity * request.frame.unproject * request.frame.minRectDim;
    g.denoisingRange = common.denoisingRange;
    g.viewZScale = common.viewZScale;
    g.minLuminance = settings.minLuminance;
    g.maxLuminance = settings.maxLuminance;
    g.tolerance = settings.tolerance;
    g.sensitivity = settings.sensitivity;
    g.isHistoryReset = request.isReset ? 1 : 0;
    return g;
}

const Family kHistoryConfidence = {
    ConfidenceSettings{}, kVariants, kTextures, kPasses, sizeof(shared::ConfidenceConstants), false,
    fillConstants,        advance,   true};
} // namespace nrd
