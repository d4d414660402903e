// Bounds the long history's luma by statistics of the fast one, which is short and never blurred.
// Needs gIn_ViewZ, gIn_Fast and the signals before the filter.
#ifndef FAST_HISTORY_GLSL
#define FAST_HISTORY_GLSL
#include "variant.glsl"

// Of a lobe: the fast history, and what it differs from the long one by, which bounded signals have no use for.
#define CHANNELS_PER_LOBE (2 - IS_BOUNDED)
#define CHANNEL_NUM (LOBE_NUM * CHANNELS_PER_LOBE)
#include "luma_window.glsl"

const float kAntiFireflySigmaScale = 2.6;

void readLobe(inout Quad quad, int lobe, vec4 fast, texture2D slow, vec2 uv)
{
    quad.channels[lobe * CHANNELS_PER_LOBE] = fast;
#if IS_BOUNDED == 0
    quad.channels[lobe * CHANNELS_PER_LOBE + 1] = fast - gatherOrder(textureGather(sampler2D(slow, gNearestClamp), uv));
#endif
}

Quad readQuad(vec2 uv)
{
    Quad quad;
    vec4 first = gatherOrder(textureGather(sampler2D(gIn_Fast, gNearestClamp), uv, 0));
#if HAS_DIFFUSE
    readLobe(quad, 0, first, gIn_Diffuse, uv);
#endif
#if HAS_SPECULAR
    vec4 fast = first;
    if (LOBE_NUM == 2) fast = gatherOrder(textureGather(sampler2D(gIn_Fast, gNearestClamp), uv, 1));
    readLobe(quad, kSpecularChannel, fast, gIn_Specular, uv);
#endif
    return quad;
}

// The fast history of occlusion has 8 bits: what it rounded away is no disagreement.
const float kFastRounding = kIsBounded ? 0.5 / 255.0 : 0.0;

float clampTo(float value, Spread s, float scale)
{
    float reach = sigmaOf(s) * scale + kFastRounding;
    return clamp(value, s.mean - reach, s.mean + reach);
}

// The longer the history, the more the fast one bounds it; not at all where both are equally long.
float fastClamp(float luma, Spread s, float n, float sigmaScale)
{
    float isOn = g.maxFastAccumulatedFrameNum.x < g.maxAccumulatedFrameNum.x ? 1.0 : 0.0;
    return mix(clampTo(luma, s, sigmaScale), luma, 1.0 / (1.0 + 2.0 * n * isOn));
}

// How far the two histories differ by more than noise explains. Detail cancels out in means of differences.
float changeAmount(Spread change, float n)
{
    if (n < g.historyFixFrameNum || g.maxFastAccumulatedFrameNum.x >= g.maxAccumulatedFrameNum.x) return 0.0;
    float noise = 0.35 * g.antilagSigmaScale * sigmaOf(change) + kEps;
    return saturate(abs(change.mean) / noise - 1.0);
}

// Under light that has changed by so much of `before`: dimmed or raised as a whole, so that detail stays.
float relight(float luma, float before, float change)
{
    return change < 0.0 ? luma * max(1.0 + change / max(before, kEps), 0.0) : luma + change;
}

// A box round the fast history alone would let the long one follow only slowly. The fast one is as far behind the light
// as the long one is behind it: it goes on by a part of that, which damps the approach critically for six frames.
void followLight(inout float luma, inout float fast, Spread near, Spread change, float n)
{
    float moved = change.mean * changeAmount(change, n), before = near.mean - change.mean;
    luma = relight(luma, before, moved);
    fast = relight(fast, before + change.mean, 0.4 * moved);
}

// own: what the fast history of this pixel was loaded with. Returns what it becomes.
float boundSignal(inout Signal signal, Guide guide, int lobe, bool isSpecular, float n, float own, float share)
{
    int channel = lobe * CHANNELS_PER_LOBE;
    float Y = luma(signal), fast = mix(Y, own, share);
    Spread near = windowOf(channel), bounds = filled(near, kWindowSize, fast);
#if IS_BOUNDED == 0
    // A firefly's own blob must not widen the bounds.
    if (kHasAntiFirefly) Y = clampTo(Y, filled(ringOf(channel), kRingSize, fast), kAntiFireflySigmaScale);
    followLight(Y, fast, near, windowOf(channel + 1), n);
#endif
    bool isStrand = isSpecular && kHasMaterialTest && guide.materialID == g.strandMaterialID;
    float scale = isStrand ? max(g.fastClampSigmaScale, 3.0) : g.fastClampSigmaScale;
    signal = changeLuma(signal, fastClamp(Y, bounds, n, scale));
    return fast;
}

#endif
