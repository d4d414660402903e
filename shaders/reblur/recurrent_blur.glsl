// Blur and post-blur: one routine, two parameter sets. Hit distances stay the centre's own: a blurred one would steer
// the next frame's weights with its own output and posterise contact shadows.
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

vec4 blurLobe(texture2D signal, texture2D viewZs, texture2D normals, Pixel p, Lobe lobe, bool isSpecular,
              ivec2 position, float narrowing, BlurPass pass)
{
    vec4 centre = texelFetch(signal, position, 0);
    float spread = NRD_GetLobeSpread(lobe.roughness, 0.5);
    float factor = hitDistFactor(getHitDist(centre.w, p.viewZ, lobe.roughness), p.frustumSize);
    float radius = blurRadius(lobe, pass.radiusScale, factor, narrowing);
    float minHitDist = g.minHitDistanceWeight * pass.fractionScale * spread * narrowing;
    Weights w = makeWeights(p, lobe, isSpecular, narrowing, pass.fractionScale, minHitDist);
    vec3 T, B;
    vec2 skew = diffuseSkew(p) * radius * g.rectSizeInv;
    if (isSpecular) specularKernel(p, factor, narrowing, radius, T, B);
    vec3 sum = centre.xyz;
    float weightSum = 1.0;
    for (int i = 0; i < 8; i++)
    {
        vec2 offset = rotateTap(pass.rotator, kTaps[i].xy);
        vec2 uv = isSpecular ? viewToUv(p.Xv + T * offset.x + B * offset.y) : p.uv + offset * skew;
        Tap tap = readTap(viewZs, normals, p, lobe, w, uv, kTaps[i].z);
        vec4 value = texelFetch(signal, tap.pixel, 0);
        float weight = tap.weight * hitDistWeight(w, centre.w, value.w);
        weight *= lumaWeight(centre.x, value.x, narrowing);
        // Selected, not multiplied: rejected taps may hold anything.
        sum += weight > 0.0 ? value.xyz * weight : vec3(0.0);
        weightSum += weight;
    }
    return roundToHalf(vec4(sum / weightSum, centre.w));
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
