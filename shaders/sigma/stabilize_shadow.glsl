// Mean with the last frames. Motion vectors describe the receiver, not the shadow, so the past is bound to what the
// neighbourhood has now. Needs gIn_Past, gIn_PastColor; the neighbourhood in shared memory.
#ifndef STABILIZE_SHADOW_GLSL
#define STABILIZE_SHADOW_GLSL
#include "shadow_history.glsl"

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

Past stabilize(ivec2 pixel, Shadow now)
{
    Past past = readPast(pixel);
    if (g.maxAccumulatedFrameNum.x == 0.0 || past.n == 0.0) return Past(now, 1.0);
    Moments m = measureNeighbourhood();
    float share = 1.0 / (1.0 + past.n);
    Shadow reach = m.sigma * mix(g.sigmaClampScale, 1.0, share);
    Shadow bound = clamp(past.shadow, m.mean - reach, m.mean + reach);
    float agreement = 1.0 - sqrt(saturate(abs(visibility(bound) - visibility(past.shadow))));
    float n = min(past.n, g.maxAccumulatedFrameNum.x) * agreement;
    // Flicker where penumbra meets full light and the deviation is tiny.
    Shadow history = mix(bound, past.shadow, 0.6 * agreement * n / (1.0 + n));
    return Past(mix(history, now, newSampleWeight(n)), n + 1.0);
}

#endif
