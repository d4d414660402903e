// Mean with the last frames. Motion vectors describe the receiver, not the shadow, so the past is bound to what the
// neighbourhood has now. Needs gIn_Past, gIn_PastColor.
#ifndef STABILIZE_SHADOW_GLSL
#define STABILIZE_SHADOW_GLSL
#include "shadow_history.glsl"

const float kClampScale = 1.5; // standard deviations
const float kChangeNoise = 0.6; // over the deviation of single samples: of the mean over the window, in wide penumbrae
const float kForgotten = 2e-6; // rounding to the history's bits would keep less than that for ever
const float kChangeSensitivity = 5.0, kChangeTolerance = 0.1;

Past readPast(ivec2 pixel)
{
    uint colorWord = 0u;
#if HAS_TRANSLUCENCY
    colorWord = packUnorm4x8(texelFetch(gIn_PastColor, pixel, 0)); // the output, whose texels may be finer than bytes
#endif
    return unpackPast(texelFetch(gIn_Past, pixel, 0).x, colorWord);
}

// How far the past may be trusted: not where the mean of the neighbourhood changed by more than the noise of a penumbra
// explains. Noise, and what interpolation does to an edge that stays, cancel out in it; a shadow that moves does not.
float measureAgreement(Neighbourhood n, float radius)
{
    float mean = saturate(visibility(n.mean));
    float noise = kChangeNoise * sqrt(mean * (1.0 - mean)) * softness(radius);
    return 1.0 - saturate((n.change - noise) * kChangeSensitivity - kChangeTolerance);
}

Past stabilize(ivec2 pixel, ShadowSample now, Neighbourhood n)
{
    Past past = readPast(pixel);
    if (g.maxAccumulatedFrameNum.x == 0.0 || past.n == 0.0) return Past(now.shadow, 1.0);
    Shadow reach = n.sigma * mix(kClampScale, 1.0, newSampleWeight(past.n));
    Shadow bound = clamp(past.shadow, n.mean - reach, n.mean + reach);
    float agreement = 1.0 - sqrt(saturate(abs(visibility(bound) - visibility(past.shadow))));
    agreement *= measureAgreement(n, now.radius);
    float frames = min(past.n, g.maxAccumulatedFrameNum.x) * agreement;
    // Flicker where penumbra meets full light and the deviation is tiny.
    float slack = 0.6 * agreement * frames / (1.0 + frames);
    Shadow history = mix(bound, past.shadow, slack * step(kForgotten, abs(past.shadow - bound)));
    return Past(mix(history, now.shadow, newSampleWeight(frames)), frames + 1.0);
}

#endif
