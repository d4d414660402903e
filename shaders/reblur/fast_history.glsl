// Bounds the long history's luma by statistics of the fast one, which is short and never blurred.
// Needs gIn_ViewZ, gIn_Fast and the signals before the filter.
#ifndef FAST_HISTORY_GLSL
#define FAST_HISTORY_GLSL
#include "spatial_filter.glsl"
#define PAIR_NUM (2 - IS_BOUNDED) // both lobes: fast; what it differs from the long history by
#include "luma_window.glsl"

const int kChange = PAIR_NUM - 1;
const float kAntiFireflySigmaScale = 2.6;

void readLumas(ivec2 pixel, out vec2 lumas[PAIR_NUM])
{
    lumas[0] = texelFetch(gIn_Fast, pixel, 0).xy;
    if (!kIsBounded) lumas[kChange] = lumas[0] - slowLumas(pixel);
}

// What is valid of a part of a window: five texels of a row, or one.
struct Part
{
    vec2 mean;
    vec2 squares; // sum, of differences from the mean
    float count;
};

// y: from the own row.
Part rowPart(int pair, int y)
{
    ivec2 at = ivec2(gl_LocalInvocationID.xy) + ivec2(0, kRadius + y);
    return Part(rowMean(pair, at), rowSquares(pair, at), rowCount(at));
}

Part texelPart(int x, int y)
{
    ivec2 at = ivec2(gl_LocalInvocationID.xy) + kRadius + ivec2(x, y);
    return Part(texelAt(0, at), vec2(0.0), isValidTexel(at) ? 1.0 : 0.0);
}

vec2 sumOf(Part part) { return part.count * part.mean; }

// Squares of parts add up with those of their means.
vec2 squaresAbout(vec2 mean, Part part)
{
    return part.squares + part.count * (part.mean - mean) * (part.mean - mean);
}

// centre: what texels that are out of range, or in no part, count as.
Spread measure(Part parts[8], float size, vec2 centre)
{
    vec2 sum = vec2(0.0), squares = vec2(0.0);
    float missing = size;
    [[unroll]] for (int i = 0; i < 8; i++)
    {
        sum += sumOf(parts[i]);
        missing -= parts[i].count;
    }
    vec2 mean = (sum + missing * centre) / size;
    [[unroll]] for (int i = 0; i < 8; i++) squares += squaresAbout(mean, parts[i]);
    return Spread(mean, sqrt((squares + missing * (centre - mean) * (centre - mean)) / size));
}

// 5x5, with the value that the centre has now, not the one that was loaded.
Spread measureNear(vec2 centre)
{
    return measure(Part[](rowPart(0, -2), rowPart(0, -1), texelPart(-2, 0), texelPart(-1, 0), texelPart(1, 0),
                          texelPart(2, 0), rowPart(0, 1), rowPart(0, 2)), 25.0, centre);
}

// Without the inner 3x3: a firefly's own blob must not widen the bounds.
Spread measureRing(vec2 centre)
{
    return measure(Part[](rowPart(0, -2), texelPart(-2, -1), texelPart(2, -1), texelPart(-2, 0), texelPart(2, 0),
                          texelPart(-2, 1), texelPart(2, 1), rowPart(0, 2)), 16.0, centre);
}

// The fast history of occlusion has 8 bits: what it rounded away is no disagreement.
const float kFastRounding = kIsBounded ? 0.5 / 255.0 : 0.0;

float clampTo(float value, Spread m, int lobe, float scale)
{
    float reach = m.sigma[lobe] * scale + kFastRounding;
    return clamp(value, m.mean[lobe] - reach, m.mean[lobe] + reach);
}

// The longer the history, the more the fast one bounds it; not at all where both are equally long.
float fastClamp(float luma, Spread m, int lobe, float n, float sigmaScale)
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

Change measureChange()
{
    Part parts[5];
    vec2 fast = vec2(0.0), mean = vec2(0.0), squares = vec2(0.0);
    float count = 0.0;
    [[unroll]] for (int y = 0; y < 5; y++)
    {
        parts[y] = rowPart(kChange, y - kRadius);
        mean += sumOf(parts[y]);
        fast += parts[y].count * rowMean(0, ivec2(gl_LocalInvocationID.xy) + ivec2(0, y));
        count += parts[y].count;
    }
    mean /= count; // the centre is in range
    [[unroll]] for (int y = 0; y < 5; y++) squares += squaresAbout(mean, parts[y]);
    return Change(fast / count - mean, mean, sqrt(squares / count));
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

// share: of the fast history as it was loaded. Returns what it becomes.
vec2 clampSignals(inout Signal signals[2], Pixel p, vec2 n, vec2 share)
{
    vec2 lumas = vec2(luma(signals[0]), luma(signals[1]));
    vec2 fast = mix(lumas, texelAt(0, ivec2(gl_LocalInvocationID.xy) + kRadius), share);
    if (kHasAntiFirefly && !kIsBounded)
    {
        Spread ring = measureRing(fast);
        for (int i = 0; i < LOBE_NUM; i++) lumas[i] = clampTo(lumas[i], ring, i, kAntiFireflySigmaScale);
    }
    Change change = Change(vec2(0.0), vec2(0.0), vec2(0.0));
    if (!kIsBounded) change = measureChange();
    Spread near = measureNear(fast);
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
