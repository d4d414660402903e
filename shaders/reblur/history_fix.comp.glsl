// Fills pixels with a short history from a wide sparse neighbourhood, then bounds the long history's luma by statistics
// of the fast one, which is short and never blurred.
#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
#include "spatial_filter.glsl"

layout(local_size_x = 8, local_size_y = 16) in;
layout(set = SET_RESOURCES, binding = 0) uniform texture2D gIn_Tiles;
layout(set = SET_RESOURCES, binding = 1) uniform texture2D gIn_ViewZ;
layout(set = SET_RESOURCES, binding = 2) uniform texture2D gIn_NormalRoughness;
layout(set = SET_RESOURCES, binding = 3) uniform texture2D gIn_Length;
#define HAS_TRACK (HAS_SPECULAR * (1 - IS_BOUNDED))
#define FIRST_OUT (5 + SIGNAL_NUM + HAS_TRACK)
#if HAS_DIFFUSE
layout(set = SET_RESOURCES, binding = 4) uniform texture2D gIn_Diffuse;
layout(set = SET_RESOURCES, binding = FIRST_OUT) uniform writeonly image2D gOut_Diffuse;
#if IS_SH
layout(set = SET_RESOURCES, binding = 4 + LOBE_NUM) uniform texture2D gIn_DiffuseSh;
layout(set = SET_RESOURCES, binding = FIRST_OUT + LOBE_NUM) uniform writeonly image2D gOut_DiffuseSh;
#endif
#endif
#if HAS_SPECULAR
layout(set = SET_RESOURCES, binding = 3 + LOBE_NUM) uniform texture2D gIn_Specular;
layout(set = SET_RESOURCES, binding = FIRST_OUT + LOBE_NUM - 1) uniform writeonly image2D gOut_Specular;
#if IS_SH
layout(set = SET_RESOURCES, binding = 3 + 2 * LOBE_NUM) uniform texture2D gIn_SpecularSh;
layout(set = SET_RESOURCES, binding = FIRST_OUT + 2 * LOBE_NUM - 1) uniform writeonly image2D gOut_SpecularSh;
#endif
#if HAS_TRACK
layout(set = SET_RESOURCES, binding = 5 + SIGNAL_NUM) uniform texture2D gIn_Track;
#endif
#endif
layout(set = SET_RESOURCES, binding = 4 + SIGNAL_NUM) uniform texture2D gIn_Fast;
layout(set = SET_RESOURCES, binding = FIRST_OUT + SIGNAL_NUM) uniform writeonly image2D gOut_Fast;

const int kRadius = 4 - 2 * IS_BOUNDED; // of the widest window
const ivec2 kHalo = ivec2(8 + 2 * kRadius, 16 + 2 * kRadius);
const float kAntiFireflySigmaScale = 2.0;
const float kInvalid = -1.0; // lumas are not negative

// A group may hold only a small share of a multiprocessor's shared memory, or too few of them run side by side to hide
// latencies. So lumas are kept as the half floats they are stored as; both lobes in one word.
#if IS_BOUNDED
shared vec2 sFast[kHalo.y][kHalo.x];
vec2 fastAt(ivec2 at) { return sFast[at.y][at.x]; }
void storeFast(ivec2 at, vec2 lumas) { sFast[at.y][at.x] = lumas; }
#else
shared uint sFast[kHalo.y][kHalo.x];
shared uint sSlow[kHalo.y][kHalo.x];
vec2 fastAt(ivec2 at) { return unpackHalf2x16(sFast[at.y][at.x]); }
vec2 slowAt(ivec2 at) { return unpackHalf2x16(sSlow[at.y][at.x]); }
void storeFast(ivec2 at, vec2 lumas) { sFast[at.y][at.x] = packHalf2x16(lumas); }
void storeSlow(ivec2 at, vec2 lumas) { sSlow[at.y][at.x] = packHalf2x16(lumas); }
#endif

vec2 slowLumas(ivec2 pixel)
{
    vec2 lumas = vec2(0.0);
#if HAS_DIFFUSE
    lumas.x = texelFetch(gIn_Diffuse, pixel, 0).x;
#endif
#if HAS_SPECULAR
    lumas[kSpecularChannel] = texelFetch(gIn_Specular, pixel, 0).x;
#endif
    return lumas;
}

// Unrolled and without a branch, so that all reads are under way at once; the last texel is loaded repeatedly.
void loadFast(ivec2 group)
{
    const int kNum = kHalo.x * kHalo.y;
    [[unroll]] for (int first = 0; first < kNum; first += 128)
    {
        int i = min(first + int(gl_LocalInvocationIndex), kNum - 1);
        ivec2 local = ivec2(i % kHalo.x, i / kHalo.x);
        ivec2 pixel = group + local - kRadius;
        ivec2 inside = clampToRect(pixel);
        float viewZ = decodeViewZ(texelFetch(gIn_ViewZ, guideTexel(inside), 0).x);
        vec2 fast = texelFetch(gIn_Fast, inside, 0).xy;
        storeFast(local, pixel == inside && isInRange(viewZ) ? fast : vec2(kInvalid));
#if IS_BOUNDED == 0
        storeSlow(local, slowLumas(inside));
#endif
    }
}

struct Moments
{
    vec2 mean;
    vec2 sigma;
};

// Sums over valid texels.
struct Sums
{
    vec4 moments; // first, then second
    float count;
};

const Sums kNoSums = Sums(vec4(0.0), 0.0);

void addValid(inout Sums sums, vec2 value)
{
    sums.moments += vec4(value, value * value);
    sums.count += 1.0;
}

void add(inout Sums sums, vec2 value)
{
    if (value.x != kInvalid) addValid(sums, value);
}

void add(inout Sums sums, Sums other)
{
    sums.moments += other.moments;
    sums.count += other.count;
}

void addPair(inout Sums sums, ivec2 middle, int distance)
{
    add(sums, fastAt(middle - ivec2(distance, 0)));
    add(sums, fastAt(middle + ivec2(distance, 0)));
}

// Sums over pieces of a row: the inner five texels; of those, what the fast history differs from the slow one by; all
// nine without the inner three; all nine. The anti-firefly window is 9x9 without its inner 3x3, the others are 5x5; all
// are sums of such. Nothing is ever subtracted: beside a firefly that would leave only rounding error.
const int kInner = 0, kChange = 1, kOuter = 2, kAll = 3;
shared vec4 sMoments[kHalo.y][8];
shared float sCount[kHalo.y][8];

#if IS_BOUNDED == 0
void addChange(inout Sums sums, ivec2 at)
{
    vec2 fast = fastAt(at);
    if (fast.x != kInvalid) addValid(sums, fast - slowAt(at));
}
#endif

Sums sumRow(int piece, ivec2 middle)
{
    Sums sums = kNoSums;
#if IS_BOUNDED == 0
    if (piece == kChange)
        for (int x = -2; x <= 2; x++) addChange(sums, middle + ivec2(x, 0));
    if (piece == kOuter || piece == kAll)
        for (int x = 3; x <= 4; x++) addPair(sums, middle, x);
#endif
    if (piece == kChange) return sums;
    addPair(sums, middle, 2);
    if (piece == kOuter) return sums;
    addPair(sums, middle, 1);
    add(sums, fastAt(middle));
    return sums;
}

// Has barriers: one piece at a time takes the place of the one before.
void sumRows(int piece)
{
    barrier();
    for (int i = int(gl_LocalInvocationIndex); i < 8 * kHalo.y; i += 128)
    {
        ivec2 local = ivec2(i % 8, i / 8);
        Sums sums = sumRow(piece, local + ivec2(kRadius, 0));
        sMoments[local.y][local.x] = sums.moments;
        sCount[local.y][local.x] = sums.count;
    }
    barrier();
}

// Rows first to last, counted from the own one.
void addRows(inout Sums sums, int first, int last)
{
    ivec2 local = ivec2(gl_LocalInvocationID.xy) + ivec2(0, kRadius);
    for (int y = first; y <= last; y++)
        add(sums, Sums(sMoments[local.y + y][local.x], sCount[local.y + y][local.x]));
}

struct Windows
{
    Sums near;   // 5x5 without the centre
    Sums change; // 5x5
    Sums wide;   // 9x9 without its inner 3x3: a firefly's own blob must not widen the bounds
};

Windows sumWindows()
{
    ivec2 centre = ivec2(gl_LocalInvocationID.xy) + kRadius;
    Windows windows = Windows(kNoSums, kNoSums, kNoSums);
    sumRows(kInner);
    addPair(windows.near, centre, 1);
    addPair(windows.near, centre, 2);
    addRows(windows.near, -2, -1);
    addRows(windows.near, 1, 2);
#if IS_BOUNDED == 0
    sumRows(kChange);
    addRows(windows.change, -2, 2);
    if (!kHasAntiFirefly) return windows;
    sumRows(kOuter);
    addRows(windows.wide, -1, 1);
    sumRows(kAll);
    addRows(windows.wide, -4, -2);
    addRows(windows.wide, 2, 4);
#endif
    return windows;
}

// What is out of range counts as the centre.
Moments makeMoments(Sums sums, float count, vec2 centre)
{
    float missing = count - sums.count;
    vec2 mean = (sums.moments.xy + missing * centre) / count;
    vec2 square = (sums.moments.zw + missing * centre * centre) / count;
    return Moments(mean, sqrt(abs(square - mean * mean)));
}

// Which share of a pixel and its 2x2 partners needs the fix: a smaller stride where they are stable.
vec2 fixAmount(ivec2 position, vec2 n)
{
    vec2 own = vec2(lessThan(n, vec2(g.historyFixFrameNum)));
    vec2 sum = own;
    for (int i = 0; i < 2; i++)
    {
        ivec2 partner = clampToRect(position ^ ivec2(1 - i, i));
        if (!isInRange(decodeViewZ(texelFetch(gIn_ViewZ, guideTexel(partner), 0).x))) continue;
        sum += vec2(lessThan(unpackLengths(texelFetch(gIn_Length, partner, 0).xy), vec2(g.historyFixFrameNum)));
    }
    return min(own, sum * (1.0 / 3.0));
}

ivec2 mirrorPixel(ivec2 pixel)
{
    pixel = abs(pixel);
    return clampToRect(min(pixel, 2 * g.rectSizeMinusOne - pixel));
}

float fixTapWeight(Pixel p, Lobe lobe, bool isSpecular, ivec2 pixel, Weights w)
{
    float viewZ = decodeViewZ(texelFetch(gIn_ViewZ, guideTexel(pixel), 0).x);
    Guide guide = decodeGuide(texelFetch(gIn_NormalRoughness, guideTexel(pixel), 0));
    float weight = heavy(acosApprox(dot(p.guide.N, guide.N)) * w.normal);
    weight *= soft(planeDistance(p, vec2(pixel), viewZ));
    if (isSpecular) weight *= heavy(abs(square(guide.roughness) - square(p.guide.roughness)) * w.roughness);
    bool isUsed = isInRange(viewZ) && isSameMaterial(p.guide.materialID, guide.materialID, lobe.minMaterial);
    return isUsed ? weight : 0.0;
}

// 5x5 grid without corners and centre; taps that already have history count for more.
Signal fixHistory(texture2D t, texture2D second, Pixel p, Lobe lobe, bool isSpecular, ivec2 position, float n,
                  float amount, float tracking)
{
    Signal centre = readSignal(t, second, position);
    float alpha = newSampleWeight(n);
    float spread = NRD_GetLobeSpread(lobe.roughness, 0.25);
    float hitDist = getHitDist(centre.value.w, p.viewZ, lobe.roughness);
    // Tracking distance guides sharp lobes better, but as a minimum it is too small for rough ones.
    if (isSpecular && !kIsBounded) hitDist = mix(tracking, hitDist, spread);
    float reference = REBLUR_FrontEnd_GetNormHitDist(hitDist, p.viewZ, g.hitDistanceParameters.xyz, lobe.roughness);
    bool isAlternate = kHasMaterialTest && p.guide.materialID == g.historyFixAlternateMaterialID;
    float stride = 0.5 * amount * (isAlternate ? g.historyFixAlternateStride : g.historyFixStride);
    stride *= mix(0.25 + 0.75 * sqrt(hitDistFactor(hitDist, p.frustumSize)), 1.0, alpha);
    if (isSpecular) stride *= mix(0.25, 1.0, spread);
    int step = int(stride + 0.5);
    if (step == 0) return centre;

    Weights w = makeWeights(p, lobe, isSpecular, alpha, 1.0, 0.0);
    float m = square(lobe.roughness);
    w.roughness = 1.0 / mix(0.01, 1.0, mix(m * m, m, saturate(sqrt(g.roughnessFraction))));
    Signal sum = scaled(centre, 1.0 + n);
    float weightSum = 1.0 + n;
    int channel = isSpecular ? kSpecularChannel : 0;
    // Row by row, without a branch round a read, so that those of a row are under way at once.
    [[dont_unroll]] for (int y = -2; y <= 2; y++)
    [[unroll]] for (int x = -2; x <= 2; x++)
    {
        ivec2 offset = ivec2(x, y);
        bool isTap = x * x + y * y != 8 && offset != ivec2(0);
        ivec2 pixel = mirrorPixel(position + offset * step);
        float weight = fixTapWeight(p, lobe, isSpecular, pixel, w);
        Signal value = readSignal(t, second, pixel);
        weight *= heavy(abs(value.value.w - reference) * w.hitDist);
        weight *= isTap ? 1.0 + unpackLengths(texelFetch(gIn_Length, pixel, 0).xy)[channel] : 0.0;
        sum = addWeighted(sum, value, weight);
        weightSum += weight > 0.0 ? weight : 0.0; // not NaN
    }
    return scaled(sum, 1.0 / weightSum);
}

// The fast history of occlusion has 8 bits: what it rounded away is no disagreement.
const float kFastRounding = kIsBounded ? 0.5 / 255.0 : 0.0;

float clampTo(float value, Moments m, int lobe, float scale)
{
    float reach = m.sigma[lobe] * scale + kFastRounding;
    return clamp(value, m.mean[lobe] - reach, m.mean[lobe] + reach);
}

// The longer the history, the more the fast one bounds it; not at all where both are equally long.
float fastClamp(float luma, Moments m, int lobe, float n, float sigmaScale)
{
    float isOn = g.maxFastAccumulatedFrameNum.x < g.maxAccumulatedFrameNum.x ? 1.0 : 0.0;
    return mix(clampTo(luma, m, lobe, sigmaScale), luma, 1.0 / (1.0 + 2.0 * n * isOn));
}

// Of the long history, 5x5, and what the fast one differs from it by; only of pixels in range.
struct Change
{
    vec2 slow;
    vec2 mean;
    vec2 sigma;
};

Change measureChange(Windows windows, vec2 own)
{
    Sums change = windows.change;
    vec2 mean = change.moments.xy / change.count;
    vec2 fast = (windows.near.moments.xy + own) / change.count;
    return Change(fast - mean, mean, sqrt(max(change.moments.zw / change.count - mean * mean, vec2(0.0))));
}

// How far the two histories differ by more than noise explains. Detail cancels out in means of differences.
float changeAmount(int lobe, Change change, float n)
{
    if (n < g.historyFixFrameNum || g.maxFastAccumulatedFrameNum.x >= g.maxAccumulatedFrameNum.x) return 0.0;
    float noise = 0.45 * g.antilagSigmaScale * change.sigma[lobe] + kEps;
    return saturate(abs(change.mean[lobe]) / noise - 1.0);
}

// Under light that has changed by so much of `before`: dimmed or raised as a whole, so that detail stays.
float relight(float luma, float before, float change)
{
    return change < 0.0 ? luma * max(1.0 + change / max(before, kEps), 0.0) : luma + change;
}

// A box round the fast history alone would let the long one follow only slowly. The fast one is as far behind the light
// as the long one is behind it: it goes on by a part of that, which damps the approach critically for six frames.
void followLight(inout float luma, inout float fast, int lobe, Change change, float n)
{
    float moved = change.mean[lobe] * changeAmount(lobe, change, n), before = change.slow[lobe];
    luma = relight(luma, before, moved);
    fast = relight(fast, before + change.mean[lobe], 0.4 * moved);
}

// own: what the fast history of this pixel was loaded with. Returns what it becomes.
vec2 clampSignals(inout Signal signals[2], Pixel p, Windows windows, vec2 n, vec2 own, vec2 share)
{
    vec2 lumas = vec2(luma(signals[0]), luma(signals[1]));
    vec2 fast = mix(lumas, own, share);
    if (kHasAntiFirefly && !kIsBounded)
    {
        Moments wide = makeMoments(windows.wide, 72.0, fast);
        for (int i = 0; i < LOBE_NUM; i++) lumas[i] = clampTo(lumas[i], wide, i, kAntiFireflySigmaScale);
    }
    Change change = measureChange(windows, own);
    addValid(windows.near, fast); // with the value it has now, not the one that was loaded
    Moments near = makeMoments(windows.near, 25.0, fast);
    bool isStrand = kHasMaterialTest && p.guide.materialID == g.strandMaterialID;
    [[unroll]] for (int i = 0; i < LOBE_NUM; i++)
    {
        bool isSpecular = HAS_SPECULAR == 1 && i == kSpecularChannel;
        float scale = isStrand && isSpecular ? max(g.fastClampSigmaScale, 3.0) : g.fastClampSigmaScale;
        if (!kIsBounded) followLight(lumas[i], fast[i], i, change, n[i]);
        signals[i] = changeLuma(signals[i], fastClamp(lumas[i], near, i, n[i], scale));
    }
    return fast;
}

void main()
{
    ivec2 group = ivec2(gl_WorkGroupID.xy) * ivec2(8, 16);
    if (texelFetch(gIn_Tiles, group / TILE_SIZE, 0).x > 0.5) return; // the same for the whole group
    loadFast(group);
    Windows windows = sumWindows();
    ivec2 position = ivec2(gl_GlobalInvocationID.xy);
    if (!isInRect(position)) return;
    float viewZ = decodeViewZ(texelFetch(gIn_ViewZ, guideTexel(position), 0).x);
    if (!isInRange(viewZ)) return;
    Pixel p = makePixel(position, viewZ, decodeGuide(texelFetch(gIn_NormalRoughness, guideTexel(position), 0)));
    vec2 n = unpackLengths(texelFetch(gIn_Length, position, 0).xy);
    vec2 amount = fixAmount(position, n);
    vec2 share = clamp(n / max(g.historyFixFrameNum, 1e-3), 0.0, 1.0);
    Signal signals[2] = Signal[](kNoSignal, kNoSignal); // by channel
#if HAS_DIFFUSE
    Lobe diffuse = Lobe(1.0, g.minMaterialForDiffuse, 0.0);
    signals[0] = fixHistory(gIn_Diffuse, gIn_DiffuseSh, p, diffuse, false, position, n.x, amount.x, 0.0);
#endif
#if HAS_SPECULAR
    Lobe specular = Lobe(p.guide.roughness, g.minMaterialForSpecular, 0.0);
    float tracking = 0.0;
#if HAS_TRACK
    tracking = abs(texelFetch(gIn_Track, position, 0).x);
#endif
    signals[kSpecularChannel] = fixHistory(gIn_Specular, gIn_SpecularSh, p, specular, true, position,
                                           n[kSpecularChannel], amount[kSpecularChannel], tracking);
    // Filled-in data is unwanted in the fast history of sharp lobes.
    share[kSpecularChannel] = mix(1.0, share[kSpecularChannel], NRD_GetLobeSpread(p.guide.roughness, 0.25));
#endif
    vec2 own = fastAt(ivec2(gl_LocalInvocationID.xy) + kRadius);
    vec2 fast = clampSignals(signals, p, windows, n, own, share);
    imageStore(gOut_Fast, position, kIsBounded ? vec4(fast, 0.0, 0.0) : roundToHalf(vec4(fast, 0.0, 0.0)));
#if HAS_DIFFUSE
    storeSignal(gOut_Diffuse, gOut_DiffuseSh, position, signals[0]);
#endif
#if HAS_SPECULAR
    storeSignal(gOut_Specular, gOut_SpecularSh, position, signals[kSpecularChannel]);
#endif
}
