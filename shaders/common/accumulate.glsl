// Parts of temporal accumulation that both lobes use: the neighbourhood, reading of histories, limits on new samples.
#ifndef ACCUMULATE_GLSL
#define ACCUMULATE_GLSL
#if HAS_SPECULAR
#include "virtual_track.glsl"
#else
#include "surface_track.glsl"
#endif
#include "checkerboard.glsl"
#if HAS_CAP
#include "read_cap.glsl"
#endif

const ivec2 kHalo = ivec2(10, 18); // an 8x16 group and one texel round it

shared vec4 sNormalViewZ[kHalo.y][kHalo.x]; // viewZ: 0 = out of range
// Half floats: Y and Co, Cg of the input where no pre-pass ran, and the distance to what is reflected, 0 = unknown.
#define SAMPLE_NUM (HAS_CAP == 1 ? LOBE_NUM : 1) // occlusion has no colour
shared uvec2 sSamples[SAMPLE_NUM][kHalo.y][kHalo.x];
#if HAS_CAP
shared vec2 sCap; // how bright a sample may be, per lobe
#endif

const float kColorPlaneSensitivity = 0.02;
const float kColorMinCosine = 0.9;

#if HAS_SPECULAR
// World units, from the pre-pass. Occlusion always looks at the input, normalised: what is accumulated may be
// overwritten by other groups meanwhile.
float trackingCandidate(ivec2 pixel)
{
#if SIGNAL == 2
    bool isValid;
    if (!hasData(pixel, true)) return 0.0;
    return sanitize(texelFetch(gIn_SpecularHitDist, inputTexel(pixel), 0), isValid).w;
#else
    return texelFetch(gIn_TrackNew, pixel, 0).x;
#endif
}
#endif

uvec2 packSample(vec4 value) { return uvec2(packHalf2x16(value.xy), packHalf2x16(value.zw)); }

const vec4 kBadSample = vec4(-1.0, 0.0, 0.0, 0.0); // luma is not negative

vec4 readSample(texture2D t, ivec2 pixel)
{
    bool isValid;
    vec4 value = sanitize(texelFetch(t, pixel, 0), isValid);
    return isValid ? value : kBadSample;
}

// viewZ: 0 = out of range.
vec4 readNormalViewZ(ivec2 pixel, out bool isUsed)
{
    float viewZ = decodeViewZ(texelFetch(gIn_ViewZ, guideTexel(pixel), 0).x);
    isUsed = isInRange(viewZ);
    vec3 N = decodeGuide(texelFetch(gIn_NormalRoughness, guideTexel(pixel), 0)).N;
    return vec4(N, isUsed ? viewZ : 0.0);
}

// As it is kept for the neighbours. What is out of range was not written.
uvec2 readPacked(int channel, ivec2 pixel, bool isUsed)
{
    vec4 value = vec4(0.0);
#if HAS_DIFFUSE && HAS_CAP
    if (channel == 0 && !kHasPrepass) value = readSample(gIn_Diffuse, pixel);
#endif
#if HAS_SPECULAR
    if (channel == kSpecularChannel)
    {
        if (!kHasPrepass && !kIsBounded)
            value = readSample(gIn_Specular, pixel);
        else
            value.w = trackingCandidate(pixel);
    }
#endif
    return packSample(isUsed ? value : kBadSample);
}

// What is the same for the whole group, a tile or half of one.
void shareScalars(ivec2 group)
{
    shareHistoryReset();
#if HAS_CAP
    if (!kHasPrepass && g.isCapped != 0u) sCap = readTileCap(group / TILE_SIZE);
#endif
}

void loadNeighbourhood(ivec2 group)
{
    if (gl_LocalInvocationIndex == 0u) shareScalars(group);
    const int kNum = kHalo.x * kHalo.y;
    // Without a branch, so that all reads are under way at once; the last texel is loaded repeatedly.
    [[unroll]] for (int first = 0; first < kNum; first += 128)
    {
        int i = min(first + int(gl_LocalInvocationIndex), kNum - 1);
        ivec2 local = ivec2(i % kHalo.x, i / kHalo.x);
        ivec2 pixel = clampToRect(group + local - 1);
        bool isUsed;
        sNormalViewZ[local.y][local.x] = readNormalViewZ(pixel, isUsed);
        [[unroll]] for (int c = 0; c < SAMPLE_NUM; c++)
            sSamples[c][local.y][local.x] = readPacked(HAS_CAP == 1 ? c : kSpecularChannel, pixel, isUsed);
    }
}

// A processor suspends and resumes every invocation at a barrier: it is quicker to read again.
vec4 neighbour(ivec2 offset)
{
    bool isUsed;
    if (kIsSoftware) return readNormalViewZ(clampToRect(ivec2(gl_GlobalInvocationID.xy) + offset), isUsed);
    ivec2 local = ivec2(gl_LocalInvocationID.xy) + 1 + offset;
    return sNormalViewZ[local.y][local.x];
}

vec4 neighbourSample(int channel, ivec2 offset)
{
    ivec2 local = ivec2(gl_LocalInvocationID.xy) + 1 + offset;
    uvec2 stored = sSamples[channel * HAS_CAP][local.y][local.x];
    if (kIsSoftware)
    {
        ivec2 pixel = clampToRect(ivec2(gl_GlobalInvocationID.xy) + offset);
        bool isUsed;
        readNormalViewZ(pixel, isUsed);
        stored = readPacked(channel, pixel, isUsed);
    }
    return vec4(unpackHalf2x16(stored.x), unpackHalf2x16(stored.y));
}

vec3 meanNormal(vec3 own)
{
    return 0.25 * (neighbour(ivec2(-1, -1)).xyz + neighbour(ivec2(0, -1)).xyz + neighbour(ivec2(-1, 0)).xyz + own);
}

// RELAX, whose wavelet calms colour too, asks those beside and above by turns.
const int kNextNum = kIsRelax ? 2 : 4;

ivec2 nextPixel(int i)
{
    uint axis = kIsRelax ? g.frameIndex & 1u : uint(i >> 1);
    int side = 2 * (i & 1) - 1;
    return axis == 0u ? ivec2(side, 0) : ivec2(0, side);
}

// One bit for each of the next pixels that shows the same surface.
uint findLikeNeighbours(Surface s)
{
    uint bits = 0u;
    [[unroll]] for (int i = 0; i < kNextNum; i++)
    {
        vec4 other = neighbour(nextPixel(i));
        bool isLike = other.w > 0.0 && abs(other.w - s.viewZ) * s.NoV < kColorPlaneSensitivity * s.frustumSize &&
                      dot(other.xyz, s.guide.N) > kColorMinCosine;
        bits |= isLike ? 1u << i : 0u;
    }
    return bits;
}

Surface makeSurface(ivec2 pixel)
{
    Surface s;
    s.pixel = pixel;
    s.uv = pixelUv(pixel);
    vec4 own = neighbour(ivec2(0));
    s.viewZ = own.w;
    s.pixelSize = getPixelSize(s.viewZ);
    s.frustumSize = getFrustumSize(s.viewZ);
    s.X = rotate(g.viewToWorld, reconstructViewPosition(s.uv, g.frustum, s.viewZ, g.cameraDelta.w));
    s.V = viewDirection(s.X);
    s.guide = decodeGuide(texelFetch(gIn_NormalRoughness, guideTexel(pixel), 0));
    s.guide.N = own.xyz;
    s.NoV = abs(dot(s.guide.N, s.V));
    s.meanN = meanNormal(s.guide.N);
    s.likeNeighbours = kHasPrepass || kIsBounded ? 0u : findLikeNeighbours(s);
    float share = 0.0;
    if (g.hasDisocclusionMix != 0u) share = textureLod(sampler2D(gIn_DisocclusionMix, gLinearClamp), s.uv, 0.0).x;
    if (kHasMaterialTest && s.guide.materialID == g.strandMaterialID)
        share = saturate(0.5 * s.pixelSize / (g.strandThickness + kEps));
    s.disocclusionThreshold = mix(g.disocclusionThreshold, g.disocclusionThresholdAlternate, share);
    return s;
}

// Where and how a history is read.
struct HistoryRead
{
    vec2 position; // pixels of the previous frame
    ivec2 origin;
    vec4 weights;
    bool isCubic;
};

HistoryRead surfaceRead(SurfaceTrack track)
{
    vec2 position = clamp(track.uv, 0.0, 1.0) * g.rectSizePrev;
    return HistoryRead(position, track.footprint.origin, track.weights, track.isCubic);
}

struct History
{
    Signal signal;
    float fast;       // luma
    float stabilized; // luma
};

#if IS_STABILIZED
#define STABILIZED(read) (kHasStabilization ? read[channel] : 0.0)
#else
#define STABILIZED(read) 0.0
#endif

// Of the 2x2 texels of a footprint.
vec4 gatherLuma(texture2D t, ivec2 origin)
{
    vec2 uv = (vec2(origin) + 1.0) * g.resourceSizeInvPrev;
    if (kIsDirectional) return textureGather(sampler2D(t, gNearestClamp), uv, 3);
    return textureGather(sampler2D(t, gNearestClamp), uv);
}

// Catmull-Rom overshoots at an edge of light, with every frame more: where it leaves what the nearest texels hold, their
// mean stands in.
vec4 fetchSharp(texture2D t, HistoryRead read, CatmullRom c)
{
    vec4 value = fetchCatmullRom(t, gLinearClamp, c), near = gatherLuma(t, read.origin);
    float Y = luma(Signal(value, vec3(0.0)));
    float low = min(min(near.x, near.y), min(near.z, near.w)), high = max(max(near.x, near.y), max(near.z, near.w));
    if (Y >= low && Y <= high) return value;
    return textureLod(sampler2D(t, gLinearClamp), read.position * g.resourceSizeInvPrev, 0.0);
}

// All textures in one branch.
History fetchHistory(texture2D t, int channel, HistoryRead read)
{
    // Catmull-Rom keeps a moving history sharp; over invalid texels it would ring and leak.
    if (read.isCubic)
    {
        CatmullRom c = makeCatmullRom(read.position, g.resourceSizeInvPrev);
        vec2 uv = read.position * g.resourceSizeInvPrev;
        return History(Signal(fetchSharp(t, read, c), vec3(0.0)),
                       textureLod(sampler2D(gIn_Fast, gLinearClamp), uv, 0.0)[channel],
                       STABILIZED(fetchCatmullRom(gIn_Stab, gLinearClamp, c)));
    }
    return History(Signal(fetchBilinear(t, read.origin, read.weights, lastPrevTexel()), vec3(0.0)),
                   fetchBilinear(gIn_Fast, read.origin, read.weights, lastPrevTexel())[channel],
                   STABILIZED(fetchBilinear(gIn_Stab, read.origin, read.weights, lastPrevTexel())));
}

// After a cut it stands in for no broken sample either.
History readHistory(texture2D t, texture2D second, int channel, HistoryRead read)
{
    if (isHistoryReset()) return History(kNoSignal, 0.0, 0.0);
    History history = fetchHistory(t, channel, read);
    history.signal.value = clampNegatives(history.signal.value);
    history.stabilized = max(history.stabilized, 0.0);
    if (!kIsSh) return history;
    bool isFound = dot(read.weights, vec4(1.0)) >= 1e-4;
    vec3 axis = decodeAxis(fetchBilinear(second, read.origin, read.weights, lastPrevTexel()).xyz);
    history.signal.axis = isFound ? axis * history.signal.value.x : vec3(0.0);
    return history;
}

// How bright a sample may be, per lobe. The pre-pass has seen to that where it runs.
vec2 readCap(ivec2 pixel)
{
#if HAS_CAP
    if (!kHasPrepass && g.isCapped != 0u) return kIsSoftware ? readTileCap(pixel / TILE_SIZE) : sCap;
#endif
    return vec2(NRD_FP16_MAX);
}

// Colour and hit distance of a single sample are noise that no later pass calms as it does luma. So a sample keeps its
// luma and takes the others from its neighbourhood; for the colour brighter samples count for more. share: how much of
// that. One that is not finite is taken from there as a whole.
Signal calmSample(Surface s, Signal signal, int channel, float share, inout bool isValid)
{
    vec4 sum = signal.value; // 0 if it is not valid
    float count = isValid ? 1.0 : 0.0;
    [[unroll]] for (int i = 0; i < kNextNum; i++)
    {
        vec4 value = neighbourSample(channel, nextPixel(i));
        bool isNear = !isValid || (s.likeNeighbours & (1u << i)) != 0u; // anything is better than nothing
        float isLike = value.x >= 0.0 && isNear ? 1.0 : 0.0;
        sum += isLike * value;
        count += isLike;
    }
    if (!isValid && count > 0.0)
    {
        isValid = true;
        return Signal(sum / count, vec3(0.0));
    }
    vec2 color = signal.value.x * sum.yz / max(sum.x, NRD_LUMA_EPS); // black has none
    signal.value.yzw = mix(signal.value.yzw, vec3(color, sum.w / max(count, 1.0)), share);
    return signal;
}

// Read alone: the rest of the sample would take registers long before it is needed. 0 = unknown.
float readHitDist(texture2D t, int channel, ivec2 pixel)
{
    if (!kHasPrepass && !kIsBounded) return neighbourSample(channel, ivec2(0)).w;
    vec4 stored = texelFetch(t, pixel, 0);
    bool isValid;
    return kHasPrepass ? max(decodeValue(stored).w, 0.0) : sanitize(stored, isValid).w;
}

// Without a pre-pass.
Signal readOwnSample(texture2D t, texture2D second, ivec2 pixel, int channel, out bool isValid)
{
    // What the neighbours keep of it spares a conversion, but that takes longer than a read where both are short.
    if (!kIsRelax && !kIsSh) return readInput(t, second, pixel, isValid);
    vec4 value = neighbourSample(channel, ivec2(0));
    isValid = value.x >= 0.0;
    if (!isValid) value = vec4(0.0);
    return withInputAxis(value, second, pixel);
}

// The pre-pass has made sure that everything is finite.
Signal readAccumulated(texture2D t, texture2D second, Surface s, int channel, float calmShare, out bool isValid)
{
    if (!kHasPrepass)
    {
        Signal signal = readOwnSample(t, second, s.pixel, channel, isValid);
        if (!kIsBounded) signal = calmSample(s, signal, channel, calmShare, isValid);
        return capLuma(signal, readCap(s.pixel)[channel]);
    }
    Signal signal = readSignal(t, second, s.pixel);
    isValid = kIsBounded || signal.value.w >= 0.0;
    return signal;
}

// A pixel of a checkerboard without data was guessed from its neighbours and counts for less.
float dataShare(ivec2 pixel, bool isSpecular, float n)
{
    return hasData(pixel, isSpecular) ? 1.0 : mix(1.0 - g.checkerboardResolve, 1.0, newSampleWeight(n));
}

// How much a limit relative to the history counts: not at all without history.
float fireflyBlend(float n)
{
    float x = n * g.fireflyStrictness;
    return x / (1.0 + x);
}

float fireflyScale(float n) { return g.fireflyMinScale + g.fireflyHeadroom / (n + 1.0); }

Signal withoutVariance(Signal signal) { return Signal(vec4(signal.value.xyz, 0.0), signal.axis); }

Signal limitLuma(Signal mixed, Signal history, float n)
{
    float Y = luma(mixed);
    return changeLuma(mixed, mix(Y, min(Y, luma(history) * fireflyScale(n)), fireflyBlend(n)));
}

// RELAX: mean and variance of luma, the latter relative, so that no radiance overflows a half float.
Signal mixMoments(Signal history, Signal signal, float n, float weight)
{
    float before = luma(history), now = luma(signal);
    float variance = history.value.w * before * before;
    Signal mixed = mixSignals(history, signal, weight, weight);
    // Of a weighted mean of two groups; nothing large is subtracted.
    variance = (1.0 - weight) * (variance + weight * square(now - before));
    return limitLuma(withVariance(mixed, variance), history, n);
}

// Running mean up to the cap; share: of the new sample's weight. Hit distances react faster the more mirror-like the
// lobe: they steer weights and tracking.
Signal mixHistory(Signal history, Signal signal, float n, float share, float roughness)
{
    // Selected: mix() with weight 1 may round differently for different histories, and none may show after a cut.
    if (n == 0.0) return kIsRelax ? withoutVariance(signal) : signal;
    float weight = newSampleWeight(n) * share;
    float spread = NRD_GetLobeSpread(roughness, 0.25);
    float hitDistWeight = max(weight, share / (1.0 + 0.5 * spread * g.maxAccumulatedFrameNum.x));
    if (kIsBounded) return mixSignals(history, signal, weight, weight);
    if (kIsRelax) return mixMoments(history, signal, n, weight);
    Signal mixed = mixSignals(history, signal, weight, hitDistWeight);
    float blend = fireflyBlend(n);
    // An unknown distance in the history limits nothing.
    float maxHitDist = history.value.w > 0.0 ? history.value.w * (1.2 + 1.0 / (n + 1.0)) : 1.0;
    mixed.value.w = mix(mixed.value.w, min(mixed.value.w, maxHitDist), blend);
    return limitLuma(mixed, history, n);
}

// The short history that is never blurred.
float mixFast(float history, float signal, float weight)
{
    return weight == 1.0 ? signal : mix(history, signal, weight);
}

// Of the fast history: otherwise blotches travel over the picture during rotation at high frame rates. Of the sample
// that antilag moves towards: it may be a firefly.
float limitFast(float fast, float historyLuma, float n)
{
    return kIsBounded ? fast : mix(fast, min(fast, historyLuma * 4.0 * fireflyScale(n)), fireflyBlend(n));
}

#endif
