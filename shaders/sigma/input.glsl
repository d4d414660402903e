// The noisy input as the passes compute with it. Needs gIn_Penumbra, gIn_Translucency, gIn_ViewZ.
#ifndef SIGMA_INPUT_GLSL
#define SIGMA_INPUT_GLSL
#include "sigma.glsl"

const float kFilledDepthDifference = 0.02; // of the frustum's size: neighbours that may stand in for a pixel

Shadow readShadow(ivec2 texel, bool isLit)
{
#if HAS_TRANSLUCENCY
    if (isLit) return vec4(1.0);
    vec4 stored = texelFetch(gIn_Translucency, texel, 0); // .x of several lights in one may be anything in [0; 1]
    return vec4(SIGMA_SanitizeTransmission(stored.x), SIGMA_SanitizeTransmission(stored.yzw));
#else
    return isLit ? 1.0 : 0.0;
#endif
}

// false: no sample, because it is not a number or the other half of a checkerboard has it.
bool readSample(ivec2 pixel, float pixelSize, out ShadowSample result)
{
    ivec2 texel = inputTexel(pixel);
    float penumbra = texelFetch(gIn_Penumbra, texel, 0).x;
    bool hasMissed = penumbra >= NRD_FP16_MAX; // infinity too
    result.shadow = readShadow(texel, hasMissed);
    // A width below a half float's range would read as facing away.
    result.radius = hasMissed ? kLitRadius : clamp(penumbra / pixelSize, kMinRadius, kMaxRadius);
    if (!(penumbra > 0.0)) result.radius = kUnlitRadius;
    return hasData(pixel, false) && !NRD_IsNan(penumbra) && !(penumbra < 0.0);
}

// From the neighbours left and right that lie at the same depth. Between a lit and a shadowed one there is an edge, so
// the penumbra is a pixel wide at least. Without any the pixel counts as lit: one dark dot shows more than a bright one.
ShadowSample fillSample(ivec2 pixel, float viewZ)
{
    ShadowSample sum;
    sum.shadow = Shadow(0.0);
    sum.radius = 0.0;
    float count = 0.0, hitNum = 0.0, unlitNum = 0.0;
    float tolerance = kFilledDepthDifference * getFrustumSize(viewZ);
    for (int side = -1; side <= 1; side += 2)
    {
        ivec2 other = clampToRect(pixel + ivec2(side, 0));
        float otherViewZ = decodeViewZ(texelFetch(gIn_ViewZ, guideTexel(other), 0).x);
        ShadowSample s;
        bool isUsable = readSample(other, getPixelSize(otherViewZ), s);
        if (other == pixel || !isUsable || !isInRange(otherViewZ) || abs(otherViewZ - viewZ) > tolerance) continue;
        count += 1.0;
        sum.shadow += s.shadow;
        unlitNum += isUnlit(s.radius) ? 1.0 : 0.0;
        if (isLit(s.radius) || isUnlit(s.radius)) continue;
        hitNum += 1.0;
        sum.radius += s.radius;
    }
    if (count == 0.0) return ShadowSample(Shadow(1.0), kLitRadius);
    float radius = hitNum > 0.0 ? sum.radius / hitNum : (unlitNum == count ? kUnlitRadius : kLitRadius);
    if (hitNum == 1.0 && count == 2.0) radius = max(radius, 1.0);
    return ShadowSample(sum.shadow / count, radius);
}

ShadowSample readInputSample(ivec2 pixel, float viewZ)
{
    ShadowSample s;
    if (readSample(pixel, getPixelSize(viewZ), s)) return s;
    return fillSample(pixel, viewZ);
}

#endif
