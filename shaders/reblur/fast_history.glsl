// Bounds the long history's luma by statistics of the fast one, which is short and never blurred.
// Needs gIn_ViewZ, gIn_Fast and the signals before the filter.
#ifndef FAST_HISTORY_GLSL
#define FAST_HISTORY_GLSL
#include "spatial_filter.glsl"
#include "luma_window.glsl"

const float kAntiFireflySigmaScale = 2.6;

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

// Sums over five texels of a row: of the fast history, or of what it differs from the slow one by. All windows are 5x5.
// Nothing is ever subtracted: beside a firefly that would leave only rounding error.
const int kFastRow = 0, kChangeRow = 1;
shared vec4 sMoments[kHalo.y][8];
shared float sCount[kHalo.y][8];

Sums sumRow(int kind, ivec2 middle)
{
    Sums sums = kNoSums;
    for (int x = -2; x <= 2; x++)
    {
        vec2 fast = fastAt(middle + ivec2(x, 0)), value = fast;
#if IS_BOUNDED == 0
        if (kind == kChangeRow) value -= slowAt(middle + ivec2(x, 0));
#endif
        if (fast.x != kInvalid) addValid(sums, value);
    }
    return sums;
}

// Has barriers: one kind takes the place of the other. A processor suspends and resumes every invocation at each, so
// there every pixel sums up its rows itself.
void sumRows(int kind)
{
    if (kIsSoftware) return;
    barrier();
    for (int i = int(gl_LocalInvocationIndex); i < 8 * kHalo.y; i += 128)
    {
        ivec2 local = ivec2(i % 8, i / 8);
        Sums sums = sumRow(kind, local + ivec2(kRadius, 0));
        sMoments[local.y][local.x] = sums.moments;
        sCount[local.y][local.x] = sums.count;
    }
    barrier();
}

// Rows first to last, counted from the own one.
void addRows(inout Sums sums, int kind, int first, int last)
{
    ivec2 local = ivec2(gl_LocalInvocationID.xy) + ivec2(0, kRadius);
    for (int y = first; y <= last; y++)
    {
        if (kIsSoftware)
            add(sums, sumRow(kind, local + ivec2(kRadius, y)));
        else
            add(sums, Sums(sMoments[local.y + y][local.x], sCount[local.y + y][local.x]));
    }
}

struct Windows
{
    Sums near;   // without the centre
    Sums ring;   // without the inner 3x3: a firefly's own blob must not widen the bounds
    Sums change;
};

Windows sumWindows()
{
    ivec2 centre = ivec2(gl_LocalInvocationID.xy) + kRadius;
    Windows windows = Windows(kNoSums, kNoSums, kNoSums);
    if (kIsSoftware) barrier();
    sumRows(kFastRow);
    addRows(windows.ring, kFastRow, -2, -2);
    addRows(windows.ring, kFastRow, 2, 2);
    for (int y = -1; y <= 1; y++) addPair(windows.ring, centre + ivec2(0, y), 2);
    windows.near = windows.ring;
    for (int y = -1; y <= 1; y++) addPair(windows.near, centre + ivec2(0, y), 1);
    add(windows.near, fastAt(centre - ivec2(0, 1)));
    add(windows.near, fastAt(centre + ivec2(0, 1)));
#if IS_BOUNDED == 0
    sumRows(kChangeRow);
    addRows(windows.change, kChangeRow, -2, 2);
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
        Moments ring = makeMoments(windows.ring, 16.0, fast);
        for (int i = 0; i < LOBE_NUM; i++) lumas[i] = clampTo(lumas[i], ring, i, kAntiFireflySigmaScale);
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

#endif
