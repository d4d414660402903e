// Mean with the last frames. Motion vectors describe the receiver, not the shadow, so the past is bound to what the
// neighbourhood has now. Needs gIn_Past, gIn_PastColor; the neighbourhood in shared memory.
#ifndef STABILIZE_SHADOW_GLSL
#define STABILIZE_SHADOW_GLSL
#include "shadow_history.glsl"

const float kClampScale = 1.5; // standard deviations
const float kChangeNoise = 0.6; // over the deviation of single samples: of the mean over the window, in wide penumbrae
const float kForgotten = 2e-6; // rounding to the history's bits would keep less than that for ever
const float kChangeSensitivity = 5.0, kChangeTolerance = 0.1;

struct Moments
{
    Shadow mean;
    Shadow sigma;
};

// Differences to the mean: a variance from sums of squares has no digits left on flat walls.
Moments measureNeighbourhood()
{
    ivec2 local = ivec2(gl_LocalInvocationID.xy);
    Moments m = Moments(Shadow(0.0), Shadow(0.0));
    Shadow squares = Shadow(0.0);
    Shadow centre = sShadow[local.y + kRadius][local.x + kRadius];
    float weightSum = 0.0;
    for (int i = 0; i < 25; i++)
    {
        ivec2 offset = ivec2(i % 5, i / 5);
        float radius = sRadius[local.y + offset.y][local.x + offset.x];
        if (radius == kOutOfRange || isUnlit(radius)) continue;
        vec2 distance = vec2(offset - kRadius);
        float weight = exp2(-0.238 * dot(distance, distance));
        Shadow difference = sShadow[local.y + offset.y][local.x + offset.x] - centre;
        m.mean += difference * weight;
        squares += difference * difference * weight;
        weightSum += weight;
    }
    m.mean /= weightSum; // the centre counts at least
    m.sigma = sqrt(max(squares / weightSum - m.mean * m.mean, Shadow(0.0)));
    m.mean += centre;
    return m;
}

Past readPast(ivec2 pixel)
{
    uint colorWord = 0u;
#if HAS_TRANSLUCENCY
    colorWord = texelFetch(gIn_PastColor, pixel, 0).x;
#endif
    return unpackPast(texelFetch(gIn_Past, pixel, 0).x, colorWord);
}

shared float sPast[kHalo.y][kHalo.x]; // visibility; kOutOfRange: none

void loadPasts(ivec2 group)
{
    for (int i = int(gl_LocalInvocationIndex); i < kHalo.x * kHalo.y; i += 128)
    {
        ivec2 local = ivec2(i % kHalo.x, i / kHalo.x);
        ivec2 pixel = group + local - kRadius;
        bool isUsed = pixel == clampToRect(pixel) && sRadius[local.y][local.x] > 0.0;
        Past past = unpackPast(isUsed ? texelFetch(gIn_Past, pixel, 0).x : 0u, 0u);
        sPast[local.y][local.x] = past.n > 0.0 ? visibility(past.shadow) : kOutOfRange;
    }
}

// How much of the neighbourhood became lighter or darker. Noise, and what interpolation does to an edge that stays,
// cancel out in the mean; a shadow that moves does not.
float measureChange()
{
    ivec2 local = ivec2(gl_LocalInvocationID.xy);
    float sum = 0.0, weightSum = 0.0;
    for (int i = 0; i < 25; i++)
    {
        ivec2 at = local + ivec2(i % 5, i / 5);
        float past = sPast[at.y][at.x];
        if (past == kOutOfRange) continue;
        sum += visibility(sShadow[at.y][at.x]) - past;
        weightSum += 1.0;
    }
    return weightSum > 0.0 ? abs(sum) / weightSum : 0.0;
}

// How far the past may be trusted: not where the neighbourhood changed by more than the noise of a penumbra explains.
float measureAgreement(float mean, float radius)
{
    float noise = kChangeNoise * sqrt(saturate(mean * (1.0 - mean))) * softness(radius);
    return 1.0 - saturate((measureChange() - noise) * kChangeSensitivity - kChangeTolerance);
}

Past stabilize(ivec2 pixel, Shadow now, float radius)
{
    Past past = readPast(pixel);
    if (g.maxAccumulatedFrameNum.x == 0.0 || past.n == 0.0) return Past(now, 1.0);
    Moments m = measureNeighbourhood();
    Shadow reach = m.sigma * mix(kClampScale, 1.0, newSampleWeight(past.n));
    Shadow bound = clamp(past.shadow, m.mean - reach, m.mean + reach);
    float agreement = 1.0 - sqrt(saturate(abs(visibility(bound) - visibility(past.shadow))));
    agreement *= measureAgreement(visibility(m.mean), radius);
    float n = min(past.n, g.maxAccumulatedFrameNum.x) * agreement;
    // Flicker where penumbra meets full light and the deviation is tiny.
    float slack = 0.6 * agreement * n / (1.0 + n);
    Shadow history = mix(bound, past.shadow, slack * step(kForgotten, abs(past.shadow - bound)));
    return Past(mix(history, now, newSampleWeight(n)), n + 1.0);
}

#endif
