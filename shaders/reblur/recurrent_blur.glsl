// Blur and post-blur: one routine, two parameter sets. Beside radiance, hit distances stay the centre's own: a blurred
// one would steer the next frame's weights with its own output and posterise contact shadows.
#ifndef RECURRENT_BLUR_GLSL
#define RECURRENT_BLUR_GLSL
#include "spatial_filter.glsl"

// Lighting edges that no guide shows survive where the history says that a difference is not noise: the admissible
// relative difference of luma shrinks with convergence. Fitted on the recorded sequences.
const float kLumaTolerance = 2.5;

float lumaWeight(float centre, float other, float narrowing)
{
    return heavy(abs(other - centre) / (max(other, centre) * kLumaTolerance * narrowing + kEps));
}

struct BlurPass
{
    vec4 rotator;
    float radiusScale;
    float fractionScale;
};

// Needs gIn_ViewZ and gIn_NormalRoughness.
Signal blurLobe(texture2D t, texture2D second, Pixel p, Lobe lobe, bool isSpecular, ivec2 position, float narrowing,
                BlurPass pass)
{
    Signal centre = readSignal(t, second, position);
    float spread = NRD_GetLobeSpread(lobe.roughness, 0.5);
    float factor = hitDistFactor(getHitDist(centre.value.w, p.viewZ, lobe.roughness), p.frustumSize);
    float radius = blurRadius(lobe, pass.radiusScale, factor, narrowing);
    if (radius == 0.0) return centre;
    // Where the hit distance is the signal, a floor that fades would leave nothing to average.
    float minHitDist = g.minHitDistanceWeight * pass.fractionScale * spread * (kIsBounded ? 1.0 : narrowing);
    Weights w = makeWeights(p, lobe, isSpecular, narrowing, pass.fractionScale, minHitDist);
    vec3 T, B;
    vec2 skew = diffuseSkew(p) * radius * g.rectSizeInv;
    if (isSpecular) specularKernel(p, factor, narrowing, radius, T, B);
    Signal sum = centre;
    float weightSum = 1.0;
    for (int i = 0; i < 8; i++)
    {
        vec2 offset = rotateTap(pass.rotator, kTaps[i].xy);
        vec2 uv = isSpecular ? viewToUv(p.Xv + T * offset.x + B * offset.y) : p.uv + offset * skew;
        Tap tap = readTap(gIn_ViewZ, gIn_NormalRoughness, p, lobe, w, uv, kTaps[i].z);
        Signal value = readSignal(t, second, tap.pixel);
        float weight = tap.weight * hitDistWeight(w, centre.value.w, value.value.w);
        // Occlusion is its own hit distance, whose weight is strict enough: with another it flickered more.
        if (!kIsBounded) weight *= lumaWeight(luma(centre), luma(value), narrowing);
        sum = addWeighted(sum, value, weight);
        weightSum += weight > 0.0 ? weight : 0.0; // not NaN
    }
    Signal result = scaled(sum, 1.0 / weightSum);
    if (!kIsBounded) result.value.w = centre.value.w;
    return result;
}

// The convergence of a pixel, drawn towards that of its 2x2 partners where they are more stable: single fresh pixels
// on edges would shimmer under a wide kernel.
vec2 adaptedConvergence(texture2D lengths, texture2D viewZs, ivec2 position)
{
    ivec2 quad[3] = ivec2[](position, clampToRect(ivec2(position.x ^ 1, position.y)),
                            clampToRect(ivec2(position.x, position.y ^ 1)));
    vec2 own = vec2(0.0), sum = vec2(0.0);
    for (int i = 0; i < 3; i++)
    {
        vec2 n = unpackLengths(texelFetch(lengths, quad[i], 0).xy);
        bool isUsed = isInRange(decodeViewZ(texelFetch(viewZs, guideTexel(quad[i]), 0).x));
        vec2 value = isUsed ? vec2(convergence(n.x), convergence(n.y)) : vec2(0.0);
        if (i == 0) own = value;
        sum += value;
    }
    return min(own, max(sum * (1.0 / 3.0), 1e-3)); // a divisor later on
}

#endif
