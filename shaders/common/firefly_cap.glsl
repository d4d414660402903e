// How bright a sample may be before it is taken for a firefly: far above what its tile and the neighbouring tiles
// showed lately. Their statistics count a firefly as bright as it was let through, so they grow with a signal whose
// energy comes from one sample in hundreds, but not with one in thousands.
// Whether the camera was cut is not known yet, so there are two of everything: with the last frames and without them.
// Needs gIn_PrevSpread, gIn_PrevNewSpread, gOut_Spread and gOut_NewSpread, one texel per tile: mean and deviation of
// luma per lobe; gIn_PrevCut; gOut_Cap: the caps of both lobes, with the last frames, then without; sIsUsed.
#ifndef FIREFLY_CAP_GLSL
#define FIREFLY_CAP_GLSL
#include "cut.glsl"

// Where one sample in N carries all energy, the deviation is sqrt(N) times the mean and the sample sqrt(N) times that:
// 48 follows light of one in 48^2. More, and chance makes the statistics grow with fireflies of one in 5000. Not less
// than 16, by which one of 256 values can deviate: the tile's own statistics never cap what they consist of.
const float kSpreadScale = 48.0;
// Where no pre-pass spreads what is let through before it is accumulated.
const float kLateSpreadScale = 24.0;
const float kSpreadFrameNum = 32.0;
const float kFewSamples = 8.0; // say nothing of what is normal
const float kNoCap = NRD_FP16_MAX; // as it is stored
// The share with which whatever is brighter counts in the statistics, or they would never leave black.
const float kCapGrowth = 1.0 / 256.0;

// Both lobes of a set of samples. The two largest are kept apart: there may be fireflies.
struct Samples
{
    vec2 count;
    vec2 sum;
    vec2 squares;
    vec2 largest;
    vec2 second; // at most as large
};

struct Spread
{
    vec2 mean;
    vec2 deviation;
};

const Spread kNoSpread = Spread(vec2(0.0), vec2(0.0));

const int kPartNum = 32; // invocations of a tile
shared Samples sParts[kPartNum];
shared vec2 sKnownCaps[9]; // of the tile and its neighbours, before this frame

const Samples kNoSamples = Samples(vec2(0.0), vec2(0.0), vec2(0.0), vec2(kNoLuma), vec2(kNoLuma));

void addToSums(inout Samples s, vec2 value)
{
    vec2 isUsed = vec2(greaterThanEqual(value, vec2(0.0)));
    s.count += isUsed;
    s.sum += value * isUsed;
    s.squares += value * value * isUsed;
}

void addSample(inout Samples s, vec2 value)
{
    addToSums(s, min(s.second, value));
    s.second = max(s.second, min(s.largest, value));
    s.largest = max(s.largest, value);
}

void addSamples(inout Samples s, Samples other)
{
    s.count += other.count;
    s.sum += other.sum;
    s.squares += other.squares;
    addSample(s, other.largest);
    addSample(s, other.second);
}

Spread spreadOf(Samples s)
{
    vec2 count = max(s.count, vec2(1.0)), mean = s.sum / count;
    return Spread(mean, sqrt(max(s.squares / count - mean * mean, vec2(0.0))));
}

// 0 where nothing is known, which is what sky and a new history hold.
Spread readSpread(ivec2 tile)
{
    if (g.isHistoryReset != 0u) return kNoSpread;
    ivec2 inside = clamp(tile, ivec2(0), g.rectSizeMinusOne / TILE_SIZE);
    bool wasCut = isCut(texelFetch(gIn_PrevCut, ivec2(0), 0).x);
    vec4 stored = wasCut ? texelFetch(gIn_PrevNewSpread, inside, 0) : texelFetch(gIn_PrevSpread, inside, 0);
    return Spread(stored.xy, stored.zw);
}

vec2 isKnown(Samples s) { return vec2(greaterThanEqual(s.count, vec2(kFewSamples))); }
vec2 capOf(Spread s) { return s.mean + (kHasPrepass ? kSpreadScale : kLateSpreadScale) * s.deviation; }

// Black so far; a tile full of black may cap what comes, one with hardly a pixel may not.
vec2 allowUnknown(Samples samples, vec2 cap)
{
    return mix(cap, vec2(kNoCap), (1.0 - isKnown(samples)) * vec2(equal(cap, vec2(0.0))));
}

// To be stored for the next frame.
vec4 mixSpread(Spread before, Samples samples, vec2 cap)
{
    Samples all = samples;
    addToSums(all, min(samples.largest, max(cap, samples.largest * kCapGrowth)));
    addToSums(all, min(samples.second, max(cap, samples.second * kCapGrowth)));
    Spread now = spreadOf(all);
    vec2 share = mix(vec2(1.0 / kSpreadFrameNum), vec2(1.0), equal(before.mean, vec2(0.0))) * isKnown(samples);
    vec2 mean = mix(before.mean, now.mean, share);
    vec2 variance = mix(before.deviation * before.deviation, now.deviation * now.deviation, share);
    return roundToHalf(vec4(mean, sqrt(variance)));
}

// By one invocation: what the frame itself says, or what was known before if that is more.
void storeCaps(ivec2 tile, Samples samples)
{
    vec2 own = isKnown(samples) * capOf(spreadOf(samples)), cap = own;
    for (int i = 0; i < 9; i++) cap = max(cap, sKnownCaps[i]);
    own = allowUnknown(samples, own);
    cap = allowUnknown(samples, cap);
    imageStore(gOut_Cap, tile, min(vec4(cap, own), vec4(kNoCap)));
    Spread before = kNoSpread; // what sky holds
    if (sIsUsed != 0u) before = readSpread(tile);
    imageStore(gOut_Spread, tile, mixSpread(before, samples, cap));
    imageStore(gOut_NewSpread, tile, mixSpread(kNoSpread, samples, own));
}

// part: what this invocation saw of the tile. Has barriers.
void findCaps(ivec2 tile, Samples part)
{
    int self = int(gl_LocalInvocationIndex);
    sParts[self] = part;
    if (self < 9) sKnownCaps[self] = capOf(readSpread(tile + ivec2(self % 3, self / 3) - 1));
    barrier();
    if (self < 8)
        for (int i = 8; i < kPartNum; i += 8) addSamples(sParts[self], sParts[self + i]);
    barrier();
    if (self > 0) return;
    for (int i = 1; i < 8; i++) addSamples(sParts[0], sParts[i]);
    storeCaps(tile, sParts[0]);
}

#endif
